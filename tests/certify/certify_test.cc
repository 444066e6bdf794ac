#include "lyrefit/certify/certify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "certify/made.h"
#include "lyrefit/estimate/refine/refine.h"
#include "lyrefit/estimate/refine/separable.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(Certify, ProvesTheFloorOfTheRtcFranceCell) {
  const auto certificate = Certify(Shipped("rtc_france"));
  ASSERT_TRUE(certificate) << certificate.error().ToString();
  const Floor& floor = certificate->floor;
  EXPECT_NEAR(floor.rmse_A / 9.824848761e-4, 1, 1e-9);
  EXPECT_LT(floor.gap, 1e-9);
  EXPECT_TRUE(floor.certified);
  EXPECT_LT(floor.duality_gap, 1e-12);
  ASSERT_EQ(floor.diodes.size(), 2U);
  EXPECT_NEAR(floor.diodes[0].n, 2, 1e-12);
  EXPECT_NEAR(floor.diodes[1].n, 1.4510183, 2e-7);
  EXPECT_NEAR(certificate->models[0].rmse_A / 9.860218779e-4, 1, 1e-9);
  EXPECT_EQ(certificate->models[1].solved, 0) << "the floor proves it";
  EXPECT_NEAR(certificate->models[2].rmse_A / floor.rmse_A, 1, 1e-9);
}

struct Known {
  const char* curve;
  double n_lower, n_upper;
  double rmse_A[3];  // SD, DD, TD
};

// Expected values for n in [1, 2] are from data/*/expected.json, computed by other methods. For n
// in [0.5, 4] the single-diode value is unchanged if its n lies inside [1, 2].
class CertifyShipped : public ::testing::TestWithParam<Known> {};

TEST_P(CertifyShipped, CertifiesOneTwoAndThreeDiodes) {
  SKIP_IF_SANITIZED();
  const Known& known = GetParam();
  CertifyOptions options;
  options.n_lower = known.n_lower;
  options.n_upper = known.n_upper;
  const auto certificate = Certify(Shipped(known.curve), options);
  ASSERT_TRUE(certificate) << certificate.error().ToString();
  EXPECT_LE(certificate->floor.gap, 1e-9);
  EXPECT_EQ(certificate->floor.dual_A.size(), certificate->curve.size());
  for (int m = 0; m < 3; ++m) {
    const ModelCertificate& model = certificate->models[m];
    EXPECT_TRUE(model.certified) << m;
    EXPECT_LE(model.gap, 1e-9);
    EXPECT_GE(model.rmse_A, certificate->floor.lower_bound_A);
    if (known.rmse_A[m] > 0) {
      EXPECT_NEAR(model.rmse_A / known.rmse_A[m], 1, 2e-9) << m;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Curves, CertifyShipped,
    ::testing::Values(Known{"rtc_france", 1, 2, {9.860218779e-4, 9.824848761e-4, 9.824848761e-4}},
                      Known{"pwp201", 1, 2, {2.425074868e-3, 2.425074868e-3, 2.425074868e-3}},
                      Known{"stm6_40_36", 1, 2, {1.729813710e-3, 1.688412363e-3, 1.688412363e-3}},
                      Known{"stp6_120_36", 1, 2, {1.660060313e-2, 1.660060313e-2, 1.660060313e-2}},
                      Known{"msx60", 1, 2, {1.575186424e-4, 2.216617042e-5, 2.172427937e-5}},
                      Known{"rtc_france", 0.5, 4, {9.860218779e-4, 0, 0}},
                      Known{"pwp201", 0.5, 4, {2.425074868e-3, 0, 0}},
                      Known{"stm6_40_36", 0.5, 4, {1.729813710e-3, 0, 0}},
                      Known{"stp6_120_36", 0.5, 4, {1.660060313e-2, 0, 0}},
                      Known{"msx60", 0.5, 4, {1.575186424e-4, 2.216617042e-5, 0}}));

// The box of the literature for PWP201 has n from 1 to 50 for the module. The third diode of the
// floor is at the lower bound, n = 1/36 per cell; the optimum of two diodes lies above the floor.
// The RMSE of both agrees with least squares in 40 digits.
TEST(Certify, ProvesTwoDiodesInTheLiteraturesBoxOfPwp201) {
  SKIP_IF_SANITIZED();
  CertifyOptions options;
  options.n_lower = 1.0 / 36;
  options.n_upper = 50.0 / 36;
  options.rs_upper_ohm = 2;
  const auto certificate = Certify(Shipped("pwp201"), options);
  ASSERT_TRUE(certificate) << certificate.error().ToString();
  EXPECT_NEAR(certificate->floor.rmse_A / 1.603618380822585e-3, 1, 1e-9);
  ASSERT_EQ(certificate->floor.diodes.size(), 3U);
  EXPECT_NEAR(certificate->floor.diodes[2].n, 1.0 / 36, 1e-12);
  const ModelCertificate& two = certificate->models[1];
  EXPECT_TRUE(two.certified);
  EXPECT_NEAR(two.rmse_A / 1.606387144468506e-3, 1, 1e-9);
  EXPECT_NEAR(two.parameters[2], 0.2700301, 1e-6);
  // Three diodes reach the floor, the third at the bound of n, with an exponent of at least 611.
  const ModelCertificate& three = certificate->models[2];
  EXPECT_TRUE(three.certified);
  EXPECT_NEAR(three.rmse_A / certificate->floor.rmse_A, 1, 1e-9);
  EXPECT_NEAR(std::min({three.parameters[2], three.parameters[6], three.parameters[8]}), 1.0 / 36,
              1e-12);
}

// Box of the literature for PWP201, solved current. The mixture of an unfinished floor is an upper
// bound for the triple-diode model, and upper bounds of models apply to the floor.
TEST(Certify, TakesWhatIsAttainedToEveryModelThatAdmitsIt) {
  constexpr double kThree_A = 1.0797463265e-3, kTwo_A = 1.2082911855e-3;  // fits from many starts
  CertifyOptions options;
  options.n_lower = 1.0 / 36;
  options.n_upper = 50.0 / 36;
  options.rs_upper_ohm = 2;
  options.is_upper_A = 5e-5;
  options.iph_upper_A = 2;
  options.rsh_upper_ohm = 2000;
  options.objective = Objective::kSolvedCurrent;
  options.models = {Model::kDoubleDiode, Model::kTripleDiode};
  for (const int effort : {30, 120}) {
    options.effort = effort;
    const auto certificate = Certify(Shipped("pwp201"), options);
    ASSERT_TRUE(certificate) << certificate.error().ToString();
    EXPECT_LE(certificate->models[0].rmse_A, kTwo_A) << effort;
    EXPECT_LE(certificate->models[1].rmse_A, kThree_A) << effort;
    EXPECT_LE(certificate->floor.rmse_A, certificate->models[1].rmse_A * (1 + 1e-9)) << effort;
    EXPECT_LE(certificate->floor.lower_bound_A, certificate->floor.rmse_A);
    for (const ModelCertificate& model : certificate->models) {
      EXPECT_GE(model.above_floor, 0);
      EXPECT_LE(certificate->floor.lower_bound_A, model.lower_bound_A);
    }
  }
}

// RMSE of three diodes refined from a random point of the ranges.
double RefinedAtRandom(const Certificate& certificate, RandomStream* random) {
  const IvCurve& curve = certificate.curve;
  const CertifyOptions& options = certificate.options;
  const Device device = MakeDevice(Model::kTripleDiode, curve.conditions);
  double current = 0;
  for (const double i : curve.current_A) current = std::max(current, std::fabs(i));
  const double voltage = certificate.reference_voltage_V;
  std::vector<double> lower(device.size(), 0), upper(device.size(), 10 * current), p(lower);
  upper[kRs] = certificate.rs_upper_ohm;
  lower[kRsh] = 1e-6 * voltage / current;
  upper[kRsh] = 1e12 * voltage / current;
  p[kIph] = 2 * current * random->Uniform();
  p[kRs] = upper[kRs] * random->Uniform() * random->Uniform();
  p[kRsh] = voltage / current * std::pow(10, 4 * random->Uniform());
  for (int d = 0; d < 3; ++d) {
    const int n = IdealityIndex(d);
    lower[n] = options.n_lower;
    upper[n] = options.n_upper;
    p[n] = lower[n] + (upper[n] - lower[n]) * random->Uniform();
    p[SaturationCurrentIndex(d)] = current * random->Uniform() /
                                   std::expm1(voltage / (p[n] * device.module_thermal_voltage_V));
  }
  const RefineProblem problem = MakeRefineProblem(
      device, Objective::kMeasuredCurrent, curve.voltage_V, curve.current_A, {}, lower, upper);
  return std::sqrt(Refine(problem, SeparableDescent(problem, p)).mean_square);
}

TEST(Certify, IsNotUndercutByAnythingOnMadeCurves) {
  for (int seed = 200; seed < 200 + Repeats(40); ++seed) {
    CertifyOptions options;
    if (seed % 2 == 1) {
      options.n_lower = 0.5;
      options.n_upper = 4;
    }
    options.models = {Model::kSingleDiode};
    const auto certificate = Certify(RandomCurve(seed), options);
    ASSERT_TRUE(certificate) << certificate.error().ToString();
    EXPECT_LE(certificate->floor.gap, 1e-9) << seed;
    EXPECT_TRUE(certificate->models[0].certified) << seed;
    RandomStream random(seed);
    for (int start = 0; start < 3; ++start) {
      EXPECT_GE(RefinedAtRandom(*certificate, &random), certificate->floor.lower_bound_A) << seed;
    }
  }
}

TEST(Certify, NeedsALitCurveAndSoundOptions) {
  IvCurve dark = Shipped("rtc_france");
  for (double& i : dark.current_A) i = -std::fabs(i);
  EXPECT_THAT(Certify(dark).error().message, HasSubstr("needs a lit curve"));
  IvCurve broken = Shipped("rtc_france");
  broken.current_A[3] = std::nan("");
  EXPECT_FALSE(Certify(broken).has_value());
  CertifyOptions options;
  options.n_lower = 2;
  EXPECT_THAT(Certify(Shipped("rtc_france"), options).error().message,
              HasSubstr("n-lower = 2 must be below n-upper = 2"));
  options = {};
  options.rs_lower_ohm = 3;
  EXPECT_THAT(Certify(Shipped("rtc_france"), options).error().message, HasSubstr("rs-lower = 3"));
  options = {};
  options.tolerance = std::nan("");
  EXPECT_THAT(Certify(Shipped("rtc_france"), options).error().message, HasSubstr("tolerance"));
}

TEST(Certify, TakesCurvesOfFewAndOutlierPoints) {
  const struct {
    std::vector<double> voltage_V, current_A;
  } outlier[] = {{{0, 0.5}, {0.76, 0.5}},
                 {{0, 0.1, 0.2, 0.3}, {1, 1, 1, 0.999}},
                 {{0, 0.1, 0.2, 0.3, 0.4, 0.5}, {0, 0.2, 0.4, 0.6, 0.8, 1}},
                 {{0, 0, 0.3, 0.3, 0.5, 0.5}, {0.76, 0.75, 0.7, 0.71, 0.3, 0.31}}};
  for (const auto& one : outlier) {
    IvCurve curve;
    curve.name = "outlier";
    curve.as_is = true;
    curve.voltage_V = one.voltage_V;
    curve.current_A = one.current_A;
    const auto certificate = Certify(curve);
    ASSERT_TRUE(certificate) << certificate.error().ToString();
    EXPECT_TRUE(std::isfinite(certificate->floor.rmse_A));
    EXPECT_LE(certificate->floor.lower_bound_A, certificate->floor.rmse_A);
    for (const ModelCertificate& model : certificate->models) {
      EXPECT_GE(model.rmse_A, certificate->floor.lower_bound_A);
    }
  }
}

TEST(Certify, StopsWhenAskedAndKeepsWhatIsProved) {
  int calls = 0;
  const Observer stop = [&](const Progress&) {
    return ++calls > 20 ? ObserverAction::kStop : ObserverAction::kContinue;
  };
  CertifyOptions options;
  options.n_lower = 0.5;
  options.n_upper = 4;
  const auto certificate = Certify(Shipped("msx60"), options, stop);
  ASSERT_TRUE(certificate);
  EXPECT_TRUE(certificate->interrupted);
  EXPECT_LE(certificate->floor.lower_bound_A, 2.125732761e-5 * (1 + 1e-9));
  EXPECT_TRUE(certificate->models.empty());
}

TEST(DualCosines, TouchZeroAtTheDiodesOfTheFloorAndStayBelow) {
  const auto certificate = Certify(Shipped("rtc_france"));
  ASSERT_TRUE(certificate);
  std::vector<double> n;
  for (int i = 0; i <= 1000; ++i) n.push_back(1 + 0.001 * i);
  for (const double cosine : DualCosines(*certificate, n)) EXPECT_LE(cosine, 1e-12);
  for (const FloorDiode& diode : certificate->floor.diodes) {
    EXPECT_NEAR(DualCosines(*certificate, {diode.n})[0], 0, 1e-12);
  }
}

}  // namespace
}  // namespace lyrefit
