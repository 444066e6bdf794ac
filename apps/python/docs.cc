#include "docs.h"

#include <algorithm>

namespace lyrefit::python {
namespace {

constexpr std::size_t kWidth = 88;
constexpr char kExperimental[] = "\n\nExperimental: may change in a minor version.";

// Wraps a text into lines, each indented by four.
std::string Wrapped(const std::string& text) {
  std::string wrapped = "   ";
  std::size_t column = 3;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (column + 1 + end - begin > kWidth) {
      wrapped += "\n   ";
      column = 3;
    }
    wrapped += " " + text.substr(begin, end - begin);
    column += 1 + end - begin;
    begin = end + 1;
  }
  return wrapped + "\n";
}

std::string EntryOf(const KeywordNote& note) {
  const std::string usual = note.usual == "None" ? ", optional" : ", default " + note.usual;
  return note.name + " : " + note.type + usual + "\n" + Wrapped(note.doc);
}

}  // namespace

std::vector<KeywordNote> EachOnce(const std::vector<KeywordNote>& notes) {
  std::vector<KeywordNote> once;
  for (const KeywordNote& note : notes) {
    const bool known = std::any_of(once.begin(), once.end(), [&](const KeywordNote& other) {
      return other.name == note.name;
    });
    if (!known) once.push_back(note);
  }
  return once;
}

std::string DocOf(const VerbText& verb) {
  std::string doc = verb.name + "(" + verb.arguments;
  if (!verb.keywords.empty()) doc += ", *";
  for (const KeywordNote& note : verb.keywords) doc += ", " + note.name + "=" + note.usual;
  std::string head = verb.head;
  if (!verb.promised) head.insert(head.find("\n\n"), kExperimental);
  doc += ")\n--\n\n" + head;
  for (const KeywordNote& note : verb.keywords) {
    if (!note.doc.empty()) doc += EntryOf(note);
  }
  return doc + "\n" + verb.end;
}

void Note(py::module_* module, const VerbText& verb) {
  if (!py::hasattr(*module, "_keywords")) module->attr("_keywords") = py::dict();
  py::list keywords;
  for (const KeywordNote& note : verb.keywords) {
    keywords.append(py::make_tuple(note.name, note.type, note.usual, note.doc));
  }
  module->attr("_keywords")[py::str(verb.name)] = keywords;
}

}  // namespace lyrefit::python
