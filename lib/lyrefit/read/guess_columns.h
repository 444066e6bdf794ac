#pragma once

#include <vector>

#include "lyrefit/read/column.h"

namespace lyrefit {

// Guesses voltage and current from unrecognised names. First choice are dark and lit pairs by letters
// (TakeDarkLitLetters), then the only pair of a letter and a common suffix ("Vx", "Ix"), then pairs whose
// voltage has the name of its current and a "_V" ("a_rev_V", "a_rev"), then pairs of a name and a
// letter behind it ("AV", "AI"), then the only columns in volt and in ampere, then a Suns-Voc
// trace, then one voltage beside other columns that share a unit or, if there is one only, name
// none. False if there is none of these.
bool GuessColumns(std::vector<Column>* columns);

// Columns whose names end in the letter of their quantity. One such name says little, so they are
// recognised as sets. Both functions return false, and change nothing, if there is no such set.

// Dark and lit measurements side by side, with D or L behind the letter: "Vd", "Jd", "Vl", "Jl", or
// "S4_V_D", "S4_J_D", "S4_V_L", "S4_J_L", also in front of it, or currents over one voltage. F and R in
// front of the letter are directions where both occur.
bool TakeDarkLitLetters(std::vector<Column>* columns);

// A voltage and a current for each name in front of the letter: "AV", "AI", or "AnodeV", "AnodeI", or
// "S4_V", "S4_J".
bool TakeNamedPairs(std::vector<Column>* columns);

}  // namespace lyrefit
