#pragma once

#include "family_flags.h"
#include "flags.h"

namespace lyrefit {

// Checks the output files of `verb`, reads the set (or the one curve) of `flagged`, fits it with
// the options and writes the report. Returns the exit code.
Expected<int> RunFamily(const VerbLine& verb, const CurveFlags& flagged, const FamilyFlags& flags,
                        const FamilyOptions& options, const ReportFlags& output);

// Error if no single curve could be read: `found`, or that the file has many curves.
Error WhyNotOneCurve(const CurveFlags& flags, const Error& found);

}  // namespace lyrefit
