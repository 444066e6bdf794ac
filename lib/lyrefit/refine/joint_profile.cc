#include "lyrefit/refine/joint_profile.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/refine/joint_coordinates.h"

namespace lyrefit {
namespace {

constexpr int kMaxJointRefits = 20;
constexpr double kCloseEnoughJoint = 0.005;  // of t

class JointSide {
 public:
  JointSide(const JointProblem& problem, const JointEnd& best, const JointProfileQuery& query)
      : problem_(problem), best_(best), query_(query), warm_(best.point) {}

  JointProfileSide Find() {
    const double start = ToScale(best_.point.shared[query_.parameter]);
    const double bound = BoundOnScale();
    side_.at_bound = true;
    side_.value = FromScale(bound);
    const bool finite = std::isfinite(bound);
    if (finite && (start == bound || Rise(bound) <= query_.t)) return side_;
    side_.at_bound = false;
    double near = start;
    double far = bound;
    double x = FirstGuess(start, far);
    warm_ = best_.point;
    while (side_.refits < kMaxJointRefits && !side_.stopped) {
      const double rise = Rise(x);
      if (std::fabs(rise - query_.t) < kCloseEnoughJoint * query_.t) break;
      (rise > query_.t ? far : near) = x;
      const double proposal = start + (x - start) * query_.t / std::max(rise, 0.1 * query_.t);
      const bool inside = std::min(near, far) < proposal && proposal < std::max(near, far);
      x = inside ? proposal : 0.5 * (near + far);
    }
    side_.value = FromScale(x);
    return side_;
  }

 private:
  bool IsSaturation() const {
    const Translation& at = problem_.translation;
    return query_.parameter == at.saturation_current || query_.parameter == at.saturation_current_2;
  }
  bool IsShunt() const {
    const Translation& at = problem_.translation;
    return query_.parameter == at.resistance_shunt || query_.parameter == at.resistance_shunt_dark;
  }

  // Where a profile is closest to a straight line; a shunt's conductance rises as it falls.
  double ToScale(double value) const {
    if (IsSaturation()) return std::log(value);
    return IsShunt() ? 1 / value : value;
  }
  double FromScale(double x) const {
    if (IsSaturation()) return std::exp(x);
    return IsShunt() ? 1 / x : x;
  }
  bool Upwards() const { return query_.upper != IsShunt(); }

  double BoundOnScale() const {
    const int i = query_.parameter;
    if (IsSaturation()) return Upwards() ? HUGE_VAL : -HUGE_VAL;
    if (!IsShunt()) return query_.upper ? problem_.upper[i] : problem_.lower[i];
    const double least = 1e-9 * problem_.current_scale_A / problem_.voltage_scale_V;
    if (i == problem_.translation.resistance_shunt_dark) {  // relative to the other shunt
      const std::vector<double>& shared = best_.point.shared;
      const double shunt = shared[problem_.translation.resistance_shunt];
      const double most = shunt * std::exp(shared[problem_.translation.shunt_exponent]);
      return 1 / (query_.upper ? most : shunt);
    }
    return query_.upper ? least : 1 / std::max(problem_.lower[i], 1e-9);
  }

  double FirstGuess(double start, double far) const {
    const double value = best_.point.shared[query_.parameter];
    double step = query_.t * query_.standard_error;
    if (IsSaturation()) step /= value;
    if (IsShunt()) step /= value * value;
    if (!(step > 0)) step = 0.1 * (std::fabs(start) + 1e-12);
    if (std::isfinite(far)) step = std::min(step, 0.5 * std::fabs(far - start));
    return start + (Upwards() ? step : -step);
  }

  // sqrt of the rise of the refitted sum of squares, priors included, in units of the variance.
  double Rise(double x) {
    ++side_.refits;
    const int i = query_.parameter;
    JointProblem held = problem_;
    held.lower[i] = held.upper[i] = FromScale(x);
    JointPoint start = warm_;
    start.shared[i] = held.lower[i];
    JointOptions options;
    options.proceed = query_.proceed;
    JointEnd end = RefineJointly(held, start, options);
    side_.stopped = end.stopped;
    const double rise =
        (end.squares + end.prior_squares - best_.squares - best_.prior_squares) / query_.variance;
    warm_ = std::move(end.point);
    return std::sqrt(std::max(rise, 0.0));
  }

  const JointProblem& problem_;
  const JointEnd& best_;
  const JointProfileQuery& query_;
  JointPoint warm_;
  JointProfileSide side_;
};

}  // namespace

JointProfileSide FindJointProfileSide(const JointProblem& problem, const JointEnd& best,
                                      const JointProfileQuery& query) {
  return JointSide(problem, best, query).Find();
}

}  // namespace lyrefit
