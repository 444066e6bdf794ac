#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/read/column.h"

namespace lyrefit {

// A word of a label such as "Voltage (mV)".
struct LabelWord {
  std::string text;      // lower case, letters and digits only, in English where it is known
  std::string original;  // as written
  bool marked_as_unit;   // preceded by a bracket, slash or comma
};

// The words of a label, translated (label.h); none if the text is too long for a label. Words
// after "vs." are dropped: they name the reference of a potential.
std::vector<LabelWord> SplitLabel(std::string_view text);

// Concatenates the words from `from` up to, not including, `to`.
std::string JoinWords(const std::vector<LabelWord>& words, std::size_t from, std::size_t to);

// A unit. factor * value + offset converts to the unit of IvCurve, a current density to A/cm2, an
// area to cm2.
struct Unit {
  ColumnKind kind;
  std::string_view text;
  double factor;
  double offset;
  bool is_a_header;  // valid as a whole header: "Volts", "mA"
};

// The unit of `kind` called `text`; nullptr if there is none.
const Unit* FindUnit(ColumnKind kind, std::string_view text);

// The unit that `text` names if it is a whole header; nullptr if none.
const Unit* FindUnitHeader(std::string_view text);

// Accepted units as text, for errors.
std::string_view ExpectedUnits(ColumnKind kind);

// `text` with full-width punctuation, letters and digits as their ASCII forms: "（mV）" is "(mV)".
std::string HalfWidth(std::string_view text);

// Replaces words of German, French, Spanish, Italian, Portuguese, Russian, Chinese, Japanese and
// Korean by their English ones, in small letters and whatever their accents: "Zelltemperatur" is
// "cell temperature", "电压" is "voltage". Chinese words need no blanks between them. Articles and
// prepositions before a further word of the name are dropped: "température de la cellule".
void Translate(std::vector<LabelWord>* words);

}  // namespace lyrefit
