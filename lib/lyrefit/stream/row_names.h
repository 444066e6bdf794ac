#pragma once

#include <string>
#include <string_view>

#include "lyrefit/read/column.h"
#include "lyrefit/read/records.h"

namespace lyrefit {

// The part of an id that a name denotes.
enum class IdPart {
  kNone,
  kWhole,  // id, curve_id, path
  kSite,   // levels of a plant, in this order
  kBlock,
  kInverter,
  kCombiner,
  kMppt,
  kString,
  kCurve,
  kOtherwise,  // name, label, module: used only without the others
};

// Meaning of a name, as a key of a JSON row or as the header of a column.
struct NameMeaning {
  IdPart id = IdPart::kNone;
  Column column;                // its meaning for a column of readings
  bool sidecar = false;         // it is a key of a sidecar
  bool states = false;          // it states a condition in words: "cells", "POA irradiance"
  bool pairs = false;           // its value has voltage and current in one text
  bool more = false;            // its value is a JSON object with further names
  const char* noise = nullptr;  // its key in the sidecar's current_noise; null: none
};

// Meaning of `name`, cached for each thread, since rows repeat names. The reference is valid until
// ForgetManyNames.
const NameMeaning& MeaningOf(std::string_view name);

// Clears this thread's cache if it has become large.
void ForgetManyNames();

// The id formed by the scalars of a row; empty: none. `used`, if not null, is set to true for each
// scalar that is part of the id.
std::string IdOf(const std::vector<RecordScalar>& scalars, std::vector<bool>* used = nullptr);

// `text` as one level of an id, without '/', which separates levels.
std::string AsLevel(std::string_view text);

// Parses a list in one field of a table: "0 1 2", "0;1;2", "0|1|2", "0,1,2", "[0, 1, 2]". With a
// separator other than the comma, numbers may have a decimal comma. The values are added to `list`.
void ParseList(std::string_view text, int column, Record* list);

// True if a field is a list of at least two numbers in one of these notations.
bool IsList(std::string_view text);

// Parses pairs in one field: "V*I#0*8.1#1*8.0#" (the head may be missing or be I*V), "0:8.1;1:8.0".
// False if there is no pair. The lists are named "V" and "I".
bool ParsePairs(std::string_view text, int column, Records* fields);

}  // namespace lyrefit
