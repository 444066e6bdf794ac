#include <cmath>
#include <utility>

#include "lyrefit/refine/curve_model.h"
#include "lyrefit/refine/profile.h"
#include "lyrefit/refine/refine.h"
#include "lyrefit/refine/separable.h"

namespace lyrefit {
namespace {

constexpr int kGridStarts = 1;
constexpr int kMaxIterations = 20;  // of one refit
constexpr int kMaxRounds = 3;
constexpr int kThoroughIterations = 200;  // of those that have the last word on an end
constexpr int kThoroughRounds = 10;
constexpr double kHopeless = 10;   // of t: no exchange of diodes brings a saturation current so far
constexpr double kInside = 0.994;  // of the rise at the end: so far from it no exchange matters

RefineProblem Held(const RefineProblem& problem, int i, double value) {
  RefineProblem held = problem;
  held.lower[i] = held.upper[i] = value;
  return held;
}

// The optimum with the diode of parameter i and diode d exchanged, where both have the same bounds.
bool TradePlaces(const RefineProblem& problem, int i, int d, std::vector<double>* p) {
  const ParameterKind kind = problem.device.parameters[i].kind;
  const bool saturation = kind == ParameterKind::kSaturation;
  if (!saturation && kind != ParameterKind::kIdeality) return false;
  const int own = saturation ? i : i - 1;
  const int other = SaturationCurrentIndex(d);
  if (own == other) return false;
  for (const int k : {0, 1}) {
    if (problem.lower[own + k] != problem.lower[other + k]) return false;
    if (problem.upper[own + k] != problem.upper[other + k]) return false;
    std::swap((*p)[own + k], (*p)[other + k]);
  }
  return true;
}

}  // namespace

ProfileSide FindProfileSide(const RefineProblem& problem, const RefineEnd& best,
                            const ProfileQuery& query, const std::function<bool()>& stop) {
  const CurveModel model(problem);
  const int i = query.parameter;
  const bool saturation = problem.device.parameters[i].kind == ParameterKind::kSaturation;
  const double rise = query.t * query.t * query.variance / model.shape().points;
  const double outside = best.mean_square + kInside * rise;
  const double hopeless = saturation ? best.mean_square + kHopeless * kHopeless * rise : HUGE_VAL;
  bool stopped = false;
  RefineOptions how;
  how.max_iterations = kMaxIterations;
  how.max_rounds = kMaxRounds;
  how.let_in = false;  // the descent before it does that
  how.stop = [&] { return stopped = stopped || (stop && stop()); };
  ProfileRefits refits;
  refits.refit = [&](double value, const FitPoint& start, double enough, double tolerance) {
    const RefineProblem held = Held(problem, i, value);
    how.enough = enough;
    how.function_tolerance = tolerance;
    std::vector<double> from = start.p;
    from[i] = value;
    RefineEnd end = RefineFrom(held, from, how);
    // Before a place counts as outside: the diodes may have changed their parts there.
    for (int d = 0; d < DiodeCount(problem.device); ++d) {
      if (!(end.mean_square > outside && end.mean_square < hopeless)) break;
      std::vector<double> traded = best.p;
      if (!TradePlaces(problem, i, d, &traded)) continue;
      traded[i] = value;
      RefineEnd other = Refine(held, traded, how);
      if (other.mean_square < end.mean_square) end = std::move(other);
    }
    end.stopped = stopped;
    return end;
  };
  // Whether a start that needs no luck leads into a valley below the threshold. What a single diode
  // does has one valley.
  if (DiodeCount(problem.device) == 1) return FindProfileSide(model, best, query, refits);
  refits.elsewhere = [&](double value, double enough, double tolerance, FitPoint* there) {
    const RefineProblem held = Held(problem, i, value);
    RefineOptions thorough = how;
    thorough.max_iterations = kThoroughIterations;
    thorough.max_rounds = kThoroughRounds;
    thorough.let_in = true;
    thorough.enough = enough;
    thorough.function_tolerance = tolerance;
    std::vector<std::vector<double>> starts = {best.p};
    starts[0][i] = value;
    for (const SeparableStart& grid : SeparableStarts(held, best.p[kRs], kGridStarts)) {
      starts.push_back(grid.p);
    }
    for (const std::vector<double>& from : starts) {
      RefineEnd end = RefineFrom(held, from, thorough);
      if (end.mean_square > enough) continue;
      *there = std::move(end);
      return true;
    }
    return false;
  };
  return FindProfileSide(model, best, query, refits);
}

}  // namespace lyrefit
