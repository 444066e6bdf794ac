#include "lyrefit/family/family_search.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/estimate/fit/search_space.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/search/search.h"

namespace lyrefit {
namespace {

// Weighted RMSE of a vector of shared parameters over the search curves.
class SharedObjective {
 public:
  SharedObjective(const FamilyProblem& family, const JointProblem& problem)
      : problem_(problem), space_(family.bounds, family.fixed) {
    std::vector<ParameterInfo> parameters = problem.translation.parameters;
    parameters.push_back({"", "irradiance_offset", "W/m2", ""});
    parameters.push_back({"", "temperature_offset", "K", ""});
    space_.NameSides(parameters);
    for (const JointCurve& curve : problem.curves) {
      points_.push_back(MakePointSet(curve.voltage_V, curve.current_A, curve.weight));
      double weight = 0;
      for (const double w : curve.weight) weight += w;
      weight_.push_back(weight);
      total_ += weight;
    }
  }

  const Box& box() const { return space_.box(); }

  JointPoint Point(const double* x) const {
    JointPoint point;
    point.shared.resize(problem_.shared());
    space_.ToParameters(x, point.shared.data());
    point.local.assign(problem_.curves.size(), {0, 0});
    // The dark shunt is between the shunt at the reference and exp(exponent) times that.
    const Translation& at = problem_.translation;
    if (at.resistance_shunt_dark >= 0) {
      const double shunt = point.shared[at.resistance_shunt];
      double& dark = point.shared[at.resistance_shunt_dark];
      dark = std::min(std::max(dark, shunt), shunt * std::exp(point.shared[at.shunt_exponent]));
    }
    return point;
  }

  double operator()(const double* x) const {
    const JointPoint point = Point(x);
    double sum = 0;
    for (std::size_t c = 0; c < problem_.curves.size(); ++c) {
      const std::vector<double> device = DeviceAt(problem_, point, static_cast<int>(c));
      sum += weight_[c] * MeanSquare(DeviceOf(problem_, static_cast<int>(c)), problem_.objective,
                                     device.data(), points_[c]);
    }
    return std::sqrt(sum / total_);
  }

 private:
  const JointProblem& problem_;
  SearchSpace space_;
  std::vector<PointSet> points_;
  std::vector<double> weight_;
  double total_ = 0;
};

}  // namespace

Expected<FamilySearchEnd> SearchFamily(const FamilyProblem& family, const FamilyOptions& options,
                                       const std::vector<int>& curves, const Observer& observer) {
  const JointProblem problem = JointProblemOn(family, options, curves);
  const SharedObjective shared(family, problem);
  const ObjectiveFunction objective = [&](const double* x) { return shared(x); };
  FamilySearchEnd end;
  if (options.searcher) {
    const Instant begin = Now();
    end.summary = options.searcher(objective, shared.box(), options.search, observer);
    end.summary.seconds = SecondsSince(begin);
    TRY(CheckCandidates(objective, shared.box(), &end.summary));
  } else {
    end.summary = Search(objective, shared.box(), options.search, observer);
  }
  for (const Candidate& candidate : end.summary.elites)
    end.elites.push_back(shared.Point(candidate.x.data()));
  const bool stopped = end.summary.termination == SearchTermination::kInterrupted;
  if (options.random_baseline && !stopped && options.search.algorithm != Algorithm::kRandom) {
    SearchOptions random = options.search;
    random.algorithm = Algorithm::kRandom;
    random.max_evaluations = std::max<std::int64_t>(end.summary.evaluations, 4);
    random.target = -kInfinity;
    random.patience = 0;
    const SearchSummary baseline = Search(objective, shared.box(), random, observer);
    end.random = shared.Point(baseline.best.x.data());
    end.has_random = true;
  }
  return end;
}

RmsePair CurveRmse(const JointProblem& problem, const JointPoint& point, int curve) {
  const JointCurve& at = problem.curves[curve];
  const std::vector<double> device = DeviceAt(problem, point, curve);
  const Device& model = DeviceOf(problem, curve);
  return {Rmse(model, Objective::kMeasuredCurrent, device.data(), at.voltage_V, at.current_A),
          Rmse(model, Objective::kSolvedCurrent, device.data(), at.voltage_V, at.current_A)};
}

RmsePair FamilyRmse(const JointProblem& problem, const JointPoint& point) {
  double measured = 0, solved = 0, points = 0;
  for (std::size_t c = 0; c < problem.curves.size(); ++c) {
    const RmsePair rmse = CurveRmse(problem, point, static_cast<int>(c));
    const double count = static_cast<double>(problem.curves[c].voltage_V.size());
    measured += count * rmse.measured_current_A * rmse.measured_current_A;
    solved += count * rmse.solved_current_A * rmse.solved_current_A;
    points += count;
  }
  return {std::sqrt(measured / points), std::sqrt(solved / points)};
}

}  // namespace lyrefit
