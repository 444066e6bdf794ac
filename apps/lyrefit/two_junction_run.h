#pragma once

#include <string>
#include <vector>

#include "command_line.h"
#include "flags.h"
#include "lyrefit/devices/two_junction_options.h"
#include "lyrefit/estimate/fit/fit_options.h"

namespace lyrefit {

// Values of the flags about junctions in series.
struct JunctionFlags {
  int junctions = 1;
  TwoJunctionOptions options;  // those that only two junctions have
};

// Declares --junctions and the flags of the option table.
void AddJunctionFlags(VerbLine* verb, JunctionFlags* flags);

// Error for flags of two junctions without --junctions 2, and for flags that two junctions do not
// have.
Expected<void> CheckJunctionFlags(const VerbLine& verb, const JunctionFlags& flags);

// Fits two junctions in series to the curves of all files and writes the results; returns the exit
// code.
Expected<int> RunTwoJunctions(const VerbLine& verb, const std::vector<std::string>& files,
                              const CurveFlags& flagged, const JunctionFlags& flags,
                              const FitOptions& fit, const ReportFlags& output);

}  // namespace lyrefit
