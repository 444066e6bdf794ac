#include <fmt/format.h>

#include "lyrefit/cite/references.h"

namespace lyrefit {
namespace {

std::vector<std::string> Split(const std::string& text, const std::string& by) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find(by, begin)) != std::string::npos;
       begin = end + by.size()) {
    parts.push_back(text.substr(begin, end - begin));
  }
  parts.push_back(text.substr(begin));
  return parts;
}

// "Storn and Price 1997, doi:10.1023/A:1008202821328"; of a standard its number.
std::string InShort(const Publication& reference) {
  if (std::string(reference.type) == "misc") return reference.in;
  std::string text;
  const std::vector<std::string> authors = Split(reference.author, " and ");
  if (authors.size() > 3 || authors.back() == "others") {
    text = authors.front().substr(0, authors.front().find(',')) + " et al.";
  } else {
    for (std::size_t i = 0; i < authors.size(); ++i) {
      if (i > 0) text += i + 1 < authors.size() ? ", " : " and ";
      text += authors[i].substr(0, authors[i].find(','));
    }
  }
  text += fmt::format(" {}", reference.year);
  if (*reference.doi != '\0') return text + ", doi:" + reference.doi;
  text += fmt::format(", {}", reference.in);
  if (*reference.volume != '\0') text += fmt::format(" {}", reference.volume);
  return *reference.pages != '\0' ? fmt::format("{}, {}", text, reference.pages) : text;
}

// The field of BibTeX that `in` is.
const char* PlaceField(const std::string& type) {
  if (type == "article") return "journal";
  if (type == "inproceedings") return "booktitle";
  return type == "techreport" ? "institution" : "howpublished";
}

}  // namespace

std::vector<const Publication*> PublicationsIn(const std::string& text) {
  std::vector<const Publication*> found;
  for (const std::string& part : Split(text, "; ")) {
    if (const Publication* one = FindPublication(part.substr(0, part.find(' '))))
      found.push_back(one);
  }
  return found;
}

std::string ReferenceText(const std::string& text) {
  std::string shown;
  for (const std::string& part : Split(text, "; ")) {
    const std::size_t end = part.find(' ');
    const Publication* const one = FindPublication(part.substr(0, end));
    if (!shown.empty()) shown += "; ";
    shown += one == nullptr ? part : InShort(*one);
    if (one != nullptr && end != std::string::npos) shown += part.substr(end);
  }
  return shown;
}

std::string BibTeX(const Publication& reference) {
  const std::string type = reference.type;
  const bool article = type == "article";
  const struct {
    const char* name;
    const char* value;
    bool expected;
  } fields[] = {
      {"author", reference.author, true},
      {"title", reference.title, true},
      {PlaceField(type), reference.in, type != "software"},
      {"year", reference.year, true},
      {"volume", reference.volume, article},
      {"number", reference.number, false},
      {"pages", reference.pages, article},
      {"doi", reference.doi, article},
  };
  std::string entry = fmt::format("@{}{{{}", type, reference.key);
  std::string missing;
  for (const auto& field : fields) {
    if (*field.value != '\0') {
      entry += fmt::format(",\n  {} = {{{}}}", field.name, field.value);
    } else if (field.expected) {
      missing += (missing.empty() ? "% missing: " : ", ") + std::string(field.name);
    }
  }
  return (missing.empty() ? "" : missing + "\n") + entry + "\n}\n";
}

}  // namespace lyrefit
