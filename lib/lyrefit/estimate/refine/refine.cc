#include "lyrefit/estimate/refine/refine.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/estimate/refine/coarsen.h"
#include "lyrefit/estimate/refine/profile.h"
#include "lyrefit/estimate/refine/separable.h"

namespace lyrefit {
namespace {

// The current at the highest voltage; 0 if it is not above those that the device delivers.
double ForwardCurrent(const RefineProblem& problem) {
  double highest_V = 0, forward_A = 0, delivered_A = 0;
  for (std::size_t k = 0; k < problem.voltage_V.size(); ++k) {
    if (!(problem.voltage_V[k] > 0)) continue;
    delivered_A = std::max(delivered_A, problem.current_A[k]);
    if (!(problem.voltage_V[k] > highest_V)) continue;
    highest_V = problem.voltage_V[k];
    forward_A = -problem.current_A[k];
  }
  return forward_A > delivered_A ? forward_A : 0;
}

ModelShape ShapeOf(const RefineProblem& problem) {
  ModelShape shape;
  shape.parameters = MakeFitParameters(problem.device.parameters, problem.lower, problem.upper);
  shape.blocks = {{static_cast<int>(problem.voltage_V.size()), 0}};
  shape.points = static_cast<double>(problem.voltage_V.size());
  shape.current_scale_A = problem.current_scale_A;
  shape.voltage_scale_V = problem.voltage_scale_V;
  shape.forward_A = ForwardCurrent(problem);
  shape.thermal_voltage_V = problem.device.module_thermal_voltage_V;
  return shape;
}

}  // namespace

CurveModel::CurveModel(const RefineProblem& problem)
    : FitModel(ShapeOf(problem)), problem_(problem) {}

CurveModel::CurveModel(const RefineProblem& problem, GiveUp give_up) : CurveModel(problem) {
  if (problem.device.effects != nullptr) kept_ = std::make_unique<LawWorkspace>(give_up);
}

CurveModel::CurveModel(std::unique_ptr<RefineProblem> own)
    : FitModel(ShapeOf(*own)), own_(std::move(own)), problem_(*own_) {}

bool CurveModel::Evaluate(int /*block*/, const double* p, const double* /*local*/,
                          double* residuals, double* slopes, double* /*local_slopes*/) const {
  Residuals(problem_, p, residuals, slopes, kept_.get());
  return true;
}

double CurveModel::MeanSquare(const FitPoint& point) const {
  return lyrefit::MeanSquare(problem_, point.p, kept_.get());
}

std::unique_ptr<FitModel> CurveModel::Coarse() const {
  if (!CanCoarsen(problem_)) return nullptr;
  return std::unique_ptr<FitModel>(
      new CurveModel(std::make_unique<RefineProblem>(Coarsen(problem_))));
}

RefineEnd Refine(const RefineProblem& problem, std::vector<double> start,
                 const RefineOptions& options) {
  const CurveModel model(problem, options.evaluation_limit ? GiveUp::kSlow : GiveUp::kAbsurd);
  return RefineModel(model, {std::move(start), {}}, options);
}

RefineEnd RefineFrom(const RefineProblem& problem, const std::vector<double>& start,
                     const RefineOptions& options) {
  constexpr double kWorse = 1e-9;  // relative rise of the mean square beyond rounding
  const double tolerance = std::max(options.function_tolerance, 1e-11);
  RefineEnd end = Refine(problem, SeparableDescent(problem, start, tolerance), options);
  if (end.mean_square <= MeanSquare(problem, start) * (1 + kWorse)) return end;
  RefineEnd own = Refine(problem, start, options);
  return own.mean_square < end.mean_square ? own : end;
}

RefineEnd RefinePlainly(const RefineProblem& problem, std::vector<double> start,
                        const RefineOptions& options) {
  const CurveModel model(problem, options.evaluation_limit ? GiveUp::kSlow : GiveUp::kAbsurd);
  return RefineModelPlainly(model, {std::move(start), {}}, options);
}

namespace {

constexpr int kBriefly = 12;         // iterations that suffice for most refits
constexpr int kMaxIterations = 200;  // of the other refits
constexpr int kMaxRounds = 10;
constexpr double kInside = 0.994;  // of the rise at the end; a point below it is inside

// The refits of the profile of one parameter of one curve.
class CurveRefits {
 public:
  CurveRefits(const RefineProblem& problem, const RefineEnd& best, const ProfileQuery& query,
              const StopToken& stop)
      : i_(query.parameter), best_(best), held_(problem), model_(held_), alike_(AreAlike(problem)) {
    outside_ =
        best.mean_square + kInside * query.t * query.t * query.variance / model_.shape().points;
    how_.small = true;
    how_.add_diodes = false;  // the separable descents add diodes
    how_.max_iterations = how_.first_iterations = kMaxIterations;
    how_.max_rounds = kMaxRounds;
    how_.stop = stop;
  }
  CurveRefits(const CurveRefits&) = delete;
  CurveRefits& operator=(const CurveRefits&) = delete;

  RefineEnd Refit(double value, const FitPoint& start, double target, double tolerance) {
    Ask(value, target, tolerance);
    FitPoint from = start;
    from.p[i_] = value;
    RefineOptions briefly = how_;
    briefly.first_iterations = kBriefly;
    briefly.max_rounds = 0;
    if (target > 0) briefly.cutoff = target;
    RefineEnd end = RefineModel(model_, from, briefly);
    // RefineFrom is tried if the brief fit did not reach its goal. It is also tried before a point
    // counts as outside, since the diodes may have exchanged roles there.
    const bool further = end.converged ? end.mean_square > outside_ && OfDiode()
                                       : end.mean_square > target && (OfDiode() || !(target > 0));
    if (further) {
      RefineEnd other = RefineFrom(held_, from.p, how_);
      if (other.mean_square < end.mean_square) end = std::move(other);
    }
    if (OutOfOrder(end.p)) end = RefitInOrder(value);
    end.stopped = how_.stop.requested();
    return end;
  }

  // Whether a fit from a deterministic start ends at or below `target`.
  bool Elsewhere(double value, double target, double tolerance, FitPoint* there) {
    Ask(value, target, tolerance);
    RefineOptions reach = how_;
    reach.cutoff = target;
    reach.add_diodes = true;
    std::vector<std::vector<double>> starts;
    for (SeparableStart& grid : SeparableStarts(held_, best_.p[kRs], /*count=*/1)) {
      starts.push_back(std::move(grid.p));
    }
    starts.push_back(best_.p);
    starts.back()[i_] = value;
    for (const std::vector<double>& from : starts) {
      RefineEnd end = RefineFrom(held_, from, reach);
      if (end.mean_square > target || OutOfOrder(end.p)) continue;
      *there = std::move(end);
      return true;
    }
    return false;
  }

 private:
  bool OfDiode() const {
    const ParameterKind kind = held_.device.parameters[i_].kind;
    return kind == ParameterKind::kSaturation || kind == ParameterKind::kIdeality;
  }

  // Whether the diodes differ only in their order, which is that of rising n.
  static bool AreAlike(const RefineProblem& problem) {
    if (problem.device.effects != nullptr || DiodeCount(problem.device) < 2) return false;
    for (int d = 1; d < DiodeCount(problem.device); ++d) {
      for (const auto& index : {IdealityIndex, SaturationCurrentIndex}) {
        if (problem.lower[index(d)] != problem.lower[index(0)]) return false;
        if (problem.upper[index(d)] != problem.upper[index(0)]) return false;
      }
    }
    return true;
  }

  // Whether the diode of this parameter has taken the place of another one.
  bool OutOfOrder(const std::vector<double>& p) const {
    if (!alike_ || !OfDiode()) return false;
    double last_n = 0;
    for (int d = 0; d < DiodeCount(held_.device); ++d) {
      if (!(p[SaturationCurrentIndex(d)] > 0)) {  // absent diodes have any n and come last
        last_n = HUGE_VAL;
        continue;
      }
      if (p[IdealityIndex(d)] < last_n) return true;
      last_n = p[IdealityIndex(d)];
    }
    return false;
  }

  // The refit from the optimum with the diodes in their order: neighbours on the two sides of the
  // value that is asked for, or of the middle of their n.
  RefineEnd RefitInOrder(double value) {
    RefineProblem ordered = held_;
    std::vector<double> from = best_.p;
    from[i_] = value;
    for (int d = 0; d + 1 < DiodeCount(held_.device); ++d) {
      const int low = IdealityIndex(d), high = IdealityIndex(d + 1);
      const bool asked = i_ == low || i_ == high;
      const double limit = asked ? value : 0.5 * (best_.p[low] + best_.p[high]);
      if (i_ != low) ordered.upper[low] = std::min(ordered.upper[low], limit);
      if (i_ != high) ordered.lower[high] = std::max(ordered.lower[high], limit);
      from[low] = std::min(from[low], ordered.upper[low]);
      from[high] = std::max(from[high], ordered.lower[high]);
    }
    return RefineFrom(ordered, from, how_);
  }

  void Ask(double value, double target, double tolerance) {
    held_.lower[i_] = held_.upper[i_] = value;
    model_.Fix(i_, value);
    how_.target = target;
    how_.function_tolerance = how_.first_tolerance = tolerance;
  }

  const int i_;
  const RefineEnd& best_;
  RefineProblem held_;  // with the query's parameter fixed
  CurveModel model_;
  const bool alike_;
  double outside_ = 0;  // mean square of a point outside the interval
  RefineOptions how_;
};

}  // namespace

ProfileSide FindProfileSide(const RefineProblem& problem, const RefineEnd& best,
                            const ProfileQuery& query, const StopToken& stop) {
  CurveRefits curve(problem, best, query, stop);
  const auto bind = [&](auto member) {
    return [&, member](auto&&... of) { return (curve.*member)(of...); };
  };
  ProfileRefits refits{bind(&CurveRefits::Refit), bind(&CurveRefits::Elsewhere)};
  // A model with a single diode has only one local optimum.
  if (DiodeCount(problem.device) == 1) refits.elsewhere = nullptr;
  return FindProfileSide(CurveModel(problem), best, query, refits);
}

}  // namespace lyrefit
