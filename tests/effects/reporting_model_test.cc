#include "lyrefit/estimate/refine/reporting_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "effects/synthetic_use.h"
#include "estimate/refine/test_curves.h"
#include "lyrefit/estimate/refine/refine.h"

namespace lyrefit {
namespace {

// A module with k |V|^m beside its diode; reported, k depends on m.
RefineProblem WithNonOhmicShunt() {
  RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode, kSingleTruth,
                                        3e-3, Objective::kSolvedCurrent);
  IvCurve curve;
  curve.name = "module";
  curve.conditions.cells_in_series = 36;
  curve.voltage_V = problem.voltage_V;
  curve.current_A = problem.current_A;
  const auto device = Extend(problem.device, Model::kSingleDiode, ConstantSet::kCodata, curve,
                             {UseOf("nonohmic_shunt")}, /*force=*/true);
  EXPECT_TRUE(device) << device.error().ToString();
  for (const ParameterBounds& bounds : device->effects->bounds) {
    problem.lower.push_back(bounds.lower);
    problem.upper.push_back(bounds.upper);
  }
  return MakeRefineProblem(*device, problem.objective, problem.voltage_V, problem.current_A, {},
                           problem.lower, problem.upper);
}

// A point inside all bounds, in internal units.
std::vector<double> Inside(const RefineProblem& problem) {
  std::vector<double> p = kSingleTruth;
  for (std::size_t i = p.size(); i < problem.lower.size(); ++i) {
    p.push_back(problem.lower[i] + 0.3 * (problem.upper[i] - problem.lower[i]));
  }
  return p;
}

TEST(ReportingModel, DifferentiatesByReportedValues) {
  const RefineProblem problem = WithNonOhmicShunt();
  const CurveModel internal(problem);
  const EffectSpan effects = SpanOf(problem.device);
  const ReportingModel model(internal, effects);
  const std::vector<double> p = Reported(effects, Inside(problem));
  const int count = model.shape().size(), points = model.shape().blocks[0].residuals;
  std::vector<double> residuals(points), slopes(static_cast<std::size_t>(points) * count);
  ASSERT_TRUE(model.Evaluate(0, p.data(), nullptr, residuals.data(), slopes.data(), nullptr));
  for (int i = effects.first; i < count; ++i) {
    std::vector<double> above(points), below(points), up = p, down = p;
    const double step = 1e-5 * std::fabs(p[i]);
    up[i] += step;
    down[i] -= step;
    ASSERT_TRUE(model.Evaluate(0, up.data(), nullptr, above.data(), nullptr, nullptr));
    ASSERT_TRUE(model.Evaluate(0, down.data(), nullptr, below.data(), nullptr, nullptr));
    double largest = 0;
    for (int r = 0; r < points; ++r) {
      largest = std::max(largest, std::fabs(slopes[r * count + i]));
    }
    EXPECT_GT(largest, 0) << i;
    for (int r = 0; r < points; ++r) {
      EXPECT_NEAR(slopes[r * count + i], (above[r] - below[r]) / (2 * step), 1e-5 * largest) << i;
    }
  }
}

TEST(ReportingModel, HasTheResidualsAndTheRangesOfItsModel) {
  const RefineProblem problem = WithNonOhmicShunt();
  const CurveModel internal(problem);
  const EffectSpan effects = SpanOf(problem.device);
  const ReportingModel model(internal, effects);
  const std::vector<double> own = Inside(problem), p = Reported(effects, own);
  EXPECT_NEAR(model.MeanSquare({p, {}}) / internal.MeanSquare({own, {}}), 1, 1e-9);
  for (int i = 0; i < model.shape().size(); ++i) {
    EXPECT_LE(model.shape().parameters[i].lower, p[i]) << i;
    EXPECT_GE(model.shape().parameters[i].upper, p[i]) << i;
  }
}

TEST(ReportingModel, IsItsModelWithoutEffects) {
  const RefineProblem problem = ModuleProblem(Model::kSingleDiode, Model::kSingleDiode,
                                              kSingleTruth, 3e-3, Objective::kSolvedCurrent);
  const CurveModel internal(problem);
  const ReportingModel model(internal, SpanOf(problem.device));
  EXPECT_EQ(model.MeanSquare({kSingleTruth, {}}), internal.MeanSquare({kSingleTruth, {}}));
}

}  // namespace
}  // namespace lyrefit
