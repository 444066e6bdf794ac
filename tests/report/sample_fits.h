#pragma once

#include <string>
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

inline std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    lines.push_back(text.substr(begin, end - begin));
  }
  return lines;
}

}  // namespace lyrefit
