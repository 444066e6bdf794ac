#pragma once

#include <vector>

#include "sample_report.h"

namespace lyrefit {

// A doubtful fit, a file without a fit, and a search without polish.
inline std::vector<FittedFile> SampleFits() {
  FitReport warned = SampleReport();
  warned.warnings = {"first, of two", "second"};
  warned.usable = false;
  FitReport searched = SampleReport();
  searched.polished = false;
  return {{"a.csv", warned},
          {"b, c.csv", Fail("expected a number, found 'x'", "b, c.csv", 2, 3)},
          {"d.csv", searched}};
}

}  // namespace lyrefit
