#include "errors.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>

#include "bindings.h"
#include "keywords.h"

namespace lyrefit::python {
namespace {

constexpr char kErrorDoc[] =
    "A mistake in data, files or options, in one sentence that says what is wrong and what was\n"
    "expected.\n\n"
    "Attributes\n"
    "----------\n"
    "message : str\n"
    "    The sentence alone; str() of the error has the place before it.\n"
    "file : str\n"
    "    The file it is about; empty if there is none.\n"
    "line, column : int\n"
    "    Where in the file, from 1; 0 where it is tied to no line.\n";

py::handle error_type;  // owned by the module as well; never destroyed
py::handle own_module;

constexpr std::string_view kFlagLetters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-";

// Whether the verbs that have a keyword (docs.cc) all take True or False for it; none: no verb has it.
std::optional<bool> IsSwitch(const std::string& keyword) {
  std::optional<bool> is_switch;
  for (const auto& [verb, keywords] : py::dict(own_module.attr("_keywords"))) {
    for (const py::handle row : keywords) {
      if (row[py::int_(0)].cast<std::string>() != keyword) continue;
      is_switch = is_switch.value_or(true) && row[py::int_(1)].cast<std::string>() == "bool";
    }
  }
  return is_switch;
}

// What a flag, without its dashes, is called in Python, up to its value; empty: no keyword.
std::string KeywordWithSign(const std::string& flag) {
  const std::string keyword = KeywordOf(flag);
  if (const auto is_switch = IsSwitch(keyword)) return keyword + (*is_switch ? "=True" : "=");
  constexpr std::string_view kOff = "no-";
  if (flag.rfind(kOff, 0) != 0) return "";
  const std::string on = KeywordOf(flag.substr(kOff.size()));
  return IsSwitch(on) ? on + "=False" : "";
}

// Length of the value that follows a flag as " 2", " mV" or " NAME"; 0: a word of the sentence
// follows.
std::size_t LengthOfValue(std::string_view after) {
  if (after.size() < 2 || after.front() != ' ') return 0;
  const std::size_t end = std::min(after.find_first_of(" ,;:?)", 1), after.size());
  const std::string_view word = after.substr(1, end - 1);
  const bool value = std::any_of(word.begin(), word.end(), [](unsigned char letter) {
    return std::isdigit(letter) != 0 || std::isupper(letter) != 0;
  });
  return value ? end : 0;
}

// Texts get quotes in Python, numbers do not.
std::string InPython(const std::string& value) {
  const bool number = value.find_first_not_of("+-.0123456789") == std::string::npos;
  return number ? value : "'" + value + "'";
}

}  // namespace

std::string InKeywords(const std::string& sentence) {
  std::string out;
  std::size_t from = 0;
  for (std::size_t at = sentence.find("--"); at != std::string::npos;
       at = sentence.find("--", std::max(at + 2, from))) {
    std::size_t end = std::min(sentence.find_first_not_of(kFlagLetters, at + 2), sentence.size());
    while (end > at + 2 && sentence[end - 1] == '-') --end;
    const std::string keyword = KeywordWithSign(sentence.substr(at + 2, end - at - 2));
    if (keyword.empty()) continue;
    out += sentence.substr(from, at - from) + keyword;
    const std::size_t value =
        keyword.back() == '=' ? LengthOfValue(std::string_view(sentence).substr(end)) : 0;
    if (value > 0) out += InPython(sentence.substr(end + 1, value - 1));
    from = end + value;
  }
  return out + sentence.substr(from);
}

void Raise(const Error& told) {
  Error error = told;
  error.message = InKeywords(told.message);
  const py::object raised = error_type(error.ToString());
  raised.attr("message") = error.message;
  raised.attr("file") = error.file;
  raised.attr("line") = error.line;
  raised.attr("column") = error.column;
  PyErr_SetObject(error_type.ptr(), raised.ptr());
  throw py::error_already_set();
}

Error ErrorOf(py::error_already_set& raised) {
  if (!raised.matches(error_type)) throw;
  const py::object& error = raised.value();
  return {error.attr("message").cast<std::string>(), error.attr("file").cast<std::string>(),
          error.attr("line").cast<int>(), error.attr("column").cast<int>()};
}

void Warn(const std::string& sentence) {
  const std::string said = InKeywords(sentence);
  if (PyErr_WarnEx(PyExc_UserWarning, said.c_str(), 1) != 0) throw py::error_already_set();
}

void WarnOfDoubts(const std::vector<std::string>& doubts) {
  for (const std::string& doubt : doubts) Warn("DOUBTFUL: " + doubt);
}

void WarnUnlessUsable(bool usable, const std::string& because) {
  if (usable) return;
  Warn("the fit is not usable: " + (because.empty() ? "its 'warnings' say why" : because));
}

void BindErrors(py::module_* module) {
  error_type = PyErr_NewExceptionWithDoc("lyrefit.Error", kErrorDoc, PyExc_ValueError, nullptr);
  if (!error_type) throw py::error_already_set();
  module->attr("Error") = error_type;
  own_module = *module;
  module->def("_in_keywords", &InKeywords, py::arg("sentence"));
}

}  // namespace lyrefit::python
