#pragma once

#include <string>
#include <vector>

#include "bounds_flag.h"
#include "flags.h"
#include "lyrefit/study/compare.h"

namespace lyrefit {

// Flags of the verb compare. Lists are texts separated by commas.
struct CompareFlags {
  std::vector<std::string> curve_files;  // curves, or sets of curves
  std::string at;                        // of sets: selects the curves nearest to these conditions
  std::string curve_ids;                 // of sets: selects the curves with these ids
  std::string algorithms = "lo,lo+mblss,lo+dmlss,mlo,de,random";
  std::string bounds = "physical";
  BoundsSpec::Table ranges;  // of single parameters
  ConditionOptions conditions;
  CompareOptions options;
  SearchOptions search;
  ReportFlags output;
  std::string convergence_file;
};

// Splits "a,b" at commas; an empty part is an error that names `flag`.
Expected<std::vector<std::string>> ParseList(const std::string& flag, const std::string& text);

// The curves of all files, with their bounds. --curves and --at select the curves of sets.
Expected<std::vector<CompareCurve>> ReadComparedCurves(const CompareFlags& flags);

}  // namespace lyrefit
