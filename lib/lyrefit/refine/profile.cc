#include "lyrefit/refine/profile.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/refine/coordinates.h"
#include "lyrefit/refine/separable.h"

namespace lyrefit {
namespace {

constexpr int kMaxRefits = 24;
constexpr double kCloseEnough = 0.003;  // of t
constexpr double kBetter = 1e-7;  // relative decrease of the mean square that tells a new optimum

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
  Side(const RefineProblem& problem, const RefineEnd& best, const ProfileQuery& query)
      : problem_(problem), best_(best), query_(query), warm_(best.p) {}

  ProfileSide Find() {
    const int i = query_.parameter;
    const double bound = query_.upper ? problem_.upper[i] : problem_.lower[i];
    side_.value = bound;
    side_.at_bound = true;
    if (best_.p[i] == bound || Rise(bound) <= query_.t) return Finish();
    side_.at_bound = false;
    const double start = StartOnScale(bound);
    const bool unbounded = bound <= 0 && Coordinates::IsSaturation(i);
    double far = unbounded ? start - 60 : ToScale(i, bound);  // where the rise is above t
    double near = start;                                      // where it is below
    double x = FirstGuess(start, far);
    warm_ = best_.p;
    while (side_.refits < kMaxRefits && side_.better.empty()) {
      const double rise = Rise(FromScale(i, x));
      if (std::fabs(rise - query_.t) < kCloseEnough * query_.t) break;
      (rise > query_.t ? far : near) = x;
      // The rise is close to proportional to the distance; fall back on bisection outside the
      // bracket.
      const double proposal = start + (x - start) * query_.t / std::max(rise, 0.05 * query_.t);
      const bool inside = std::min(near, far) < proposal && proposal < std::max(near, far);
      x = inside ? proposal : 0.5 * (near + far);
    }
    side_.value = FromScale(i, x);
    return Finish();
  }

 private:
  ProfileSide Finish() { return std::move(side_); }

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
    RefineProblem held = problem_;
    held.lower[i] = held.upper[i] = value;
    std::vector<double> start = warm_;
    start[i] = value;
    RefineEnd end = Refine(held, SeparableDescent(held, start));
    if (end.mean_square < best_.mean_square * (1 - kBetter)) side_.better = end.p;
    const double rise = (end.mean_square / best_.mean_square - 1) * query_.degrees_of_freedom;
    warm_ = std::move(end.p);
    return std::sqrt(std::max(rise, 0.0));
  }

  const RefineProblem& problem_;
  const RefineEnd& best_;
  const ProfileQuery& query_;
  std::vector<double> warm_;
  ProfileSide side_;
};

}  // namespace

ProfileSide FindProfileSide(const RefineProblem& problem, const RefineEnd& best,
                            const ProfileQuery& query) {
  return Side(problem, best, query).Find();
}

}  // namespace lyrefit
