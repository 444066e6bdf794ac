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

// Removes the words of direction, light and average, also those joined to a letter ("Vdark"), and
// returns what they state.
ColumnTag TakeTag(std::vector<LabelWord>* words);

// A label without the power of ten that it states beside its unit, as registers of inverters have
// them: "PV1 voltage (0.1V)", "Ipv1 x0.01 A", "U (V, gain 10)", "current_A scale 0.01".
struct ScaledLabel {
  std::string label;  // "PV1 voltage (V)"
  double scale = 1;   // what a written number is to be multiplied by
};

// A scale of 1 if the label states none.
ScaledLabel TakeScale(std::string_view label);

}  // namespace lyrefit
