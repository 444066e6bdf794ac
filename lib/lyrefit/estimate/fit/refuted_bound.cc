#include "lyrefit/estimate/fit/refuted_bound.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lyrefit/base/distributions.h"
#include "lyrefit/estimate/fit/reading_errors.h"
#include "lyrefit/estimate/fit/statistics.h"

namespace lyrefit {
namespace {

constexpr double kRefutedAt = 0.05;

// Indices of the idealities at a bound that can be widened. Below `steepest_n` a diode is a step in
// the current (model/term.h), so that bound is excluded.
std::vector<int> AtBound(const PreparedFit& fit, const RefineEnd& end) {
  std::vector<int> found;
  for (int d = 0; d < DiodeCount(fit.device); ++d) {
    const int i = IdealityIndex(d);
    const ParameterBounds& bounds = fit.bounds[i];
    const bool absent = !(end.p[SaturationCurrentIndex(d)] > 0);
    if (absent || bounds.lower == bounds.upper) continue;
    const bool low = end.p[i] <= bounds.lower && bounds.lower != fit.steepest_n;
    if (low || end.p[i] >= bounds.upper) found.push_back(i);
  }
  return found;
}

RefineProblem WithRoom(RefineProblem problem, const std::vector<int>& at_bound, double steepest) {
  constexpr double kRoom = 4;
  for (const int i : at_bound) {
    problem.lower[i] /= kRoom;
    if (steepest > 0) problem.lower[i] = std::max(problem.lower[i], steepest);
    problem.upper[i] *= kRoom;
  }
  return problem;
}

// p-value of a decrease of the mean square from `bound` to `free` in one problem.
double PValue(const RefineProblem& problem, double bound, double free, int extra, int spare) {
  if (problem.errors == nullptr) return FTestPValue(bound, free, extra, spare);
  const double squares =
      (bound - free) * static_cast<double>(problem.voltage_V.size()) / std::pow(problem.noise_A, 2);
  return FisherTail(squares / extra, extra, spare);
}

// p-value with both ends refitted under the errors estimated from the wider fit; `p` if these show
// no correlated errors.
double UnderTheirErrors(const RefinedFit& refined, const RefineProblem& wide, const RefineEnd& free,
                        const RefineOptions& how, int extra, int spare, double p) {
  const PreparedFit& fit = refined.prepared;
  const std::optional<FoundErrors> found = FindErrors(wide, fit.fitted(), free);
  if (!found || found->gain <= kGainToBelieve) return p;
  const RefineProblem beyond =
      WeighByErrors(wide, fit.fitted(), {ErrorKind::kField, found->sizes, "field"}, free.p);
  RefineProblem within = beyond;
  within.lower = fit.problem.lower;
  within.upper = fit.problem.upper;
  const RefineEnd bound = Refine(within, refined.end.p, how);
  const double lowest =
      std::min(Refine(beyond, free.p, how).mean_square, Refine(beyond, bound.p, how).mean_square);
  return PValue(beyond, bound.mean_square, lowest, extra, spare);
}

}  // namespace

RefutedBounds FindRefutedBounds(const RefinedFit& refined, const ProgressReporter& progress) {
  if (progress.stop().requested()) return {};
  const PreparedFit& fit = refined.prepared;
  const RefineEnd& end = refined.end;
  const std::vector<int> at_bound = AtBound(fit, end);
  if (at_bound.empty()) return {};
  const RefineProblem wide = WithRoom(refined.problem, at_bound, fit.steepest_n);
  RefineOptions how;
  how.stop = progress.stop();
  RefineEnd free = Refine(wide, end.p, how);
  if (!free.converged) {  // it may creep
    RefineEnd other = RefineFrom(wide, end.p, how);
    if (other.mean_square < free.mean_square) free = std::move(other);
  }
  const int extra = static_cast<int>(at_bound.size());
  const int spare = fit.readings() - fit.free_parameters;
  double p = PValue(wide, end.mean_square, free.mean_square, extra, spare);
  if (p < kRefutedAt && refined.problem.errors == nullptr) {
    p = UnderTheirErrors(refined, wide, free, how, extra, spare, p);
  }
  if (!(p < kRefutedAt)) return {};
  RefutedBounds refuted;
  std::string where, room;
  for (const int i : at_bound) {
    const ParameterBounds& bounds = fit.bounds[i];
    const std::string& symbol = fit.device.parameters[i].symbol;
    const bool low = end.p[i] <= bounds.lower;
    where += fmt::format("{}{} = {:g}, its {} bound", where.empty() ? "" : ", ", symbol, end.p[i],
                         low ? "lower" : "upper");
    const std::pair<double, double> wider = {low ? wide.lower[i] : bounds.lower,
                                             low ? bounds.upper : wide.upper[i]};
    room += fmt::format("{}--bound {}={:g}:{:g}", room.empty() ? "" : " ", symbol, wider.first,
                        wider.second);
    refuted.wider[symbol] = wider;
  }
  refuted.test = fmt::format(
      "the readings refute {} (with more room the RMSE falls from {:.3g} to {:.3g} A, p = {:.1g})",
      where, std::sqrt(end.mean_square), std::sqrt(free.mean_square), p);
  refuted.because = fmt::format(
      "{}: the other parameters make up for it, and no interval would hold the truth; allow more "
      "with {}, or check temperature, number of cells and model",
      refuted.test, room);
  return refuted;
}

}  // namespace lyrefit
