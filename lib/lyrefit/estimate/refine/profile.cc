#include "lyrefit/estimate/refine/profile.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/estimate/refine/coordinates.h"

namespace lyrefit {
namespace {

constexpr int kMaxRefits = 32;
constexpr int kProposals = 8;           // the search then bisects
constexpr double kLeastRise = 0.05;     // of t; smaller rises are replaced by it
constexpr double kLongest = 3;          // of the last step; limit of linear extrapolation
constexpr double kBeyond = 1.1;         // of the step; distance of the next trial after one inside
constexpr double kCloseEnough = 0.003;  // of t
constexpr double kBetter = 1e-7;        // relative decrease of the mean square at a new optimum
// Function tolerance of a refit, as part of the rise at the end.
constexpr double kSlack = 1e-3;
constexpr double kLoosest = 1e-7;    // upper limit of it, as part of the mean square
constexpr double kEndless = 60;      // logarithm that replaces an infinite distance
constexpr double kVanished = 1e-12;  // of its bound: start of a saturation current of 0

class Side {
 public:
  Side(const FitModel& model, const RefineEnd& best, const ProfileQuery& query,
       const ProfileRefits& refits)
      : model_(model),
        best_(best),
        query_(query),
        refits_(refits),
        parameter_(model.shape().parameters[query.parameter]),
        bounds_(BoundsAt(model.shape(), query.parameter, best.p)),
        unit_(query.variance / model.shape().points),
        rise_at_end_(query.t * query.t * unit_),
        target_(best.mean_square + rise_at_end_ * (1 - 2 * kCloseEnough)),
        tolerance_(std::min(kSlack * rise_at_end_ / best.mean_square, kLoosest)),
        lowest_(best.mean_square) {}

  ProfileSide Find() {
    bound_ = query_.upper ? bounds_.high : bounds_.low;
    // A saturation current that has no upper bound, or may not be 0, has no end.
    const bool zero = IsSaturation() && bound_ <= 0;
    bound_counts_ = std::isfinite(Scaled(bound_)) || (zero && parameter_.may_vanish);
    side_.value = bound_;
    side_.at_bound = true;
    const FitPoint& from = Outermost();
    if (from.p[query_.parameter] == bound_) return Finish();
    if (bound_counts_ &&
        Rise(bound_, from, best_.mean_square + rise_at_end_) <= query_.t * (1 + 1e-9))
      return Finish();
    side_.at_bound = false;
    const double start = StartOnScale(from.p[query_.parameter]);
    const bool endless = zero || !std::isfinite(bound_);
    path_ = {{start, RootOfRise(model_.MeanSquare(from)), from}};
    Approach(start, endless ? start + (query_.upper ? kEndless : -kEndless) : Scaled(bound_));
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

  // A point of the path of refits from the optimum.
  struct Place {
    double x;     // of the parameter, on its scale
    double rise;  // root of the rise, in units of the variance
    FitPoint at;
  };

  // One end of the bracket of the crossing: the parameter on its scale, and the logarithm of rise /
  // t there. Infinite at the optimum and if not evaluated.
  struct Mark {
    double x;
    double log_rise;
  };

  // The optimum inside the interval that lies furthest out.
  const FitPoint& Outermost() const {
    const FitPoint* outermost = &best_;
    for (const FitPoint& local_optimum : query_.local_optima) {
      if (!(RootOfRise(model_.MeanSquare(local_optimum)) < query_.t)) continue;
      const double value = local_optimum.p[query_.parameter],
                   so_far = outermost->p[query_.parameter];
      if (query_.upper ? value > so_far : value < so_far) outermost = &local_optimum;
    }
    return *outermost;
  }

  // Finds the crossing between the optimum and `end`, where the rise is above t.
  void Approach(double start, double end) {
    Mark near{start, -HUGE_VAL}, far{end, HUGE_VAL};
    double x = FirstGuess(start, end);
    int bisect_after = kProposals, last_moved = 0;
    side_.settled = false;
    while (side_.refits < kMaxRefits && !Ended()) {
      const double rise = Rise(Natural(x), Ahead(x), 0);
      path_.push_back({x, rise, last_});
      const int moved = rise > query_.t ? 1 : -1;
      const double part = std::max(rise / query_.t, kLeastRise);
      Mark& mark = moved > 0 ? far : near;
      mark.x = x;
      mark.log_rise = std::log(part);
      // Halves the value of an end that stays twice (the Illinois rule); otherwise one side would
      // creep.
      if (moved == last_moved) (moved > 0 ? near : far).log_rise *= 0.5;
      last_moved = moved;
      side_.settled = std::fabs(rise - query_.t) < kCloseEnough * query_.t;
      // If the refits jump between local optima, no point reaches the threshold exactly.
      if (!side_.settled && Length(near.x, far.x) < kCloseEnough * Length(start, far.x)) {
        if (!std::isfinite(far.log_rise) && BoundIsInside()) return;
        side_.settled = true;
        x = far.x;
      }
      if (side_.settled && !InsideElsewhere(Natural(x))) break;
      if (side_.settled) {
        if (BoundIsInside()) return;
        side_.settled = false;
        near = {x, -HUGE_VAL};
        far = {end, HUGE_VAL};
        last_moved = 0;
        x = start + kBeyond * (x - start);
        bisect_after = side_.refits + kProposals;
        if (std::fabs(x - start) >= std::fabs(end - start)) x = 0.5 * (near.x + far.x);
        continue;
      }
      // A proposal outside the bracket is replaced by its middle.
      const double proposal = Proposal(near, far);
      const bool inside = std::min(near.x, far.x) < proposal && proposal < std::max(near.x, far.x);
      x = inside && side_.refits < bisect_after ? proposal : 0.5 * (near.x + far.x);
    }
    if (side_.settled || far.log_rise < HUGE_VAL) side_.value = Natural(side_.settled ? x : far.x);
  }

  // Predicted point with a rise of t. Between two points: linear in their logarithms. From the
  // optimum: the rise is nearly proportional to the distance, and their ratio changes linearly.
  double Proposal(const Mark& near, const Mark& far) const {
    if (std::isfinite(near.log_rise) && std::isfinite(far.log_rise)) {
      const double part = near.log_rise / (near.log_rise - far.log_rise);
      return near.x + part * (far.x - near.x);
    }
    const Place& one = path_.back();
    const Place& before = path_[path_.size() - 2];
    const double start = path_.front().x, least = kLeastRise * query_.t;
    double ratio = (one.x - start) / std::max(one.rise, least);
    if (std::min(one.rise, before.rise) > least && one.rise != before.rise) {
      const double change = ratio - (before.x - start) / before.rise;
      const double part = (query_.t - one.rise) / (one.rise - before.rise) * change / ratio;
      ratio *= 1 + std::min(std::max(part, -0.5), 0.5);
    }
    return start + ratio * query_.t;
  }

  // Start of the refit at x: the linear extrapolation of the last two points, or any point of the
  // path, whichever has the lowest mean square there.
  FitPoint Ahead(double x) const {
    FitPoint lowest;
    double least = HUGE_VAL;
    const auto consider = [&](FitPoint from) {
      from.p[query_.parameter] = Natural(x);
      const double mean_square = model_.MeanSquare(from);
      if (!lowest.p.empty() && !(mean_square < least)) return;
      least = mean_square;
      lowest = std::move(from);
    };
    for (const Place& place : path_) consider(place.at);
    if (path_.size() > 1) consider(OnLine(path_[path_.size() - 2], path_.back(), x));
    return lowest;
  }

  FitPoint OnLine(const Place& before, const Place& one, double x) const {
    const double part = (x - one.x) / (one.x - before.x);
    FitPoint ahead = one.at;
    if (!(std::fabs(part) <= kLongest)) return ahead;
    for (int j = 0; j < model_.shape().size(); ++j) {
      const ParameterKind kind = model_.shape().parameters[j].kind;
      const double to = ToScale(kind, one.at.p[j]);
      const double next = FromScale(kind, to + part * (to - ToScale(kind, before.at.p[j])));
      if (!std::isfinite(next)) continue;  // parameter of a dropped diode
      const ParameterRange range = BoundsAt(model_.shape(), j, ahead.p);
      ahead.p[j] = std::min(std::max(next, range.low), range.high);
    }
    for (std::size_t k = 0; k < ahead.local.size(); ++k) {
      ahead.local[k] += part * (ahead.local[k] - before.at.local[k]);
    }
    return ahead;
  }

  // Distance of two points on the scale. In ampere for saturation currents that may come to 0,
  // since the logarithm of a value near 0 is far from any other.
  double Length(double a, double b) const {
    const bool ampere = IsSaturation() && !(parameter_.lower > 0);
    return ampere ? std::fabs(std::exp(a) - std::exp(b)) : std::fabs(a - b);
  }

  // The optimum on the scale; a dropped diode, which has no value there, starts at kVanished.
  double StartOnScale(double value) const {
    return Scaled(IsSaturation() && value <= 0 ? kVanished * bound_ : value);
  }

  double FirstGuess(double start, double far) const {
    double step =
        query_.t * StepOnScale(parameter_.kind, best_.p[query_.parameter], query_.standard_error);
    const double room = std::fabs(far - start);
    if (!(step > 0) || step > 0.5 * room) step = 0.1 * room;
    return far > start ? start + step : start - step;
  }

  // Square root of the rise of the refitted sum of squares, in units of the variance.
  double Rise(double value, const FitPoint& from, double target) {
    ++side_.refits;
    RefineEnd end = refits_.refit(value, from, target, tolerance_);
    side_.stopped = side_.stopped || end.stopped;
    if (end.mean_square < lowest_ * (1 - kBetter)) {
      lowest_ = end.mean_square;
      side_.better = end.p;
    }
    const double rise = RootOfRise(end.mean_square);
    last_ = std::move(end);
    return rise;
  }

  double RootOfRise(double mean_square) const {
    return std::sqrt(std::max((mean_square - best_.mean_square) / unit_, 0.0));
  }

  // Whether refits from other starts have a rise below t; their end is added to the path.
  bool InsideElsewhere(double value) {
    FitPoint there;
    const bool inside = refits_.elsewhere && refits_.elsewhere(value, target_, tolerance_, &there);
    if (!inside && !InsideOtherOptimum(value, &there)) return false;
    const double rise = RootOfRise(model_.MeanSquare(there));
    path_.push_back({Scaled(value), rise, std::move(there)});
    return true;
  }

  bool InsideOtherOptimum(double value, FitPoint* there) {
    if (query_.local_optima.empty()) return false;
    std::vector<const FitPoint*> optima = {&best_};
    for (const FitPoint& local_optimum : query_.local_optima) optima.push_back(&local_optimum);
    return std::any_of(optima.begin(), optima.end(), [&](const FitPoint* from) {
      RefineEnd end = refits_.refit(value, *from, target_, tolerance_);
      const bool inside = end.mean_square <= target_;
      if (inside) *there = std::move(end);
      return inside;
    });
  }

  // Refits at the bound again with the path's points as starts: the data may be compatible with it.
  bool BoundIsInside() {
    const bool inside = bound_counts_ && InsideElsewhere(bound_);
    if (inside) {
      side_.value = bound_;
      side_.at_bound = side_.settled = true;
    }
    return inside;
  }

  const FitModel& model_;
  const RefineEnd& best_;
  const ProfileQuery& query_;
  const ProfileRefits& refits_;
  const FitParameter& parameter_;
  const ParameterRange bounds_;
  const double unit_;         // of the squared rise, in mean squares
  const double rise_at_end_;  // of the mean square
  const double target_;       // mean square that is certainly inside
  const double tolerance_;
  FitPoint last_;            // end of the last refit
  std::vector<Place> path_;  // the optimum, then the refits on the way to the crossing
  double lowest_;
  double bound_ = 0;
  bool bound_counts_ = false;  // whether refits at the bound are possible
  ProfileSide side_;
};

// A model with one parameter that is fixed at changing values.
class FixedModel : public FitModel {
 public:
  explicit FixedModel(const FitModel& free) : FitModel(free.shape()), free_(free) {}

  bool Evaluate(int block, const double* p, const double* local, double* residuals, double* slopes,
                double* local_slopes) const override {
    return free_.Evaluate(block, p, local, residuals, slopes, local_slopes);
  }
  double MeanSquare(const FitPoint& point) const override { return free_.MeanSquare(point); }

 private:
  const FitModel& free_;
};

}  // namespace

RefineOptions ProfileOptions(const StopToken& stop) {
  RefineOptions how;
  how.small = true;
  how.add_diodes = false;
  how.max_rounds = 10;
  how.max_iterations = how.first_iterations = 200;
  how.stop = stop;
  return how;
}

ProfileSide FindProfileSide(const FitModel& model, const RefineEnd& best, const ProfileQuery& query,
                            const ProfileRefits& refits) {
  return Side(model, best, query, refits).Find();
}

ProfileSide FindProfileSide(const FitModel& model, const RefineEnd& best, const ProfileQuery& query,
                            RefineOptions how) {
  FixedModel fixed(model);
  const auto refit = [&](double value, FitPoint start, double target, double tolerance) {
    fixed.Fix(query.parameter, value);
    start.p[query.parameter] = value;
    how.target = target;
    how.function_tolerance = tolerance;
    if (how.small) how.first_tolerance = tolerance;
    return RefineModel(fixed, std::move(start), how);
  };
  return FindProfileSide(model, best, query, {refit, nullptr});
}

}  // namespace lyrefit
