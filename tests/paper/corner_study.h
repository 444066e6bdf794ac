#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/certify/certify.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/study/comparison.h"

namespace lyrefit {

// Searches within the bounds, at every budget. The figure shows the last budget but one.
struct CornerOptions {
  std::uint64_t seed = 0;
  int runs = 30;  // of each search at each budget
  std::vector<std::int64_t> budgets = {1000, 10000, 100000, 1000000};
  std::vector<ComparedAlgorithm> peers;  // algorithms of another library; names and budgets follow
                                         // those of lyrefit
  int threads = 0;
  std::string journal;  // see CompareOptions; empty: none
};

// Double-diode model on PWP201 within the bounds of the literature. The global optimum lies in a
// corner of the bounds, with n far below 1; published searches miss it.
struct CornerStudy {
  std::string version;
  CornerOptions options;
  Certificate certificate;  // over the full bounds
  Comparison comparison;    // one problem: the double-diode model
  FitReport one;            // single-diode fit, which the literature reports for two diodes
  FitReport two;            // global optimum
  FitReport two_solved;     // double-diode fit of the solved current
  bool interrupted = false;

  double optimum_A() const { return certificate.models[1].rmse_A; }
  double literature_A() const { return certificate.models[0].rmse_A; }
};

// Counts of runs by their final RMSE.
struct CornerEnds {
  int optimum = 0;     // within a relative 1e-6 of the optimum
  int between = 0;     // above the optimum and below the literature's RMSE
  int literature = 0;  // within a relative 1e-6 of the literature's RMSE
  int above = 0;       // above the literature's RMSE
};

// Counts the runs of `compared` by the RMSE that `end_A` selects.
CornerEnds CountEnds(const CornerStudy& study, const AlgorithmResult& compared,
                     double RunRecord::*end_A);

// Reads the curve and its bounds named `bounds` (NamedBounds) from `folder`. Takes half a minute.
Expected<CornerStudy> StudyCorner(const std::string& folder, const std::string& bounds,
                                  const CornerOptions& options = {}, const Observer& observer = {});

}  // namespace lyrefit
