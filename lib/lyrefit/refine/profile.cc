#include "lyrefit/refine/profile.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/refine/coordinates.h"
#include "lyrefit/refine/separable.h"

namespace lyrefit {
namespace {

constexpr int kMaxRefits = 32;
constexpr int kGridStarts = 1;
constexpr int kProposals = 8;       // then by bisection
constexpr int kMaxIterations = 20;  // of one refit
constexpr int kMaxRounds = 3;
constexpr int kThoroughIterations = 200;  // of those that have the last word on an end
constexpr int kThoroughRounds = 10;
constexpr double kHopeless = 10;  // of t: no exchange of diodes brings a saturation current so far
constexpr double kCloseEnough = 0.003;  // of t
constexpr double kBetter = 1e-7;  // relative decrease of the mean square that tells a new optimum
// What a refit may still fall by when it ends, in parts of the rise that is looked for.
constexpr double kSlack = 1e-3;
constexpr double kLoosest = 1e-6;  // the same in parts of the mean square, at most

// The scale on which a profile is closest to a straight line: ln Is, 1 / Rsh, the rest as they are.
double ToScale(int i, double value) {
  if (Coordinates::IsSaturation(i)) return std::log(value);
  return i == kRsh ? 1 / value : value;
}
double FromScale(int i, double scaled) {
  if (Coordinates::IsSaturation(i)) return std::exp(scaled);
  return i == kRsh ? 1 / scaled : scaled;
}

class Side {
 public:
  Side(const RefineProblem& problem, const RefineEnd& best, const ProfileQuery& query,
       const std::function<bool()>& stop)
      : problem_(problem),
        best_(best),
        query_(query),
        warm_(best.p),
        looked_for_(query.t * query.t / query.degrees_of_freedom) {
    how_.function_tolerance = std::min(kSlack * looked_for_, kLoosest);
    how_.max_iterations = kMaxIterations;
    how_.max_rounds = kMaxRounds;
    how_.let_diodes_in = false;  // the descent before it does that
    how_.stop = [this, &stop] { return stopped_ = stopped_ || (stop && stop()); };
  }

  ProfileSide Find() {
    const int i = query_.parameter;
    const double bound = query_.upper ? problem_.upper[i] : problem_.lower[i];
    side_.value = bound;
    side_.at_bound = true;
    if (best_.p[i] == bound) return Finish();
    how_.enough = best_.mean_square * (1 + looked_for_);
    if (Rise(bound) <= query_.t * (1 + 1e-9)) return Finish();
    how_.enough = 0;
    side_.at_bound = false;
    const double start = StartOnScale(bound);
    const bool unbounded = bound <= 0 && Coordinates::IsSaturation(i);
    const double end = unbounded ? start - 60 : ToScale(i, bound);
    double far = end;     // where the rise is above t
    double near = start;  // where it is below
    double x = FirstGuess(start, far);
    warm_ = best_.p;
    side_.settled = false;
    while (side_.refits < kMaxRefits && !Ended()) {
      const double rise = Rise(FromScale(i, x));
      (rise > query_.t ? far : near) = x;
      side_.settled = std::fabs(rise - query_.t) < kCloseEnough * query_.t;
      // Where the refits jump from one valley to another there is no place at the threshold.
      if (!side_.settled && Length(near, far) < kCloseEnough * Length(start, far)) {
        side_.settled = true;
        x = far;
      }
      if (side_.settled && IsOutside(FromScale(i, x))) break;
      if (side_.settled) {
        side_.settled = false;
        near = x;
        far = end;
        x = 0.5 * (near + far);
        continue;
      }
      // The rise is close to proportional to the distance; fall back on bisection outside the
      // bracket.
      const double proposal = start + (x - start) * query_.t / std::max(rise, 0.05 * query_.t);
      const bool inside = std::min(near, far) < proposal && proposal < std::max(near, far);
      x = inside && side_.refits < kProposals ? proposal : 0.5 * (near + far);
    }
    if (side_.settled) side_.value = FromScale(i, x);
    if (!side_.settled && !unbounded) side_.value = FromScale(i, far);
    return Finish();
  }

 private:
  bool Ended() const { return stopped_ || (query_.end_at_better && !side_.better.empty()); }

  // Distance of two places on the scale; of saturation currents in ampere, since the logarithm of a
  // vanished one is far from anything.
  double Length(double a, double b) const {
    const bool saturation = Coordinates::IsSaturation(query_.parameter);
    return saturation ? std::fabs(std::exp(a) - std::exp(b)) : std::fabs(a - b);
  }

  // Whether no start that needs no luck leads into a valley below the threshold either. What a
  // single diode does has one valley.
  bool IsOutside(double value) {
    if (DiodeCount(problem_.device) == 1) return true;
    const RefineProblem held = Held(value);
    std::vector<double> start = best_.p;
    start[query_.parameter] = value;
    RefineOptions how = how_;
    how.max_iterations = kThoroughIterations;
    how.max_rounds = kThoroughRounds;
    how.let_diodes_in = true;
    how.enough = best_.mean_square * (1 + looked_for_ * (1 - 2 * kCloseEnough));
    std::vector<std::vector<double>> starts = {start};
    for (const SeparableStart& grid : SeparableStarts(held, best_.p[kRs], kGridStarts)) {
      starts.push_back(grid.p);
    }
    for (const std::vector<double>& from : starts) {
      RefineEnd end = RefineFrom(held, from, how);
      if (end.mean_square > how.enough) continue;
      warm_ = std::move(end.p);
      return false;
    }
    return true;
  }

  RefineProblem Held(double value) const {
    RefineProblem held = problem_;
    held.lower[query_.parameter] = held.upper[query_.parameter] = value;
    return held;
  }

  ProfileSide Finish() {
    side_.settled = side_.settled && !Ended();
    return std::move(side_);
  }

  // The optimum on the scale, moved inside where it has no place there (a vanished diode).
  double StartOnScale(double bound) const {
    const int i = query_.parameter;
    const bool vanished = Coordinates::IsSaturation(i) && best_.p[i] <= 0;
    return ToScale(i, vanished ? 1e-12 * bound : best_.p[i]);
  }

  double FirstGuess(double start, double far) const {
    const int i = query_.parameter;
    double step = query_.standard_error;
    if (Coordinates::IsSaturation(i)) step /= best_.p[i];
    if (i == kRsh) step /= best_.p[i] * best_.p[i];
    step *= query_.t;
    const double room = std::fabs(far - start);
    if (!(step > 0) || step > 0.5 * room) step = 0.1 * room;
    return far > start ? start + step : start - step;
  }

  // sqrt of the rise of the refitted sum of squares in units of the residual variance.
  double Rise(double value) {
    const int i = query_.parameter;
    ++side_.refits;
    const RefineProblem held = Held(value);
    std::vector<double> start = warm_;
    start[i] = value;
    RefineEnd end = RefineFrom(held, start, how_);
    // Before a place counts as outside: the diodes may have changed their parts there.
    const double hopeless = Coordinates::IsSaturation(i) ? kHopeless * query_.t : HUGE_VAL;
    const double outside = (1 - kCloseEnough) * query_.t;
    for (int d = 0; d < DiodeCount(problem_.device); ++d) {
      if (!(RiseOf(end) > outside && RiseOf(end) < hopeless)) break;
      if (!TradePlaces(d, &start)) continue;
      start[i] = value;
      RefineEnd other = Refine(held, start, how_);
      if (other.mean_square < end.mean_square) end = std::move(other);
    }
    if (end.mean_square < lowest_ * (1 - kBetter)) {
      lowest_ = end.mean_square;
      side_.better = end.p;
    }
    const double rise = RiseOf(end);
    warm_ = std::move(end.p);
    return rise;
  }

  double RiseOf(const RefineEnd& end) const {
    const double rise = (end.mean_square / best_.mean_square - 1) * query_.degrees_of_freedom;
    return std::sqrt(std::max(rise, 0.0));
  }

  // The optimum with the diode of the profiled parameter and diode d exchanged, where both have the
  // same bounds.
  bool TradePlaces(int d, std::vector<double>* p) const {
    const int i = query_.parameter;
    if (!Coordinates::IsSaturation(i) && !Coordinates::IsIdeality(i)) return false;
    const int own = Coordinates::IsSaturation(i) ? i : i - 1;
    const int other = SaturationCurrentIndex(d);
    if (own == other) return false;
    *p = best_.p;
    for (const int k : {0, 1}) {
      if (problem_.lower[own + k] != problem_.lower[other + k]) return false;
      if (problem_.upper[own + k] != problem_.upper[other + k]) return false;
      std::swap((*p)[own + k], (*p)[other + k]);
    }
    return true;
  }

  const RefineProblem& problem_;
  const RefineEnd& best_;
  const ProfileQuery& query_;
  std::vector<double> warm_;
  double looked_for_;  // rise of the mean square at the end of the interval, relative
  double lowest_ = best_.mean_square;
  bool stopped_ = false;
  RefineOptions how_;
  ProfileSide side_;
};

}  // namespace

ProfileSide FindProfileSide(const RefineProblem& problem, const RefineEnd& best,
                            const ProfileQuery& query, const std::function<bool()>& stop) {
  return Side(problem, best, query, stop).Find();
}

}  // namespace lyrefit
