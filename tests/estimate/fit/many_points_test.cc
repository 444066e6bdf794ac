#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>
#include <string>

#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/estimate/refine/refine.h"
#include "repeats.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

// The refinement problem of a report on all its points.
RefineProblem ProblemOf(const FitReport& report) {
  std::vector<double> lower, upper;
  for (const Estimate& e : report.estimates) {
    lower.push_back(e.bounds.lower);
    upper.push_back(e.bounds.upper);
  }
  return MakeRefineProblem(report.device, report.objective, report.curve.voltage_V,
                           report.curve.current_A, {}, lower, upper);
}

TEST(ManyPoints, EndAtTheOptimumOfAllOfThem) {
  for (const Objective objective : {Objective::kMeasuredCurrent, Objective::kSolvedCurrent}) {
    for (const Model model : {Model::kSingleDiode, Model::kDoubleDiode}) {
      FitOptions options;
      options.model = model;
      options.objective = objective;
      options.intervals = Intervals::kNone;
      const FitReport report =
          *Fit(ModuleCurve(Model::kDoubleDiode, kDoubleTruth, 3e-3, 5, 5000), options);
      const RefineProblem problem = ProblemOf(report);
      // The reference optimum starts from the truth and uses all points, without coarsening.
      std::vector<double> start = kDoubleTruth;
      start.resize(problem.device.size());
      const RefineEnd best = RefineFrom(problem, start);
      EXPECT_NEAR(report.rmse.refined.Of(objective) / std::sqrt(best.mean_square), 1, 1e-9);
      EXPECT_LE(report.refine.projected_gradient, 1e-6);
      EXPECT_EQ(report.refine.termination, "converged");
      EXPECT_NEAR(report.search.best.objective / report.rmse.searched.Of(objective), 1, 1e-12);
    }
  }
}

TEST(ManyPoints, StopInEveryStage) {
  SKIP_IF_SANITIZED();
  const IvCurve curve = ModuleCurve(Model::kDoubleDiode, kDoubleTruth, 3e-3, 5, 100000);
  for (const char* stage : {"search", "polish", "intervals", "held out"}) {
    FitOptions options;
    options.model = Model::kDoubleDiode;
    bool stopped = false;
    std::string last;
    const Observer observer = [&](const Progress& progress) {
      stopped = stopped || progress.stage == stage;
      last = progress.stage;
      return stopped ? ObserverAction::kStop : ObserverAction::kContinue;
    };
    const bool held_out = std::string(stage) == "held out";
    const FitReport report =
        held_out ? *FitAuto(curve, options, observer) : *Fit(curve, options, observer);
    EXPECT_TRUE(stopped) << stage;
    EXPECT_TRUE(report.interrupted) << stage;
    EXPECT_EQ(last, stage) << "no further one begins";
  }
}

TEST(Progress, CountsTheStepsOfEveryStage) {
  FitOptions options;
  options.model = Model::kDoubleDiode;
  std::set<std::string> stages;
  const Observer observer = [&](const Progress& progress) {
    stages.insert(std::string(progress.stage));
    EXPECT_GT(progress.iterations, 0) << progress.stage;
    EXPECT_LE(progress.iteration, progress.iterations) << progress.stage;
    EXPECT_GE(progress.seconds, 0);
    return ObserverAction::kContinue;
  };
  const FitReport report =
      *FitAuto(ModuleCurve(Model::kDoubleDiode, kDoubleTruth, 1e-3, 3, 100), options, observer);
  EXPECT_FALSE(report.interrupted);
  EXPECT_EQ(stages, (std::set<std::string>{"search", "polish", "intervals", "held out"}));
}

}  // namespace
}  // namespace lyrefit
