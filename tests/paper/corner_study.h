#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/certify/certify.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/study/comparison.h"

namespace lyrefit {

// The searches of the box, at every budget. The last budget but one is that of the picture.
struct CornerOptions {
  std::uint64_t seed = 0;
  int runs = 30;  // of each search at each budget
  std::vector<std::int64_t> budgets = {1000, 10000, 100000, 1000000};
  std::vector<ComparedAlgorithm> peers;  // of another library, named and with budgets as ours
  int threads = 0;
  std::string journal;  // see CompareOptions; empty: none
};

// Two diodes on PWP201 in the literature's own box, whose optimum lies in a corner of it where
// nobody looked: n far below 1.
struct CornerStudy {
  std::string version;
  CornerOptions options;
  Certificate certificate;  // of the whole box
  Comparison comparison;    // one problem: two diodes
  FitReport one;            // of a single diode, what the literature reports for two
  FitReport two;            // the optimum
  FitReport two_solved;     // two diodes fitted to the solved current
  bool interrupted = false;

  double optimum_A() const { return certificate.models[1].rmse_A; }
  double literature_A() const { return certificate.models[0].rmse_A; }
};

// Where runs end.
struct CornerEnds {
  int optimum = 0;     // within 1e-6 of it
  int between = 0;     // below the literature's figure
  int literature = 0;  // within 1e-6 of that
  int above = 0;       // above it
};

// Of the figure that `end_A` names of every run.
CornerEnds CountEnds(const CornerStudy& study, const AlgorithmResult& compared,
                     double RunRecord::*end_A);

// Reads the curve and its bounds of that name (NamedBounds) from `folder`; takes half a minute.
Expected<CornerStudy> StudyCorner(const std::string& folder, const std::string& bounds,
                                  const CornerOptions& options = {}, const Observer& observer = {});

}  // namespace lyrefit
