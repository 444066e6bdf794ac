#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// One spelling of every enumeration, shared by flags, JSON, tables and messages. An enumeration
// joins by specialising EnumTable with a `kRows` array of {value, text}.
template <class E>
struct EnumText {
  E value;                // of the enumeration
  std::string_view text;  // its one spelling
};

// Texts of an enumeration: each specialisation has `kRows`.
template <class E>
struct EnumTable;

// The text of a value; "?" for one that the table has not.
template <class E>
std::string ToText(E value) {
  for (const auto& row : EnumTable<E>::kRows) {
    if (row.value == value) return std::string(row.text);
  }
  return "?";
}

// The value of a text, nothing for one that the table has not.
template <class E>
std::optional<E> FromText(std::string_view text) {
  for (const auto& row : EnumTable<E>::kRows) {
    if (row.text == text) return row.value;
  }
  return std::nullopt;
}

// "mlo, lo, de": for messages that list what would have been understood.
template <class E>
std::string AllTexts() {
  std::string list;
  for (const auto& row : EnumTable<E>::kRows) {
    if (!list.empty()) list += ", ";
    list += row.text;
  }
  return list;
}

}  // namespace lyrefit
