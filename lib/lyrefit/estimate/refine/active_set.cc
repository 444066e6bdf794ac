#include "lyrefit/estimate/refine/active_set.h"

#include <glog/logging.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "lyrefit/estimate/refine/coordinates.h"
#include "lyrefit/estimate/refine/drop_diode.h"
#include "lyrefit/estimate/refine/solve.h"

namespace lyrefit {
namespace {

// Cosine below which a gradient counts as zero when a bound is released or a diode added.
constexpr double kFlat = 1e-8;
// Limits of released bounds and of added diodes, as multiples of the number of parameters.
constexpr int kMostReleased = 2;
constexpr int kMostAdded = 1;
constexpr double kNoInfluence = 1e-12;  // length of a column, in residuals, without influence
// Relative rise of the mean square, from the lowest point to the end, beyond rounding.
constexpr double kWorse = 1e-9;
constexpr double kNoLoss = 1e-12;  // the same limit when a diode is dropped

class ActiveSet {
 public:
  ActiveSet(const FitModel& model, FitPoint start, const RefineOptions& options)
      : model_(model), shape_(model.shape()), options_(options) {
    CHECK_EQ(static_cast<int>(start.p.size()), shape_.size());
    now_.at = std::move(start);
    now_.at.local.resize(shape_.locals(), 0);
    for (const FitParameter& parameter : shape_.parameters) fixed_.push_back(parameter.fixed());
    now_.active = fixed_;
    refused_.assign(fixed_.size(), false);
    Clamp();
    Measure();
    Remember();
    if (TakeOutFaded()) Measure();
  }

  RefineEnd Run() {
    if (!Ended()) {
      Solve(/*bounded=*/true, std::max(options_.function_tolerance, options_.first_tolerance),
            options_.first_iterations);
      StepBackInside();
    }
    Remember();
    bool settled = options_.small && now_.converged && IsInside() && !AddDiode();
    for (int round = 0; round < options_.max_rounds && !settled && !Ended(); ++round) {
      ActivateBounds();
      if (SolveFree()) {
        KeepIfBetter();
        settled = !ReleaseOne() && !AddDiode();
      }
      Remember();
    }
    return End(settled && now_.converged);
  }

  RefineEnd RunPlainly() {
    Solve(/*bounded=*/true, options_.function_tolerance, options_.max_iterations);
    return End(now_.converged);
  }

 private:
  struct State {
    FitPoint at;
    std::vector<bool> active;
    double mean_square = HUGE_VAL;
    bool converged = false;  // the solve that led here
  };

  int size() const { return shape_.size(); }
  bool Ended() const { return stopped_ || hopeless_ || now_.mean_square <= options_.target; }
  void Measure() { now_.mean_square = model_.MeanSquare(now_.at); }

  void Clamp() {
    std::vector<double>& p = now_.at.p;
    for (int i = 0; i < size(); ++i) {  // each shunt precedes its dark shunt, which depends on it
      const ParameterRange range = BoundsAt(shape_, i, p);
      p[i] = std::min(std::max(p[i], range.low), range.high);
    }
  }

  // The bounded solve has no bounds for a saturation current whose n is free. A diode moved to such
  // a bound keeps its current at the largest voltage as far as its n can compensate.
  void StepBackInside() {
    std::vector<double>& p = now_.at.p;
    const double pivot = shape_.junction_V(p) / shape_.thermal_voltage_V;
    bool outside = false;
    for (int i = 0; i < size(); ++i) {
      const ParameterRange range = BoundsAt(shape_, i, p);
      if (p[i] >= range.low && p[i] <= range.high) continue;
      outside = true;
      if (shape_.parameters[i].kind != ParameterKind::kSaturation || !(p[i] > 0)) continue;
      const double bound = p[i] < range.low ? range.low : range.high;
      double& n = p[shape_.parameters[i].with[0]];
      const double steepness = 1 / n + std::log(p[i] / bound) / pivot;
      if (steepness > 0) n = 1 / steepness;
      p[i] = bound;
    }
    if (!outside) return;
    now_.converged = false;
    Clamp();
    Measure();
  }

  // Fixing and releasing bounds may raise the sum of squares of a curve that the model does not
  // describe.
  void Remember() {
    if (best_.active.empty() || now_.mean_square < best_.mean_square) best_ = now_;
  }

  // Keeps the lowest point with a stable active set. A bound whose release did not lower the sum of
  // squares from there is not released again.
  void KeepIfBetter() {
    if (settled_.active.empty() || now_.mean_square < settled_.mean_square) {
      settled_ = now_;
      refused_.assign(refused_.size(), false);
      return;
    }
    if (last_released_ < 0) return;
    refused_[last_released_] = true;
    last_released_ = -1;
    now_ = settled_;
  }

  RefineEnd End(bool converged) {
    if (!(now_.mean_square <= best_.mean_square * (1 + kWorse))) {
      now_ = best_;
      converged = false;
    }
    RefineEnd end;
    static_cast<FitPoint&>(end) = now_.at;
    end.active = now_.active;
    end.mean_square = now_.mean_square;
    end.iterations = iterations_;
    end.projected_gradient = ProjectedGradient();
    end.converged = converged;
    end.stopped = stopped_;
    return end;
  }

  // One solve over the free parameters; keeps the better of before and after. Returns its
  // coordinates.
  std::vector<double> Solve(bool bounded, double function_tolerance, int max_iterations) {
    const Coordinates coordinates(shape_, now_.at.p, now_.active);
    std::vector<double> theta = coordinates.Start();
    now_.converged = theta.empty() && now_.at.local.empty();
    // No derivatives exist at this point.
    if (now_.converged || !std::isfinite(now_.mean_square)) return theta;
    if (!coordinates.Sane(theta.data())) return theta;
    SolveOptions how;
    how.bounded = bounded;
    how.small = options_.small;
    how.max_iterations = max_iterations;
    how.function_tolerance = function_tolerance;
    how.trust_radius = options_.trust_radius;
    how.unit_A = std::max(std::sqrt(now_.mean_square), 1e-13 * shape_.current_scale_A);
    const double per_unit = shape_.points / (how.unit_A * how.unit_A);
    how.target = options_.target * per_unit;
    how.cutoff = options_.cutoff * per_unit;
    how.stop = options_.stop;
    SolveEnd end = SolveModel(model_, coordinates, now_.at.local, how);
    iterations_ += end.iterations;
    now_.converged = end.converged;
    stopped_ = stopped_ || end.stopped;
    hopeless_ = end.hopeless;
    FitPoint there{std::vector<double>(size()), std::move(end.local)};
    coordinates.ToParameters(end.theta.data(), there.p.data());
    const double mean_square = model_.MeanSquare(there);
    if (!(mean_square <= now_.mean_square)) return theta;
    now_.at = std::move(there);
    now_.mean_square = mean_square;
    return std::move(end.theta);
  }

  // Whether the end of a solve is acceptable: inside the bounds unknown to the solve, and without a
  // diode of negligible current. Parameters at a bound are then active there.
  bool IsInside() {
    FitPoint at = now_.at;
    std::vector<bool> active = now_.active;
    if (RemoveFaded(shape_, &at.p, &active)) return false;
    for (int i = 0; i < size(); ++i) {
      const ParameterRange range = BoundsAt(shape_, i, at.p);
      if (!(at.p[i] >= range.low && at.p[i] <= range.high)) return false;
      active[i] = active[i] || at.p[i] == range.low || at.p[i] == range.high;
    }
    now_.active = std::move(active);
    return true;
  }

  // Sets the parameter of a coordinate to one of its bounds and holds it there.
  void Activate(const Coordinates& coordinates, int k, bool lower) {
    const int i = coordinates.parameter(k);
    now_.at.p[i] = coordinates.AtBound(k, lower, now_.at.p);
    now_.active[i] = true;
  }

  void ActivateBounds() {
    const Linearization now = Linearize(model_, now_.at, now_.active);
    const Coordinates coordinates(shape_, now_.at.p, now_.active);
    const std::vector<double> theta = coordinates.Start();
    bool any = false;
    for (int k = 0; k < coordinates.size(); ++k) {
      const double slope = now.jacobian.col(k).dot(now.residual);
      const double near = 1e-6 * (1 + std::fabs(theta[k]));
      const bool low = theta[k] - coordinates.lower(k) < near && slope > 0;
      const bool high = coordinates.upper(k) - theta[k] < near && slope < 0;
      if (low || high) Activate(coordinates, k, low);
      any = any || low || high;
    }
    if (TakeOutFaded() || any) Measure();
  }

  // Solves without bounds. True if the solution lies inside them. Otherwise goes as far as the
  // first bound on the way and holds that parameter.
  bool SolveFree() {
    const State before = now_;
    const Coordinates coordinates(shape_, before.at.p, before.active);
    const std::vector<double> from = coordinates.Start();
    const std::vector<double> to =
        Solve(/*bounded=*/false, options_.function_tolerance, options_.max_iterations);
    int first = -1;
    bool lower = false;
    double reach = 1;
    for (int k = 0; k < coordinates.size(); ++k) {
      const double end = coordinates.Own(k, to), begin = coordinates.Own(k, from);
      const double low = coordinates.OwnLower(k), high = coordinates.OwnUpper(k);
      if (end >= low && end <= high) continue;
      const double fraction = end == begin ? 0 : ((end < low ? low : high) - begin) / (end - begin);
      if (first >= 0 && fraction >= reach) continue;
      first = k;
      lower = end < low;
      reach = std::min(std::max(fraction, 0.0), 1.0);
    }
    if (first < 0) {
      Clamp();  // rounding
      return !FadesWithoutLoss();
    }
    std::vector<double> theta = from;
    for (std::size_t k = 0; k < theta.size(); ++k) theta[k] += reach * (to[k] - from[k]);
    for (std::size_t k = 0; k < now_.at.local.size(); ++k) {
      const double way = now_.at.local[k] - before.at.local[k];
      now_.at.local[k] = before.at.local[k] + reach * way;
    }
    coordinates.ToParameters(theta.data(), now_.at.p.data());
    Clamp();
    Activate(coordinates, first, lower);
    TakeOutFaded();
    Measure();
    if (now_.mean_square > before.mean_square) {
      now_.at = before.at;
      Activate(coordinates, first, lower);
      Measure();
    }
    return false;
  }

  // Drops diodes of negligible current if the sum of squares stays. The rest is then solved again.
  bool FadesWithoutLoss() {
    State before = now_;
    if (!TakeOutFaded()) return false;
    Measure();
    if (now_.mean_square <= before.mean_square * (1 + kNoLoss)) return true;
    now_ = std::move(before);
    return false;
  }

  bool TakeOutFaded() { return RemoveFaded(shape_, &now_.at.p, &now_.active); }

  // Signed cosine of the residuals with the column of each parameter that is neither fixed nor of a
  // dropped diode. 0 for all others, and for a parameter at a bound whose descent direction leads
  // outside.
  std::vector<double> FreeCosines() const {
    std::vector<bool> active = fixed_;
    ActivateAbsent(shape_, now_.at.p, &active);
    const Linearization now = Linearize(model_, now_.at, active);
    const Coordinates coordinates(shape_, now_.at.p, active);
    const std::vector<double> theta = coordinates.Start();
    std::vector<double> cosines(size(), 0);
    const double norm = now.residual.norm();
    for (int k = 0; k < coordinates.size(); ++k) {
      const int i = coordinates.parameter(k);
      const double column = now.jacobian.col(k).norm();
      if (!(column > kNoInfluence * norm) || !(norm > 0)) continue;
      const double cosine = now.jacobian.col(k).dot(now.residual) / (column * norm);
      DCHECK(std::isfinite(cosine));
      if (now_.active[i]) {
        const double own = coordinates.Own(k, theta);
        const bool low = own - coordinates.OwnLower(k) < coordinates.OwnUpper(k) - own;
        if (low ? cosine > 0 : cosine < 0) continue;
      }
      cosines[i] = cosine;
    }
    return cosines;
  }

  double ProjectedGradient() const {
    double largest = 0;
    for (const double cosine : FreeCosines()) largest = std::max(largest, std::fabs(cosine));
    return largest;
  }

  // Releases the active bound whose inward descent direction has the largest cosine.
  bool ReleaseOne() {
    const std::vector<double> cosines = FreeCosines();
    int best = -1;
    double largest = kFlat;
    for (int i = 0; i < size(); ++i) {
      if (!now_.active[i] || refused_[i] || std::fabs(cosines[i]) <= largest) continue;
      largest = std::fabs(cosines[i]);
      best = i;
    }
    if (best < 0 || ++released_ > kMostReleased * size()) return false;
    now_.active[best] = false;
    last_released_ = best;
    return true;
  }

  // Adds a dropped diode where the residuals correlate with its current and continues the solve.
  // Keeps the diode only if the sum of squares falls.
  bool AddDiode() {
    if (!options_.add_diodes || Ended()) return false;
    for (int i = 0; i < size(); ++i) {
      const FitParameter& is = shape_.parameters[i];
      const bool vanished = is.may_vanish && now_.active[i] && now_.at.p[i] <= 0;
      if (!vanished || is.fixed() || added_ > kMostAdded * size()) continue;
      if (coarse_ == nullptr) coarse_ = model_.Coarse();
      const DiodeToAdd diode = FindDiodeToAdd(model_, coarse_.get(), now_.at, i);
      if (!(diode.cosine > kFlat)) continue;
      ++added_;
      const State before = now_;
      const int n = is.with[0];
      now_.at.p[i] = std::min(diode.size, is.upper);
      now_.at.p[n] = diode.n;
      now_.active[i] = false;
      now_.active[n] = fixed_[n];
      Measure();
      Solve(/*bounded=*/true, options_.first_tolerance, options_.first_iterations);
      if (now_.mean_square < before.mean_square * (1 - 1e-13)) {
        last_released_ = -1;
        return true;
      }
      now_ = before;
    }
    return false;
  }

  const FitModel& model_;
  const ModelShape& shape_;
  const RefineOptions& options_;
  std::vector<bool> fixed_;
  State now_;
  State best_;     // lowest of all points so far
  State settled_;  // lowest point with a stable active set
  std::vector<bool> refused_;
  int last_released_ = -1;
  int released_ = 0;
  int added_ = 0;
  int iterations_ = 0;
  bool stopped_ = false;
  bool hopeless_ = false;             // options_.cutoff is out of reach
  std::unique_ptr<FitModel> coarse_;  // created when needed
};

}  // namespace

namespace {

// Models may evaluate NaN parameters to finite residuals.
bool AreNumbers(const FitPoint& point) {
  const auto none = [](double x) { return std::isnan(x); };
  return std::none_of(point.p.begin(), point.p.end(), none) &&
         std::none_of(point.local.begin(), point.local.end(), none);
}

RefineEnd Nowhere(const FitModel& model, FitPoint start) {
  RefineEnd end;
  static_cast<FitPoint&>(end) = std::move(start);
  end.mean_square = HUGE_VAL;
  for (const FitParameter& parameter : model.shape().parameters)
    end.active.push_back(parameter.fixed());
  return end;
}

}  // namespace

RefineEnd RefineModel(const FitModel& model, FitPoint start, const RefineOptions& options) {
  if (!AreNumbers(start)) return Nowhere(model, std::move(start));
  return ActiveSet(model, std::move(start), options).Run();
}

RefineEnd RefineModelPlainly(const FitModel& model, FitPoint start, const RefineOptions& options) {
  if (!AreNumbers(start)) return Nowhere(model, std::move(start));
  return ActiveSet(model, std::move(start), options).RunPlainly();
}

}  // namespace lyrefit
