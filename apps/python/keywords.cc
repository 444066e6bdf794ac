#include "keywords.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "lyrefit/base/former_names.h"

namespace lyrefit::python {
namespace {

// Rows with a different keyword: pvlib's name, one that does not clash with an argument, and one
// that is not a Python keyword.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kOtherWords = {
    {{"cells", "cells_in_series"}, {"curve", "curve_index"}, {"with", "with_"}}};

[[noreturn]] void Expect(const std::string& keyword, const char* what, py::handle value) {
  const std::string found = py::repr(value).cast<std::string>();
  constexpr std::size_t kLongest = 80;
  Raise({keyword + ": expected " + what + ", found " +
             (found.size() > kLongest ? found.substr(0, kLongest) + "..." : found),
         {}});
}

bool IsTruth(py::handle value) {
  return py::isinstance<py::bool_>(value) ||
         std::string_view(Py_TYPE(value.ptr())->tp_name) == "numpy.bool_";
}

bool IsText(py::handle value) {
  return py::isinstance<py::str>(value) || py::hasattr(value, "__fspath__");
}

// A number with all of its digits, in Python notation.
std::string DigitsOf(const std::string& keyword, py::handle value) {
  if (PyIndex_Check(value.ptr()) != 0) return std::to_string(WholeOf(keyword, value));
  return py::repr(py::float_(NumberOf(keyword, value))).cast<std::string>();
}

bool IsPair(py::handle value) {
  return (py::isinstance<py::tuple>(value) || py::isinstance<py::list>(value)) &&
         py::len(value) == 2;
}

// A number as "0.3", a pair as "0:0.5".
std::string RangeOrNumber(const std::string& keyword, py::handle value) {
  if (!IsPair(value)) return IsText(value) ? TextOf(keyword, value) : DigitsOf(keyword, value);
  const py::sequence ends = py::reinterpret_borrow<py::sequence>(value);
  return DigitsOf(keyword, ends[0]) + ":" + DigitsOf(keyword, ends[1]);
}

// A named value in the command's notation: "Rs=0:0.5", "n2=2", "shading:d=0.3,w=0.1:0.2",
// "shading".
std::string NamedText(const std::string& keyword, const std::string& name, py::handle value) {
  if (value.is_none() || IsTruth(value)) return name;
  if (!py::isinstance<py::dict>(value)) return name + "=" + RangeOrNumber(keyword, value);
  std::string text = name;
  for (const auto& [key, inner] : py::reinterpret_borrow<py::dict>(value)) {
    text += text.size() == name.size() ? ":" : ",";
    text += TextOf(keyword, key) + "=" + RangeOrNumber(keyword, inner);
  }
  return text;
}

}  // namespace

std::string KeywordOf(std::string_view row) {
  for (const auto& [name, keyword] : kOtherWords) {
    if (row == name) return std::string(keyword);
  }
  std::string keyword(row);
  std::replace(keyword.begin(), keyword.end(), '-', '_');
  return keyword;
}

bool IsKeywordOf(std::string_view row, std::string_view keyword) {
  for (const auto& [name, other] : kOtherWords) {
    if (keyword == other) return row == name;
  }
  const auto same = [](char a, char b) { return a == b || (a == '-' && b == '_'); };
  const bool spelt =
      row.size() == keyword.size() && std::equal(row.begin(), row.end(), keyword.begin(), same);
  return spelt && KeywordOf(row) == keyword;  // false for rows with a different keyword
}

double NumberOf(const std::string& keyword, py::handle value) {
  if (IsText(value)) Expect(keyword, "a number", value);
  const double number = PyFloat_AsDouble(value.ptr());
  if (number != -1 || PyErr_Occurred() == nullptr) return number;
  PyErr_Clear();
  Expect(keyword, "a number", value);
}

std::int64_t WholeOf(const std::string& keyword, py::handle value) {
  if (PyIndex_Check(value.ptr()) == 0) {
    if (PyFloat_Check(value.ptr()) == 0) Expect(keyword, "a whole number", value);
    const double number = NumberOf(keyword, value);
    if (number != std::floor(number) || std::fabs(number) > 9e15) {
      Expect(keyword, "a whole number", value);
    }
    return static_cast<std::int64_t>(number);
  }
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  const std::int64_t whole = index ? PyLong_AsLongLong(index.ptr()) : -1;
  if (whole != -1 || PyErr_Occurred() == nullptr) return whole;
  PyErr_Clear();
  Expect(keyword, "a whole number", value);
}

std::uint64_t UnsignedOf(const std::string& keyword, py::handle value) {
  const auto index = py::reinterpret_steal<py::object>(
      PyIndex_Check(value.ptr()) != 0 ? PyNumber_Index(value.ptr()) : nullptr);
  if (index) {
    const std::uint64_t whole = PyLong_AsUnsignedLongLong(index.ptr());
    if (PyErr_Occurred() == nullptr) return whole;
  }
  PyErr_Clear();
  const bool whole = !IsText(value) && NumberOf(keyword, value) >= 0;
  if (!whole || index) Expect(keyword, "a whole number from 0", value);
  return static_cast<std::uint64_t>(WholeOf(keyword, value));
}

bool TruthOf(const std::string& keyword, py::handle value) {
  if (!IsTruth(value)) Expect(keyword, "True or False", value);
  return PyObject_IsTrue(value.ptr()) == 1;
}

std::string TextOf(const std::string& keyword, py::handle value) {
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (py::hasattr(value, "__fspath__")) {
    return py::str(py::module_::import("os").attr("fspath")(value)).cast<std::string>();
  }
  if (PyNumber_Check(value.ptr()) == 0) Expect(keyword, "a text", value);
  return DigitsOf(keyword, value);
}

std::vector<std::string> TextsOf(const std::string& keyword, py::handle value) {
  std::vector<std::string> texts;
  if (py::isinstance<py::dict>(value)) {
    for (const auto& [name, inner] : py::reinterpret_borrow<py::dict>(value)) {
      texts.push_back(NamedText(keyword, TextOf(keyword, name), inner));
    }
  } else if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value) ||
             py::isinstance<py::set>(value)) {
    for (const py::handle member : value) {
      for (std::string& text : TextsOf(keyword, member)) texts.push_back(std::move(text));
    }
  } else {
    texts.push_back(TextOf(keyword, value));
  }
  return texts;
}

void CheckRange(const std::string& keyword, double value, double lower, double upper) {
  if (value >= lower && value <= upper) return;
  Raise({keyword + ": " + NumberText(value) + " is outside [" + NumberText(lower) + ", " +
             NumberText(upper) + "]",
         {}});
}

namespace {

// The keyword now of one that version 0.1 had; warns about it.
std::string CurrentKeyword(const std::string& keyword) {
  for (const FormerName& option : kFormerOptions) {
    if (!IsKeywordOf(option.former, keyword)) continue;
    const std::string name = KeywordOf(option.name);
    const std::string note = "the keyword '" + keyword + "' is now '" + name + "'";
    if (PyErr_WarnEx(PyExc_DeprecationWarning, note.c_str(), 1) != 0) throw py::error_already_set();
    return name;
  }
  return keyword;
}

}  // namespace

bool IsNoted(const std::string& keyword, const std::vector<KeywordNote>& notes) {
  return std::any_of(notes.begin(), notes.end(),
                     [&keyword](const KeywordNote& note) { return note.name == keyword; });
}

Keywords::Keywords(const char* verb, const py::kwargs& given) : verb_(verb) {
  given_.reserve(given.size());
  for (const auto& [name, value] : given) {
    given_.push_back(
        {CurrentKeyword(name.cast<std::string>()), py::reinterpret_borrow<py::object>(value)});
  }
}

std::optional<py::object> Keywords::Take(const char* name) {
  asked_.push_back(name);
  for (auto& given : given_) {
    if (given.taken || given.name != name) continue;
    given.taken = true;
    if (given.value.is_none()) return std::nullopt;
    return given.value;
  }
  return std::nullopt;
}

bool Keywords::Given(std::string_view name) const {
  return std::any_of(given_.begin(), given_.end(), [name](const auto& given) {
    return given.name == name && !given.value.is_none();
  });
}

void Keywords::Finish() const {
  const auto left =
      std::find_if(given_.begin(), given_.end(), [](const auto& given) { return !given.taken; });
  if (left == given_.end()) return;
  std::vector<std::string> names(asked_.begin(), asked_.end());
  for (const auto& know : knowers_) know(&names);
  const bool flag = std::any_of(kOtherWords.begin(), kOtherWords.end(),
                                [&](const auto& words) { return words.first == left->name; });
  const std::string sought = flag ? KeywordOf(left->name) : left->name;  // a flag, as --cells
  const py::list near =
      py::module_::import("difflib").attr("get_close_matches")(sought, names, 1, 0.5);
  std::string sentence = std::string(verb_) + "() has no keyword '" + left->name + "'";
  if (!near.empty()) sentence += "; did you mean '" + near[0].cast<std::string>() + "'?";
  throw py::type_error(sentence);
}

}  // namespace lyrefit::python
