// Tests that no parameters have an RMSE below a proved bound.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "certify/made.h"
#include "error_of.h"
#include "lyrefit/certify/certify.h"
#include "lyrefit/certify/relaxation.h"
#include "lyrefit/certify/upper_bound.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/estimate/refine/refine.h"
#include "lyrefit/estimate/refine/separable.h"
#include "repeats.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

double LargestCurrent(const IvCurve& curve) {
  return DataOf(curve).current_A.cwiseAbs().maxCoeff();
}

RefineProblem ProblemOf(const Certificate& certificate, Model model) {
  const IvCurve& curve = certificate.curve;
  const CertifyOptions& options = certificate.options;
  return ModelProblem(curve, MakeDevice(model, curve.conditions, options.constants),
                      {options.n_lower, options.n_upper, options.rs_lower_ohm,
                       certificate.rs_upper_ohm, certificate.reference_voltage_V});
}

std::vector<double> RandomPoint(const RefineProblem& problem, double reference_V,
                                RandomStream* random) {
  std::vector<double> p(problem.device.size());
  const double current = problem.current_scale_A;
  p[kIph] = 2 * current * random->Uniform();
  p[kRs] = problem.lower[kRs] +
           (problem.upper[kRs] - problem.lower[kRs]) * random->Uniform() * random->Uniform();
  p[kRsh] = reference_V / current * std::pow(10, 4 * random->Uniform());
  for (int d = 0; d < DiodeCount(problem.device); ++d) {
    const int n = IdealityIndex(d);
    p[n] = problem.lower[n] + (problem.upper[n] - problem.lower[n]) * random->Uniform();
    p[SaturationCurrentIndex(d)] =
        current * random->Uniform() /
        std::expm1(reference_V / (p[n] * problem.device.module_thermal_voltage_V));
  }
  return p;
}

// Compares random parameters of every model, before and after refinement, with the bounds of that
// model and of the floor. Double arithmetic has errors of about 1e-15 of the current.
void ExpectNotUndercut(const Certificate& certificate, std::uint64_t seed) {
  const double rounding = 1e-14 * LargestCurrent(certificate.curve);
  RandomStream random(seed);
  for (const ModelCertificate& model : certificate.models) {
    const RefineProblem problem = ProblemOf(certificate, model.model);
    EXPECT_GE(model.rmse_A, certificate.floor.lower_bound_A - rounding);
    EXPECT_NEAR(std::sqrt(MeanSquare(problem, model.parameters)), model.rmse_A, rounding);
    for (int start = 0; start < 3; ++start) {
      const auto drawn = RandomPoint(problem, certificate.reference_voltage_V, &random);
      EXPECT_GE(std::sqrt(MeanSquare(problem, drawn)), model.lower_bound_A);
      const RefineEnd end = Refine(problem, SeparableDescent(problem, drawn));
      EXPECT_GE(std::sqrt(end.mean_square), model.lower_bound_A - rounding)
          << certificate.curve.name << " " << ToText(model.model);
      EXPECT_GE(std::sqrt(end.mean_square), certificate.floor.lower_bound_A - rounding);
    }
  }
}

TEST(CertifySound, NoRefinedStartOfAnyModelUndercutsIt) {
  for (int seed = 500; seed < 500 + Repeats(40); ++seed) {
    CertifyOptions options;
    if (seed % 2 == 1) {
      options.n_lower = 0.5;
      options.n_upper = 4;
    }
    const auto certificate = Certify(RandomCurve(seed), options);
    ASSERT_TRUE(certificate) << certificate.error().ToString();
    for (const ModelCertificate& model : certificate->models) EXPECT_TRUE(model.certified) << seed;
    ExpectNotUndercut(*certificate, seed);
  }
}

TEST(CertifySound, NoFitUndercutsIt) {
  for (std::uint64_t seed = 600; seed < 606; ++seed) {
    const IvCurve curve = RandomCurve(seed);
    const auto certificate = Certify(curve);
    ASSERT_TRUE(certificate) << certificate.error().ToString();
    for (const ModelCertificate& model : certificate->models) {
      FitOptions options;
      options.model = model.model;
      options.objective = Objective::kMeasuredCurrent;
      options.intervals = Intervals::kNone;
      const auto report = Fit(curve, options);
      if (!report) continue;  // fewer points than parameters
      EXPECT_GE(report->rmse.refined.measured_current_A, model.lower_bound_A)
          << curve.name << " " << ToText(model.model);
    }
  }
}

// For curves with almost no noise, rounding limits the bounds, and the gap includes it.
TEST(CertifySound, HoldsWhereThereIsHardlyAnyNoise) {
  SKIP_IF_SANITIZED();
  for (const double noise : {0.0, 1e-9, 1e-7}) {
    IvCurve curve = Shipped("rtc_france");
    const Device device = MakeDevice(Model::kDoubleDiode, curve.conditions);
    const std::vector<double> truth = {0.76, 2e-7, 1.45, 0.036, 55, 7e-7, 1.9};
    curve.current_A = SolveCurrents(device, truth.data(), curve.voltage_V);
    RandomStream random(7);
    for (double& i : curve.current_A) i += noise * random.Normal();
    const auto certificate = Certify(curve);
    ASSERT_TRUE(certificate) << certificate.error().ToString();
    EXPECT_LT(certificate->floor.rmse_A, 1.5 * noise + 1e-14);
    EXPECT_LT(certificate->floor.rmse_A - certificate->floor.lower_bound_A, 1e-13) << noise;
    for (const ModelCertificate& model : certificate->models) {
      EXPECT_LT(model.solved, 10000) << noise << ": goes on although rounding ends it";
    }
    ExpectNotUndercut(*certificate, 1);
  }
}

struct Ugly {
  const char* name;
  std::vector<double> voltage_V, current_A;
  bool exact;  // some model fits all points exactly
};

TEST(CertifySound, TakesUglyCurves) {
  constexpr int kFewProblems = 500;  // limit on convex subproblems, independent of the machine
  const Ugly curves[] = {
      {"two points", {0, 0.5}, {0.76, 0.5}, true},
      {"three points, unsorted", {0.5, 0, 0.4}, {0.5, 0.76, 0.7}, true},
      {"nearly constant", {0, 0.1, 0.2, 0.3, 0.4}, {1, 1, 1, 1, 0.999}, false},
      {"straight line", {0, 0.1, 0.2, 0.3, 0.4, 0.5}, {1, 0.8, 0.6, 0.4, 0.2, 0}, true},
      {"around Voc", {0.55, 0.56}, {0.01, -0.01}, false},
      {"noise at Isc", {0, 0.02, 0.04, 0.06, 0.08}, {0.76, 0.759, 0.7605, 0.7591, 0.7603}, false},
      {"rising", {0, 0.1, 0.2, 0.3, 0.4, 0.5}, {0, 0.2, 0.4, 0.6, 0.8, 1}, false},
      {"duplicates", {0, 0, 0.3, 0.3, 0.5, 0.5}, {0.76, 0.75, 0.7, 0.71, 0.3, 0.31}, false},
      {"step", {0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.55, 0.6}, {1, 1, 1, 0.5, 0.5, 0.5, 0.2, 0}, false},
      {"nanoamperes", {0, 0.2, 0.4, 0.5, 0.55, 0.6}, {1e-9, 1e-9, 9e-10, 8e-10, 5e-10, 0}, false},
      {"far beyond Voc", {0, 0.3, 0.6, 0.7, 0.8}, {1, 0.9, -0.5, -4, -20}, false}};
  for (const Ugly& ugly : curves) {
    IvCurve curve;
    curve.name = ugly.name;
    curve.as_is = true;
    curve.voltage_V = ugly.voltage_V;
    curve.current_A = ugly.current_A;
    const auto certificate = Certify(curve);
    ASSERT_TRUE(certificate) << ugly.name << ": " << certificate.error().ToString();
    EXPECT_LT(certificate->floor.solved, kFewProblems) << ugly.name;
    EXPECT_TRUE(!ugly.exact || certificate->floor.gap == 0) << ugly.name;
    for (const ModelCertificate& model : certificate->models) {
      EXPECT_TRUE(!ugly.exact || model.certified) << ugly.name;
      EXPECT_LT(model.solved, kFewProblems) << ugly.name;
      EXPECT_TRUE(std::isfinite(model.above_floor)) << ugly.name;
    }
    ExpectNotUndercut(*certificate, 3);
  }
}

// The order of points near Isc alone excludes no series resistance. A requested finite range is
// searched completely. An infinite range is searched in part, and the bound includes the tail
// beyond it.
TEST(CertifySound, GoesThroughResistancesThatTheOrderOfThePointsDoesNotShutOut) {
  IvCurve curve;
  curve.voltage_V = {0, 0.02, 0.04, 0.06, 0.08};
  curve.current_A = {0.76, 0.759, 0.7605, 0.7591, 0.7603};
  const double in_order_ohm = 0.08 / 0.7605;
  for (const double factor : {0.9, 1.7, 10.0}) {
    CertifyOptions options;
    options.rs_upper_ohm = factor * in_order_ohm;
    const auto closed = Certify(curve, options);
    ASSERT_TRUE(closed) << closed.error().ToString();
    EXPECT_LE(closed->floor.gap, 1e-9) << factor;
    EXPECT_EQ(closed->rs_upper_ohm, options.rs_upper_ohm);
    for (const ModelCertificate& model : closed->models) EXPECT_TRUE(model.certified) << factor;
    ExpectNotUndercut(*closed, 3);
  }
  const auto open = Certify(curve);
  ASSERT_TRUE(open) << open.error().ToString();
  EXPECT_GE(open->rs_upper_ohm, 2 * in_order_ohm);
  const double tail = BoundTail(DataOf(curve), open->rs_upper_ohm);
  EXPECT_NEAR(open->floor.lower_bound_A, std::sqrt(2 * tail / 5), 1e-15);
  EXPECT_FALSE(open->models[0].certified);
}

// Curves that end before open circuit, where the order of the points excludes few series
// resistances.
TEST(CertifySound, ProvesEveryRangeOfTheSeriesResistance) {
  for (int seed = 800; seed < 800 + Repeats(24); ++seed) {
    IvCurve curve = RandomCurve(seed);
    RandomStream random(seed, 78);
    const MixtureData all = DataOf(curve);
    const double last = (0.7 + 0.25 * random.Uniform()) * all.voltage_V.maxCoeff();
    const IvCurve part = UpTo(last, curve);
    const MixtureData data = DataOf(part);
    CertifyOptions options;
    options.models = {Model::kSingleDiode, Model::kDoubleDiode};
    options.rs_upper_ohm =
        (0.9 + 0.8 * random.Uniform()) * data.voltage_V.maxCoeff() / data.current_A.maxCoeff();
    options.effort = 3000;
    const auto certificate = Certify(part, options);
    ASSERT_TRUE(certificate) << certificate.error().ToString();
    EXPECT_TRUE(certificate->floor.certified) << seed << " " << certificate->floor.gap;
    for (const ModelCertificate& model : certificate->models) {
      EXPECT_TRUE(model.certified) << seed << " " << model.gap;
    }
    ExpectNotUndercut(*certificate, seed);
  }
}

TEST(CertifySound, HoldsBeyondTheResistancesGoneThrough) {
  const IvCurve curve = Shipped("rtc_france");
  CertifyOptions options;
  options.models = {Model::kSingleDiode};
  const auto certificate = Certify(curve, options);
  ASSERT_TRUE(certificate);
  const MixtureData data = DataOf(curve);
  for (const double rs : {1.0, 2.0, 10.0, 100.0}) {
    const Mixture mixture =
        SolveMixture(data, {WindowOf(curve, 1, 2)}, rs * certificate->rs_upper_ohm, {}, 1e-6, 2);
    EXPECT_GT(std::sqrt(2 * mixture.primal / 26), certificate->floor.rmse_A) << rs;
  }
}

TEST(CertifySound, AsksForTheCellsOfAModule) {
  IvCurve module = Shipped("msx60");
  module.conditions.cells_in_series = 1;
  module.cells_known = false;
  EXPECT_THAT(MessageOf(Certify(module)), HasSubstr("is the number of cells in series, 1, right?"));
}

TEST(CertifySound, StoppedAnywhereGivesBoundsThatHold) {
  const double final_rmse[] = {1.575186424e-4, 2.216617042e-5, 2.172427937e-5};
  for (const int most : {1, 4, 40, 150, 400, 800}) {
    int calls = 0;
    const auto certificate = Certify(Shipped("msx60"), {}, [&](const Progress& progress) {
      EXPECT_LE(progress.lower_bound, progress.best * (1 + 1e-9));
      return ++calls >= most ? ObserverAction::kStop : ObserverAction::kContinue;
    });
    ASSERT_TRUE(certificate);
    EXPECT_EQ(calls, most) << "asked again after the stop";
    EXPECT_TRUE(certificate->interrupted);
    EXPECT_LE(certificate->floor.lower_bound_A, 2.172427937e-5 * (1 + 1e-9));
    EXPECT_GE(certificate->floor.rmse_A, 2.172427937e-5 * (1 - 1e-9));
    for (const ModelCertificate& model : certificate->models) {
      const double known = final_rmse[static_cast<int>(model.model) - 1];
      EXPECT_LE(model.lower_bound_A, known * (1 + 1e-9)) << most;
      EXPECT_GE(model.rmse_A, known * (1 - 1e-9)) << most;
    }
  }
}

}  // namespace
}  // namespace lyrefit
