#pragma once

#include "family_flags.h"
#include "flags.h"

namespace lyrefit {

// Checks the output files of `verb`, reads the set (or the one curve) of `flagged`, fits it with
// the options and writes the report. Returns the exit code.
Expected<int> RunFamily(const VerbLine& verb, const CurveFlags& flagged, const FamilyFlags& flags,
                        const FamilyOptions& options, const ReportFlags& output);

}  // namespace lyrefit
