#pragma once

#include "studies/flags.h"

// The studies as programs: each reads its flags, prints its text and returns the exit code.
namespace lyrefit {

// --csv FILE and the options of coverage_options.h.
Expected<int> RunCoverage(ProgramFlags flags);

// The options of junctions.h.
Expected<int> RunJunctions(ProgramFlags flags);

// CURVES TRUTH.csv, --family free|desoto|pvsyst, --bound P=LOWER:UPPER, --noise NAME, --csv FILE.
Expected<int> RunTruth(ProgramFlags flags);

}  // namespace lyrefit
