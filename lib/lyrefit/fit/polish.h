#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/seconds.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/fit/fit_watch.h"
#include "lyrefit/refine/refine.h"

namespace lyrefit {

// A place to begin.
struct PolishStart {
  std::string origin;
  std::vector<double> p;
  int variant = 0;         // which of the variants its effects have
  bool beside = false;  // begins at an earlier end, changed a little
};

// All starts polished: the first start is the best candidate, whose own end is kept apart.
struct PolishResult {
  RefineEnd best;
  RefineEnd first;
  std::vector<FitPoint> ends;  // of all starts, of a device with effects
  RefineReport report;
};

constexpr double kAgree = 1e-9;    // relative, of RMSE: two ends are the same
constexpr double kBetter = 1e-12;  // relative, of RMSE: one end is better than another

// What came of the first so many starts, each with its end. `winner`: index of the best end; below
// 0: the lowest.
PolishResult ReportEnds(const RefineProblem& problem, const std::vector<PolishStart>& starts,
                        std::vector<RefineEnd> ends, int winner, bool stopped, Instant begin);

// Separable descent from one start after the other, until three (of a single diode: two) have come
// to the same best curve or no start is left; then one bounded least-squares solve for each curve
// that was found, so starts that came to the same curve share an end. All this on `coarse`, which is
// Thin(problem); where that stands for more points, the ends that may be the best are solved once
// more on all of them. Starts after the first are skipped when `watch` asks to stop.
PolishResult PolishStarts(const RefineProblem& problem, const RefineProblem& coarse,
                          const std::vector<PolishStart>& starts, FitWatch* watch);

// The best candidate first, then by turns the separable grid and further elites; for more than one diode
// also the best single-diode curve, so that a richer model never ends above a poorer one.
std::vector<PolishStart> CollectStarts(const RefineProblem& problem,
                                       const std::vector<PolishStart>& candidates, int grid);

}  // namespace lyrefit
