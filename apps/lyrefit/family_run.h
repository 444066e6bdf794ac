#pragma once

#include "family_flags.h"
#include "flags.h"

namespace lyrefit {

// The files of `verb` are checked first. Reads the set (or the one curve) of `flagged`, fits it as
// the flags say and writes the report; the exit code.
Expected<int> RunFamily(const VerbLine& verb, const CurveFlags& flagged, const FamilyFlags& flags,
                        const FamilyOptions& options, const ReportFlags& output);

// Why no single curve could be read: `found`, or that the file holds many.
Error WhyNotOneCurve(const CurveFlags& flags, const Error& found);

}  // namespace lyrefit
