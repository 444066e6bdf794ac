#include "lyrefit/refine/profile.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/refine/coordinates.h"

namespace lyrefit {
namespace {

constexpr int kMaxRefits = 32;
constexpr int kProposals = 8;           // then by bisection
constexpr double kBeyond = 1.1;         // of the way: the next place after one found to be inside
constexpr double kCloseEnough = 0.003;  // of t
constexpr double kBetter = 1e-7;  // relative decrease of the mean square that tells a new optimum
// What a refit may still fall by when it ends, in parts of the rise that is looked for.
constexpr double kSlack = 1e-3;
constexpr double kLoosest = 1e-6;    // the same in parts of the mean square, at most
constexpr double kEndless = 60;      // logarithm that stands for an infinite way
constexpr double kVanished = 1e-12;  // of its bound: where a saturation current of 0 is begun from

class Side {
 public:
  Side(const FitModel& model, const RefineEnd& best, const ProfileQuery& query,
       const ProfileRefits& refits)
      : best_(best),
        query_(query),
        refits_(refits),
        parameter_(model.shape().parameters[query.parameter]),
        bounds_(BoundsAt(model.shape(), query.parameter, best.p)),
        unit_(query.variance / model.shape().points),
        rise_at_end_(query.t * query.t * unit_),
        tolerance_(std::min(kSlack * rise_at_end_ / best.mean_square, kLoosest)),
        warm_(best),
        lowest_(best.mean_square) {}

  ProfileSide Find() {
    const double bound = query_.upper ? bounds_.high : bounds_.low;
    // A saturation current that neither may vanish nor is bounded has no end.
    const bool zero = IsSaturation() && bound <= 0;
    const bool tried = std::isfinite(Scaled(bound)) || (zero && parameter_.may_vanish);
    side_.value = bound;
    side_.at_bound = true;
    if (best_.p[query_.parameter] == bound) return Finish();
    if (tried && Rise(bound, best_.mean_square + rise_at_end_) <= query_.t * (1 + 1e-9)) {
      return Finish();
    }
    side_.at_bound = false;
    const double start = StartOnScale(bound);
    const bool endless = zero || !std::isfinite(bound);
    const double end = endless ? start + (query_.upper ? kEndless : -kEndless) : Scaled(bound);
    warm_ = best_;
    Approach(start, end);
    if (!side_.settled && !endless) side_.value = Natural(far_);
    return Finish();
  }

 private:
  bool IsSaturation() const { return parameter_.kind == ParameterKind::kSaturation; }
  bool Ended() const { return side_.stopped || (query_.end_at_better && !side_.better.empty()); }
  double Scaled(double value) const { return ToScale(parameter_.kind, value); }
  double Natural(double x) const { return FromScale(parameter_.kind, x); }

  ProfileSide Finish() {
    side_.settled = side_.settled && !Ended();
    return std::move(side_);
  }

  // The crossing between the optimum and `end`, where the rise is above t.
  void Approach(double start, double end) {
    far_ = end;           // where the rise is above t
    double near = start;  // where it is below
    double x = FirstGuess(start, end);
    int bisect_after = kProposals;
    side_.settled = false;
    while (side_.refits < kMaxRefits && !Ended()) {
      const double rise = Rise(Natural(x), 0);
      (rise > query_.t ? far_ : near) = x;
      side_.settled = std::fabs(rise - query_.t) < kCloseEnough * query_.t;
      // Where the refits jump from one valley to another there is no place at the threshold.
      if (!side_.settled && Length(near, far_) < kCloseEnough * Length(start, far_)) {
        side_.settled = true;
        x = far_;
      }
      if (side_.settled && !InsideElsewhere(Natural(x))) break;
      if (side_.settled) {
        side_.settled = false;
        near = x;
        far_ = end;
        x = start + kBeyond * (x - start);
        bisect_after = side_.refits + kProposals;
        if (std::fabs(x - start) >= std::fabs(end - start)) x = 0.5 * (near + far_);
        continue;
      }
      // The rise is close to proportional to the distance; fall back on bisection outside the
      // bracket.
      const double proposal = start + (x - start) * query_.t / std::max(rise, 0.05 * query_.t);
      const bool inside = std::min(near, far_) < proposal && proposal < std::max(near, far_);
      x = inside && side_.refits < bisect_after ? proposal : 0.5 * (near + far_);
    }
    if (side_.settled) side_.value = Natural(x);
  }

  // Distance of two places on the scale; of saturation currents in ampere, since the logarithm of a
  // vanished one is far from anything.
  double Length(double a, double b) const {
    return IsSaturation() ? std::fabs(std::exp(a) - std::exp(b)) : std::fabs(a - b);
  }

  // The optimum on the scale, moved inside where it has no place there (a vanished diode).
  double StartOnScale(double bound) const {
    const double value = best_.p[query_.parameter];
    return Scaled(IsSaturation() && value <= 0 ? kVanished * bound : value);
  }

  double FirstGuess(double start, double far) const {
    double step =
        query_.t * StepOnScale(parameter_.kind, best_.p[query_.parameter], query_.standard_error);
    const double room = std::fabs(far - start);
    if (!(step > 0) || step > 0.5 * room) step = 0.1 * room;
    return far > start ? start + step : start - step;
  }

  // sqrt of the rise of the refitted sum of squares in units of the variance.
  double Rise(double value, double enough) {
    ++side_.refits;
    RefineEnd end = refits_.refit(value, warm_, enough, tolerance_);
    side_.stopped = side_.stopped || end.stopped;
    if (end.mean_square < lowest_ * (1 - kBetter)) {
      lowest_ = end.mean_square;
      side_.better = end.p;
    }
    const double rise = (end.mean_square - best_.mean_square) / unit_;
    warm_ = std::move(end);
    return std::sqrt(std::max(rise, 0.0));
  }

  bool InsideElsewhere(double value) {
    if (!refits_.elsewhere) return false;
    const double enough = best_.mean_square + rise_at_end_ * (1 - 2 * kCloseEnough);
    return refits_.elsewhere(value, enough, tolerance_, &warm_);
  }

  const RefineEnd& best_;
  const ProfileQuery& query_;
  const ProfileRefits& refits_;
  const FitParameter& parameter_;
  const ParameterRange bounds_;
  const double unit_;         // of the squared rise, in mean squares
  const double rise_at_end_;  // of the mean square
  const double tolerance_;
  FitPoint warm_;
  double lowest_;
  double far_ = 0;
  ProfileSide side_;
};

}  // namespace

ProfileSide FindProfileSide(const FitModel& model, const RefineEnd& best, const ProfileQuery& query,
                            const ProfileRefits& refits) {
  return Side(model, best, query, refits).Find();
}

}  // namespace lyrefit
