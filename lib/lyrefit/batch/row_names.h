#pragma once

#include <string>
#include <string_view>

#include "lyrefit/curve/column.h"
#include "lyrefit/batch/row_fields.h"

namespace lyrefit {

// Part of an id that a name stands for.
enum class IdPart {
  kNone,
  kWhole,  // id, curve_id, path
  kSite,   // the levels of a plant, in this order
  kBlock,
  kInverter,
  kCombiner,
  kMppt,
  kString,
  kCurve,
  kOtherwise,  // name, label, module: where nothing else tells
};

// What a name says, as a key of a JSON row or the header of a column.
struct NameMeaning {
  IdPart id = IdPart::kNone;
  Column column;                // what it would be as readings
  bool sidecar = false;         // a key of a sidecar
  bool states = false;          // states a condition in words: "cells", "POA irradiance"
  bool pairs = false;           // voltage and current in one text
  bool more = false;            // a JSON object with further names
  const char* noise = nullptr;  // its key in the sidecar's current_noise
};

// Remembers the names that it was asked for: rows repeat them. The reference holds until
// ForgetNames.
const NameMeaning& MeaningOf(std::string_view name);

// Forgets those of this thread when they have become many.
void ForgetManyNames();

// The id that the scalars of a row make, empty if they make none. `used` gets true for each that is
// part of it, if given.
std::string IdOf(const std::vector<RowScalar>& scalars, std::vector<bool>* used = nullptr);

// '/' separates the levels: one level has none.
std::string AsLevel(std::string_view text);

}  // namespace lyrefit
