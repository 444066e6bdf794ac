#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lyrefit/base/former_names.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// One spelling for each value of an enumeration, shared by flags, JSON, tables and messages. To add
// an enumeration, specialise EnumTable with an array `kRows` of {value, text}.
template <class E>
struct EnumText {
  E value;                // of the enumeration
  std::string_view text;  // its only spelling
};

// Texts of an enumeration: each specialisation defines `kRows`.
template <class E>
struct EnumTable;

// The text of `value`; "?" if the table has no row for it.
template <class E>
std::string ToText(E value) {
  for (const auto& row : EnumTable<E>::kRows) {
    if (row.value == value) return std::string(row.text);
  }
  return "?";
}

// The value whose text is `text`, or whose text was `text` in version 0.1; nullopt if there is none.
template <class E>
std::optional<E> FromText(std::string_view text) {
  for (const FormerName& pair : kFormerValues) {
    if (pair.former == text) text = pair.name;
  }
  for (const auto& row : EnumTable<E>::kRows) {
    if (row.text == text) return row.value;
  }
  return std::nullopt;
}

// All texts as a list such as "mlo, lo, de", for messages that name the allowed values.
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
