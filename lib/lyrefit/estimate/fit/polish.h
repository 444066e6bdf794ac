#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/estimate/refine/refine.h"
#include "lyrefit/model/device.h"
#include "lyrefit/model/parameter.h"

namespace lyrefit {

// Sorts interchangeable parameter sets with equal bounds, whose exchange leaves the curve
// unchanged. Diodes are sorted by rising n, absent ones last. Cell groups of effects
// (Effect::alike) are sorted by rising first parameter, absent ones last. `active` is permuted too
// if it is not null. Diodes are not interchangeable if effects change the operating conditions of
// cells, since the temperature dependence of the first diode then differs from that of the others.
void OrderAlike(const Device& device, const std::vector<ParameterBounds>& bounds,
                std::vector<double>* p, std::vector<bool>* active);

// A start of the polish.
struct PolishStart {
  std::string origin;
  std::vector<double> p;
  int variant = 0;      // index of the model variant of the effects
  bool beside = false;  // a modified earlier end
};

// Result of polishing all starts. The first start is the best candidate, whose own end is `first`.
struct PolishResult {
  RefineEnd best;
  RefineEnd first;
  std::vector<FitPoint> ends;  // of all starts, only with effects
  RefineReport report;
};

constexpr double kAgree = 1e-9;    // relative, of RMSE: two ends are the same
constexpr double kBetter = 1e-12;  // relative, of RMSE: one end is better than another

// Result for the first ends.size() starts. `winner`: index of the best end; negative: the end with
// the lowest mean square.
PolishResult ReportEnds(const RefineProblem& problem, const std::vector<PolishStart>& starts,
                        std::vector<RefineEnd> ends, int winner, bool stopped, Instant begin);

// Runs a separable descent from each start in turn, until three (single diode: two) have reached
// the same best curve or no start is left. Then one bounded least-squares solve is run for each
// distinct curve; starts with the same curve share an end. All this uses `coarse`, which is
// Coarsen(problem). If it has fewer points than `problem`, the ends that may be the best are solved
// again on all points. Starts after the first are skipped when the observer requests a stop.
PolishResult PolishStarts(const RefineProblem& problem, const RefineProblem& coarse,
                          const std::vector<PolishStart>& starts, const ProgressReporter& progress);

// Starts: the best candidate, then the separable grid and further elites in alternation. For more
// than one diode the best single-diode curve is included, so that a richer model never ends above a
// simpler one.
std::vector<PolishStart> CollectStarts(const RefineProblem& problem,
                                       const std::vector<PolishStart>& candidates, int grid);

}  // namespace lyrefit
