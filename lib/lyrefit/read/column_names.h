#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/read/column.h"
#include "lyrefit/read/label.h"

namespace lyrefit {

// A name of a quantity.
struct ColumnName {
  std::string_view text;  // letters and digits only, lower case
  ColumnKind kind;
};

// The quantity called `text`; nullptr if there is none.
const ColumnName* FindName(std::string_view text);

template <std::size_t N>
bool IsAmong(const std::string_view (&list)[N], std::string_view text) {
  return std::find(std::begin(list), std::end(list), text) != std::end(list);
}

// Removes words that say where a quantity was measured, unless there is no other word.
void DropQualifiers(std::vector<LabelWord>* words);

// Shortens "vmeas" to "v", since "meas" says where.
void CutQualifierOffLetter(LabelWord* word);

// Removes the number of a pixel, channel or unit from the words and returns it: "I1", "Ch2
// voltage", "Current 1 (A)". The 2 of "mA cm-2" is not such a number.
std::string TakeNumber(std::vector<LabelWord>* words);

}  // namespace lyrefit
