#include "lyrefit/certify/cause_floor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "certify/made.h"
#include "error_of.h"
#include "lyrefit/certify/cause_upper_bound.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

// A simulated device: a diode, a shunt and up to two more leaks, implemented independently of the
// library.
struct Planted {
  double photocurrent_A = 0.76, saturation_A = 3e-7, n_vt_V = 1.48 * 0.0264, rs = 0.036;
  double shunt_S = 0.0186;
  double collection_A_V = 0;                         // photocurrent times collection parameter chi
  double power_A[2] = {0, 0}, exponent[2] = {2, 2};  // current in A at 0.6 V
  double second_A = 0;                               // saturation current with n = 2

  double AtJunction(double v) const {
    double i = photocurrent_A - saturation_A * std::expm1(v / n_vt_V) - shunt_S * v;
    const double gap = 0.9 - v, within = std::max(gap, 0.03);
    i -= collection_A_V * (1 / within + (within - gap) / (0.03 * 0.03));
    for (int k = 0; k < 2; ++k) {
      i -= power_A[k] * std::copysign(std::pow(std::fabs(v) / 0.6, exponent[k]), v);
    }
    return i - second_A * std::expm1(v / (2 * 0.0264));
  }
  double Current(double v) const {
    double low = -50, high = 2;
    for (int k = 0; k < 100; ++k) {
      const double middle = 0.5 * (low + high);
      (AtJunction(v + middle * rs) > middle ? low : high) = middle;
    }
    return low;
  }
  double Rmse(const IvCurve& curve) const {  // measured-current
    double sum = 0;
    for (std::size_t k = 0; k < curve.size(); ++k) {
      const double i = curve.current_A[k];
      const double r = AtJunction(curve.voltage_V[k] + i * rs) - i;
      sum += r * r;
    }
    return std::sqrt(sum / static_cast<double>(curve.size()));
  }
};

IvCurve CurveOf(const Planted& planted, double noise_A, std::uint64_t seed, int points = 50) {
  RandomStream random(seed, 5);
  IvCurve curve;
  curve.name = "planted " + std::to_string(seed);
  curve.conditions.cells_in_series = 1;
  curve.conditions.cell_temperature_K = 0.0264 / 8.617333262e-5;
  for (int k = 0; k < points; ++k) {
    curve.voltage_V.push_back(-0.05 + 0.66 * k / (points - 1));
    curve.current_A.push_back(planted.Current(curve.voltage_V.back()) + noise_A * random.Normal());
  }
  return curve;
}

Planted SomeDevice(RandomStream* random) {
  Planted planted;
  planted.n_vt_V = (1 + 0.8 * random->Uniform()) * 0.0264;
  planted.saturation_A = 0.8 / std::expm1(0.58 / planted.n_vt_V);
  planted.rs = 0.08 * random->Uniform();
  planted.shunt_S = 0.05 * random->Uniform();
  return planted;
}

CauseFloors ProveOrFail(const IvCurve& curve, const CauseFloorOptions& options = {}) {
  const auto floors = ProveCauses(curve, options);
  EXPECT_TRUE(floors.has_value()) << floors.error().message;
  return floors ? *floors : CauseFloors();
}

const ProvedCause& Of(const CauseFloors& floors, const std::string& cause) {
  for (const ProvedCause& one : floors.causes) {
    if (one.cause == cause) return one;
  }
  return floors.without;
}

// Proofs over exponents may be incomplete for curves with very little noise. Returns the number of
// incomplete ones.
int ExpectTight(const CauseFloors& floors, const std::string& name) {
  const double base = floors.without.rmse_A;
  int given_up = 0;
  for (const ProvedCause& one : floors.causes) {
    EXPECT_TRUE(one.complete || one.cause == "nonohmic_shunt") << name << " " << one.cause;
    given_up += one.complete ? 0 : 1;
    EXPECT_LE(one.lower_bound_A, one.rmse_A) << name << " " << one.cause;
    EXPECT_LE(one.rmse_A, base * (1 + 1e-9)) << name << " " << one.cause;
    if (!one.complete) continue;
    const double gap = one.rmse_A * one.rmse_A - one.lower_bound_A * one.lower_bound_A;
    const double allowed = std::max(0.02 * one.rmse_A * one.rmse_A, 0.005 * base * base);
    EXPECT_LE(gap, allowed * (1 + 1e-6)) << name << " " << one.cause;
  }
  return given_up;
}

TEST(CauseFloor, NoPlantedParametersUndercutIt) {
  RandomStream random(11);
  for (int seed = 0; seed < Repeats(24); ++seed) {
    Planted planted = SomeDevice(&random);
    const char* cause = "collection";
    if (seed % 4 == 0) planted.collection_A_V = 0.1 * random.Uniform();
    if (seed % 4 == 1) {
      cause = "second_diode";
      planted.second_A = 1e-5 * random.Uniform();
    }
    if (seed % 4 > 1) {  // with one or two exponents
      cause = "nonohmic_shunt";
      for (int k = 0; k < seed % 4 - 1; ++k) {
        planted.power_A[k] = 0.2 * random.Uniform();
        planted.exponent[k] = 1.3 + 3.7 * random.Uniform();
      }
    }
    const double noise = std::pow(10, -5 + 3 * random.Uniform());
    const IvCurve curve = CurveOf(planted, noise, seed);
    const CauseFloors floors = ProveOrFail(curve, {{cause}});
    EXPECT_LE(floors.causes[0].lower_bound_A, planted.Rmse(curve)) << seed << " " << cause;
    ExpectTight(floors, curve.name);
  }
}

// Descents from random starts never end below the proved lower bound.
TEST(CauseFloor, NoDescentUndercutsIt) {
  int given_up = 0;
  for (int seed = 30; seed < 30 + Repeats(20); ++seed) {
    const IvCurve curve = RandomCurve(seed);
    const CauseFloors floors = ProveOrFail(curve);
    given_up += ExpectTight(floors, curve.name);
    const MixtureData data = DataOf(curve);
    const double vt = curve.conditions.ModuleThermalVoltage(ConstantSet::kCodata);
    const double reference = data.reference_voltage_V, largest = data.current_A.maxCoeff();
    const CauseRegion region = {{1 / (4 * vt), 1 / (0.5 * vt)}, 0, 4 * reference / largest};
    const std::pair<std::string, CauseShape> shapes[] = {
        {"collection", CollectionShape(curve.conditions.cells_in_series, 3 * largest)},
        {"second_diode", DiodeShape(1 / (2 * vt), reference, 3 * largest)},
        {"nonohmic_shunt",
         PowerShape(data.voltage_V.cwiseAbs().maxCoeff(), {1.3, 5}, 3 * largest)}};
    RandomStream random(seed);
    for (const auto& [cause, made] : shapes) {
      const auto shape = std::make_shared<CauseShape>(made);
      for (int start = 0; start < 4; ++start) {
        CausePoint point = {0.2 * region.rs_upper * random.Uniform(),
                            1 / ((0.6 + 2 * random.Uniform()) * vt),
                            made.theta.upper > 0 ? 1.4 + 3 * random.Uniform() : 0, kInfinity};
        point = Descend(data, shape, region, point);
        const double rmse = std::sqrt(2 * point.primal / static_cast<double>(curve.size()));
        EXPECT_GE(rmse, Of(floors, cause).lower_bound_A * (1 - 1e-9)) << seed << " " << cause;
      }
    }
  }
  EXPECT_LE(given_up, 3);
}

// The bound of the true cause is close to the noise; those of the others lie above it.
TEST(CauseFloor, LeavesNoiseToTheRightCauseAlone) {
  SKIP_IF_SANITIZED();
  constexpr double kNoise = 1e-4;
  Planted planted;
  planted.collection_A_V = 0.03;
  const CauseFloors faded = ProveOrFail(CurveOf(planted, kNoise, 1));
  EXPECT_GT(faded.without.rmse_A, 2.5 * kNoise);
  EXPECT_LT(Of(faded, "collection").lower_bound_A, 1.1 * kNoise);
  EXPECT_GT(Of(faded, "collection").lower_bound_A, 0.8 * kNoise);
  EXPECT_GT(Of(faded, "second_diode").lower_bound_A, 2 * kNoise);
  planted.collection_A_V = 0;
  planted.n_vt_V = 0.0264;
  planted.saturation_A = 1e-10;
  planted.second_A = 2e-6;
  const CauseFloors doubled = ProveOrFail(CurveOf(planted, kNoise, 2));
  EXPECT_GT(doubled.without.rmse_A, 5 * kNoise);
  EXPECT_LT(Of(doubled, "second_diode").lower_bound_A, 1.1 * kNoise);
  EXPECT_GT(Of(doubled, "collection").lower_bound_A, 2 * kNoise);
}

TEST(CauseFloor, AgreesWithWhatIsKnownOfRtc) {
  const CauseFloors floors = ProveOrFail(Shipped("rtc_france"));
  EXPECT_NEAR(floors.without.rmse_A, 9.860219e-4, 1e-9);
  // With n2 = 2 the floor is the best fit of two diodes with n up to 2; n1 from 0.5 to 4 gives no
  // lower one.
  EXPECT_NEAR(Of(floors, "second_diode").rmse_A, 9.824849e-4, 1e-9);
  EXPECT_NEAR(Of(floors, "nonohmic_shunt").parameter, 1.35, 0.01);
  EXPECT_EQ(ExpectTight(floors, "RTC"), 0);
  CauseFloorOptions options;
  options.recombination = true;
  options.causes = {"collection"};
  const CauseFloors beside = ProveOrFail(Shipped("rtc_france"), options);
  EXPECT_NEAR(beside.without.rmse_A, 9.824849e-4, 1e-9);
  EXPECT_LE(beside.causes[0].rmse_A, Of(floors, "collection").rmse_A * (1 + 1e-6));
}

TEST(CauseFloor, SaysWhatItCannotProve) {
  IvCurve curve = Shipped("rtc_france");
  EXPECT_THAT(MessageOf(ProveCauses(curve, {{"drift"}})),
              HasSubstr("no floor is known for 'drift'"));
  CauseFloorOptions options;
  options.n_lower = 5;
  EXPECT_THAT(MessageOf(ProveCauses(curve, options)), HasSubstr("n-lower = 5 must be"));
  options = {};
  options.exponent_lower = 1;
  EXPECT_THAT(MessageOf(ProveCauses(curve, options)), HasSubstr("begin above 1, found 1 to 5"));
  for (double& i : curve.current_A) i = -1;
  EXPECT_THAT(MessageOf(ProveCauses(curve)), HasSubstr("a floor needs a lit curve"));
  IvCurve module = Shipped("msx60");
  module.conditions.cells_in_series = 1;
  options = {};
  options.n_upper = 2;
  EXPECT_THAT(MessageOf(ProveCauses(module, options)),
              HasSubstr("is the number of cells in series, 1"));
}

TEST(CauseFloor, HoldsWhereItIsStopped) {
  CauseFloorOptions options;
  options.effort = 10;
  const CauseFloors few = ProveOrFail(Shipped("rtc_france"), options);
  const CauseFloors many = ProveOrFail(Shipped("rtc_france"));
  for (std::size_t k = 0; k < few.causes.size(); ++k) {
    EXPECT_FALSE(few.causes[k].complete);
    EXPECT_LE(few.causes[k].lower_bound_A, many.causes[k].rmse_A);
  }
  options.stop = StopToken([] { return true; });
  EXPECT_FALSE(ProveOrFail(Shipped("rtc_france"), options).without.complete);
}

}  // namespace
}  // namespace lyrefit
