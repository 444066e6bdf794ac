#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/curve/column.h"

namespace lyrefit {

// A word of a label such as "Voltage (mV)".
struct LabelWord {
  std::string text;      // lower case, letters and digits only
  std::string original;  // as written
  bool marked_as_unit;   // behind a bracket, slash or comma
};

// The words of a label, none of a text too long to be one; what stands behind "vs." (the reference
// of a potential) is left out.
std::vector<LabelWord> SplitLabel(std::string_view label);

// The words from `from` up to `to`, one behind the other.
std::string JoinWords(const std::vector<LabelWord>& words, std::size_t from, std::size_t to);

// A value in this unit becomes factor * value + offset in that of IvCurve; a current density
// becomes A/cm2, an area cm2.
struct Unit {
  ColumnKind kind;
  std::string_view text;
  double factor;
  double offset;
  bool is_a_header;  // stands alone as a header: "Volts", "mA"
};

// The unit of `kind` called `text`; nullptr if there is none.
const Unit* FindUnit(ColumnKind kind, std::string_view text);

// The unit that stands alone as a header.
const Unit* FindUnitHeader(std::string_view text);

// What to name in an error.
std::string_view ExpectedUnits(ColumnKind kind);

}  // namespace lyrefit
