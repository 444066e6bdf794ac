// The functions behind DescribeCell, on curves whose answer is known.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lyrefit/base/constants.h"
#include "lyrefit/devices/cell_figures.h"
#include "lyrefit/devices/describe_sweep.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::Not;

CellSweep SweepOf(const std::vector<double>& p, double light = 1000, bool down = false) {
  return FindSweeps(CellSweepOf(p, light, down), 0.25).front().sweep;
}

TEST(Directions, EqualSweepsHaveNoHysteresis) {
  const DirectionPair pair =
      CompareDirections(SweepOf(kCellTruth), SweepOf(kCellTruth, 1000, true), 0.5);
  EXPECT_NEAR(pair.gap_percent, 0, 1e-9);
  EXPECT_EQ(pair.sense, HysteresisSense::kNone);
  EXPECT_TRUE(pair.causes.empty());
}

TEST(Directions, SenseIsThatOfThePower) {
  std::vector<double> worse = kCellTruth;
  worse[3] = 20;
  const CellSweep good = SweepOf(kCellTruth), bad = SweepOf(worse, 1000, true);
  const DirectionPair inverted = CompareDirections(good, bad, 0.5);
  EXPECT_EQ(inverted.sense, HysteresisSense::kInverted);
  EXPECT_LT(inverted.index_power, 0);
  EXPECT_LT(inverted.index_at_80, 0);
  EXPECT_THAT(inverted.causes, Not(Contains("a capacitance")));
  const DirectionPair normal = CompareDirections(bad, good, 0.5);
  EXPECT_EQ(normal.sense, HysteresisSense::kNormal);
  EXPECT_THAT(normal.causes, Contains("a capacitance"));
}

TEST(Directions, CurvesThatCrossAreSaidToCross) {
  // More current and less voltage: nearly the same power.
  std::vector<double> other = kCellTruth;
  other[0] *= 1.04;
  other[1] *= 3;
  const DirectionPair pair =
      CompareDirections(SweepOf(kCellTruth), SweepOf(other, 1000, true), 0.5);
  EXPECT_TRUE(pair.cross);
  EXPECT_GT(pair.gap_percent, 3);
  EXPECT_LT(std::fabs(pair.index_power), 0.02);
}

// Sweeps whose directions differ by a shift of the forward one, `shift_V` at each rate.
std::string FindingOverRates(const std::vector<std::pair<double, double>>& shift_V_at_rate) {
  std::vector<CellSweep> sweeps;
  for (const auto& [rate, shift_V] : shift_V_at_rate) {
    CellSweep forward = SweepOf(kCellTruth), reverse = SweepOf(kCellTruth, 1000, true);
    for (double& v : forward.voltage_V) v -= shift_V;
    forward.key = FindKeyPoints(forward.voltage_V, forward.current_A);
    forward.scan_rate_V_s = reverse.scan_rate_V_s = rate;
    sweeps.push_back(forward);
    sweeps.push_back(reverse);
  }
  std::vector<DirectionPair> pairs = FindPairs(sweeps, 0.5);
  EXPECT_EQ(pairs.size(), shift_V_at_rate.size()) << "each with its own rate";
  const auto over = CompareRates(sweeps, &pairs);
  if (!over) return "one rate";
  EXPECT_TRUE(over->causes.empty() || pairs.back().causes == over->causes);
  return over->finding;
}

TEST(Directions, RatesTellIonsFromLateReadings) {
  using ::testing::HasSubstr;
  EXPECT_EQ(FindingOverRates({{0.1, 0.01}}), "one rate");
  EXPECT_EQ(FindingOverRates({{0.1, 0}, {1, 0}}), "");
  EXPECT_THAT(FindingOverRates({{10, 0.003}, {0.1, 0.003}, {1, 0.03}}),
              HasSubstr("maximum at 1 V/s"));
  EXPECT_THAT(FindingOverRates({{1, 0.003}, {10, 0.03}}), HasSubstr("grows with the rate"));
  EXPECT_THAT(FindingOverRates({{1, 0.03}, {10, 0.003}}), HasSubstr("falls as the rate rises"));
  EXPECT_THAT(FindingOverRates({{1, 0.01}, {10, 0.01}}), HasSubstr("hardly changes"));
}

TEST(Directions, AnIndexBelowItsNoiseHasNoSense) {
  CellSweep forward = SweepOf(kCellTruth), reverse = SweepOf(kCellTruth, 1000, true);
  // More current near Voc only: a gap, and no power.
  for (std::size_t k = 0; k < forward.voltage_V.size(); ++k) {
    if (forward.voltage_V[k] > 0.8) forward.current_A[k] += 5e-4;
  }
  forward.noise_A = reverse.noise_A = 1e-6;
  const DirectionPair pair = CompareDirections(forward, reverse, 0.5);
  EXPECT_GT(pair.gap_percent, 0.5);
  EXPECT_GT(pair.index_noise, 0);
  EXPECT_EQ(pair.sense, HysteresisSense::kNeither);
}

TEST(Idealities, AreThoseOfADiodeWithoutAShunt) {
  const double thermal = ThermalVoltage(298.15);
  std::vector<VocPoint> points;
  for (const double light : {1e-3, 3e-3, 1e-2}) {
    points.push_back({light, 1.7 * thermal * std::log(light / 1e-12)});
  }
  const auto found = FindIdealityOverLight(points, thermal);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->n.value, 1.7, 1e-12);
  EXPECT_NEAR(found->n.high_95 - found->n.low_95, 0, 1e-9);
  EXPECT_NEAR(found->local[0].n, 1.7, 1e-12);
  EXPECT_FALSE(found->rises_to_low_light);
  EXPECT_FALSE(FindIdealityOverLight({points[0]}, thermal));
  EXPECT_TRUE(std::isnan(FindIdealityOverLight({points[0], points[1]}, thermal)->n.low_95));
}

TEST(Idealities, RiseToLowLightWithAShunt) {
  std::vector<double> shunted = kCellTruth;
  shunted[4] = 1000;
  std::vector<CellSweep> sweeps;
  for (const double light : {1000.0, 300.0, 100.0, 30.0}) sweeps.push_back(SweepOf(shunted, light));
  const auto found = FindIdealityOverLight(PointsOfLights(sweeps), ThermalVoltage(298.15));
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->rises_to_low_light);
  // Of the two brightest of a few lights.
  EXPECT_NEAR(found->junction.value, 1.4 / (1 - 0.85 / (1000 * 3e-3)), 0.05);
  EXPECT_GT(found->junction.high_95 - found->junction.low_95, 0.01);
}

// Voltages of a trace from 0.01 to 3 suns of a diode of n = 1.4 beside a shunt, with their noise.
std::vector<VocPoint> NoisyTrace(int count, double noise_V, std::uint64_t seed) {
  RandomStream random(3, seed);
  std::vector<VocPoint> points;
  const double thermal = ThermalVoltage(298.15);
  for (int k = 0; k < count; ++k) {
    const double light = 5.5e-3 * 0.01 * std::pow(300.0, k / (count - 1.0));
    double low = 0, high = 2;
    for (int step = 0; step < 60; ++step) {
      const double v = 0.5 * (low + high);
      (2e-13 * std::expm1(v / (1.4 * thermal)) + v / 4e4 < light ? low : high) = v;
    }
    points.push_back({light, low + noise_V * random.Normal()});
  }
  return points;
}

TEST(Idealities, OfATraceAreJudgedByItsNoise) {
  const double thermal = ThermalVoltage(298.15);
  int held = 0, tried = 0;
  for (const double noise_V : {1e-4, 3e-4, 1e-3}) {
    for (const int count : {25, 60, 200}) {
      for (std::uint64_t seed = 0; seed < 10; ++seed, ++tried) {
        const auto found = FindIdealityOverLight(NoisyTrace(count, noise_V, seed), thermal, 5.5e-3);
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->junction.value, 1.4, 0.2);
        held += found->junction.low_95 <= 1.4 && 1.4 <= found->junction.high_95 ? 1 : 0;
        for (const LocalIdeality& local : found->local) EXPECT_GT(local.n, 1.1);
      }
    }
  }
  EXPECT_GE(held, tried * 9 / 10) << "of " << tried;
}

TEST(Idealities, OfADarkCurveAreFoundBesideItsShunt) {
  std::vector<double> p = kCellTruth;
  p[3] = 0.1;  // nothing but the diode above the shunt
  const DarkIdeality dark = FindDarkIdeality(SweepOf(p, 0), ThermalVoltage(298.15), 1);
  EXPECT_NEAR(dark.least_n, 1.4, 0.02);
  EXPECT_GT(dark.at_V, 0.4);
}

TEST(SeriesResistances, FromTwoLightsIsExactForADiode) {
  std::vector<double> p = kCellTruth;
  p[4] = 1e9;  // a shunt shifts Isc by Isc Rs / Rsh, which the method takes for the photocurrent
  const SeriesResistance found = RsFromTwoLights(SweepOf(p), SweepOf(p, 300));
  EXPECT_NEAR(found.ohm.value, p[3], 0.02);
  EXPECT_LE(found.ohm.low_95, found.ohm.value);
}

// A shunt and a loss of collection move the value of each method, which its interval holds.
TEST(SeriesResistances, HoldTheTruthBesideShuntAndCollection) {
  const double rs = kCellTruth[3];
  for (const double collection : {0.0, 0.01, 0.03}) {
    std::vector<CellSweep> sweeps;
    for (const double light : {1000.0, 300.0, 0.0}) {
      std::vector<double> p = kCellTruth;
      p[4] = 1 / (1 / 3000.0 + collection * p[0] * light / 1000);
      sweeps.push_back(FindSweeps(CellSweepOf(p, light, false, 1e-7), 0.25).front().sweep);
    }
    for (const SeriesResistance& one :
         {RsFromTwoLights(sweeps[0], sweeps[1]), RsFromDark(sweeps[0], sweeps[2], {}),
          RsFromDark(sweeps[0], sweeps[2], {rs, rs, rs})}) {
      EXPECT_LE(one.ohm.low_95, rs) << one.Name() << ", " << collection;
      EXPECT_GE(one.ohm.high_95, rs) << one.Name() << ", " << collection;
      EXPECT_LT(one.ohm.high_95 - one.ohm.low_95, rs) << one.Name();
    }
  }
}

TEST(SeriesResistances, SayWhatTheyMiss) {
  CellSweep shorter = SweepOf(kCellTruth, 300);
  shorter.voltage_V.resize(60);
  shorter.current_A.resize(60);
  const SeriesResistance found = RsFromTwoLights(SweepOf(kCellTruth), shorter);
  EXPECT_TRUE(std::isnan(found.ohm.value));
  EXPECT_NE(found.missing, "");
  IdealityOverLight nothing;
  nothing.source = SweepKind::kSunsVoc;
  const SeriesResistance voc = RsFromVoc(SweepOf(kCellTruth), nothing);
  EXPECT_NE(voc.missing, "");
}

TEST(FillFactors, ThroughEndsKeepThem) {
  const double thermal = ThermalVoltage(298.15);
  const double ideal = FillFactorOf({0.035, 0.7, thermal});
  EXPECT_NEAR(ideal, GreenFillFactor(0.7, thermal), 2e-4);
  EXPECT_LT(FillFactorOf({0.035, 0.7, 1.5 * thermal}), ideal);
  const double shunted = FillFactorOf({0.035, 0.7, thermal, 0, 1e-3});
  EXPECT_LT(shunted, ideal);
  EXPECT_LT(FillFactorOf({0.035, 0.7, thermal, 1, 1e-3}), shunted);
  // A shunt that takes more than Isc leaves no diode.
  EXPECT_TRUE(std::isnan(FillFactorOf({0.035, 0.7, thermal, 0, 1})));
  EXPECT_TRUE(std::isnan(FillFactorOf({5, 29.5, thermal}))) << "a module taken for one cell";
}

TEST(FillFactors, LossesAtShortCircuitAreNamedByTheSplitOfAllLights) {
  const auto name = [](double collection_part, const char* void_because = "") {
    JointEstimate joint;
    joint.collection_part = collection_part;
    if (*void_because != '\0') joint.void_because.emplace_back(void_because);
    std::vector<FillFactorLosses> losses(1);
    losses[0].parts = {{"recombination", {}}, {"shunt or collection", {}}};
    NameShuntLosses(joint, &losses);
    EXPECT_EQ(losses[0].parts[0].name, "recombination");
    return losses[0].parts[1].name;
  };
  EXPECT_EQ(name(0.98), "collection that depends on voltage: 98 % goes with the light");
  EXPECT_EQ(name(1), "collection that depends on voltage");
  EXPECT_EQ(name(0.4), "collection and shunt: 40 % goes with the light");
  EXPECT_EQ(name(0), "shunt");
  EXPECT_EQ(name(kUnknown), "shunt or collection");
  EXPECT_EQ(name(0.98, "another device"), "shunt or collection");
}

TEST(FillFactors, OfVocOverLightAreThoseOfTheDiode) {
  const double thermal = ThermalVoltage(298.15);
  std::vector<VocPoint> points;
  for (double suns = 1e-3; suns < 2; suns *= 2) {
    points.push_back({0.035 * suns, thermal * std::log1p(suns * std::expm1(0.7 / thermal))});
  }
  EXPECT_NEAR(PseudoFillFactorOf(0.035, points), FillFactorOf({0.035, 0.7, thermal}), 1e-6);
  EXPECT_TRUE(std::isnan(PseudoFillFactorOf(0.35, points)));
  // Only points near Voc: the power point is not among them.
  points.erase(points.begin(), points.end() - 3);
  EXPECT_TRUE(std::isnan(PseudoFillFactorOf(0.035, points)));
}

TEST(StatedKeyPoints, ADensityNeedsAnArea) {
  CellSweep sweep;
  sweep.key.short_circuit_current_A = 5.5e-3;
  const std::vector<StatedResult> stated = {{0, "J_sc", 22.1, "line 2"},
                                            {0, "I_sc", 5.51, "line 3"}};
  const auto with = CompareStated(stated, sweep, 0.25);
  ASSERT_EQ(with.size(), 2U);
  EXPECT_NEAR(with[0].found, 22, 1e-9);
  EXPECT_NEAR(with[1].found, 5.5, 1e-9);
  const auto without = CompareStated(stated, sweep, kUnknown);
  ASSERT_EQ(without.size(), 1U);
  EXPECT_EQ(without[0].name, "I_sc");
}

TEST(Slopes, AreTakenNearTheAxes) {
  std::vector<double> p = kCellTruth;
  p[3] = 1e-3;
  const CellSweep sweep = SweepOf(p);
  EXPECT_NEAR(sweep.resistance_at_isc_ohm, p[4], 0.02 * p[4]);
  EXPECT_GT(sweep.resistance_at_voc_ohm, p[2] * ThermalVoltage(298.15) / p[0]);
}

}  // namespace
}  // namespace lyrefit
