#pragma once

#include <vector>

#include "lyrefit/read/column.h"

namespace lyrefit {

// Guesses voltage and current from unrecognised names. First choice are dark and lit pairs by letters
// (letter_names.h), then the only pair of a letter and a common suffix ("Vx", "Ix"), then pairs whose
// voltage has the name of its current and a "_V" ("a_rev_V", "a_rev"), then pairs of a name and a
// letter behind it ("AV", "AI"), then the only columns in volt and in ampere, then a Suns-Voc
// trace, then one voltage beside other columns that share a unit or, if there is one only, name
// none. False if there is none of these.
bool GuessColumns(std::vector<Column>* columns);

}  // namespace lyrefit
