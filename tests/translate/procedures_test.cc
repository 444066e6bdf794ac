#include "lyrefit/translate/procedures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/model/model_points.h"
#include "synthetic_string.h"

namespace lyrefit {
namespace {

constexpr Procedure kAll[] = {Procedure::kIec1, Procedure::kIec2, Procedure::kIec4,
                              Procedure::kDeSoto, Procedure::kPvsyst};

TEST(Procedures, LeaveTheCurveAsItIsWhereTheTargetIsTheSource) {
  const SyntheticModule module;
  const PreparedCurve curve = module.Curve(700, 40, {700, 40});
  const KeyPoints source = FindKeyPoints(curve.points.voltage_V, curve.points.current_A);
  for (const Procedure procedure : kAll) {
    const auto key = TranslatedKeyPoints(procedure, curve, module.Inputs(700, 40));
    ASSERT_TRUE(key) << ToText(procedure) << ": " << key.error().message;
    EXPECT_NEAR(key->max_power_W, source.max_power_W, 1e-6 * source.max_power_W)
        << ToText(procedure);
    EXPECT_NEAR(key->open_circuit_voltage_V, source.open_circuit_voltage_V, 1e-6);
    EXPECT_NEAR(key->short_circuit_current_A, source.short_circuit_current_A, 1e-6);
  }
}

// De Soto's law is exact for a device that follows it.
TEST(Procedures, DeSotoIsExactOnItsOwnDevice) {
  const SyntheticModule module;
  for (const double g : {300.0, 700.0, 1100.0}) {
    PreparedCurve curve = module.Curve(g, 50, {1000, 25});
    curve.bandgap.reset();  // the stated band gap applies
    const KeyPoints truth = module.Truth(1000, 25);
    const auto key = TranslatedKeyPoints(Procedure::kDeSoto, curve, module.Inputs(g, 50));
    ASSERT_TRUE(key) << key.error().message;
    // The remaining error comes from the interpolation of the readings.
    EXPECT_NEAR(key->max_power_W, truth.max_power_W, 2e-4 * truth.max_power_W) << g;
    EXPECT_NEAR(key->open_circuit_voltage_V, truth.open_circuit_voltage_V, 2e-3) << g;
  }
}

// A step of 5 % of light and 4 K has an error below 0.15 % of Pmax; half the step has at most half
// the error.
TEST(Procedures, AreCloseToTheTruthForSmallSteps) {
  const SyntheticModule module;
  const auto error = [&](Procedure procedure, double part) {
    const double g = 950 + 50 * part, t = 29 - 4 * part;
    const PreparedCurve curve = module.Curve(950, 29, {g, t});
    const auto key = TranslatedKeyPoints(procedure, curve, module.Inputs(950, 29));
    if (!key) return kUnknown;
    return std::fabs(key->max_power_W / module.Truth(g, t).max_power_W - 1);
  };
  for (const Procedure procedure : kAll) {
    EXPECT_LT(error(procedure, 1), 1.5e-3) << ToText(procedure);
    EXPECT_LT(error(procedure, 0.5), 0.75e-3) << ToText(procedure);
  }
}

// Two readings worked out by hand: I1 = 5 A, Isc1 = 6 A, 750 -> 1000 W/m2, 45 -> 25 C, alpha
// 0.004 A/K, beta -0.12 V/K, kappa 0.001 ohm/K, Rs 0.3 ohm:
//   I2 = 5 + 6 (1000 / 750 - 1) + 0.004 (-20) = 6.92 A
//   V2 = V1 - 0.3 (1.92) - 0.001 * 6.92 * (-20) + (-0.12) (-20) = V1 + 1.9624 V
TEST(Procedures, OneMovesPointsAsWorkedOutByHand) {
  PreparedCurve curve;
  curve.points = {{0, 10, 20, 24}, {6, 6, 5, -3}};
  curve.cells_in_series = 40;
  curve.diode = SingleDiodeFit{6, 1e-9, 1, 0.3, 1e6};
  curve.target = {1000, 25};
  TranslationInputs in;
  in.irradiance_W_m2 = 750;
  in.temperature_C = 45;
  in.voltage_gain = in.current_gain = 1;
  in.alpha_sc_A_K = 0.004;
  in.beta_oc_V_K = -0.12;
  in.kappa_ohm_K = 0.001;
  in.resistance_series_ohm = 0.3;
  const auto moved = TranslatedPoints(Procedure::kIec1, curve, in);
  ASSERT_TRUE(moved) << moved.error().message;
  bool found = false;
  for (std::size_t i = 0; i < moved->voltage_V.size(); ++i) {
    if (std::fabs(moved->voltage_V[i] - 21.9624) > 1e-9) continue;
    EXPECT_NEAR(moved->current_A[i], 6.92, 1e-12);
    found = true;
  }
  EXPECT_TRUE(found);
  // Procedure 4 of the same point: I' = 7, V' = 20 - 0.3 * 2 = 19.4, and
  // V2 = 19.4 + (-20 / 318.15) (19.4 - 40 * 1.232) = 21.27833...
  in.epsilon_V = 1.232;
  const auto fourth = TranslatedPoints(Procedure::kIec4, curve, in);
  ASSERT_TRUE(fourth) << fourth.error().message;
  const double by_hand = 19.4 - 20 / 318.15 * (19.4 - 40 * 1.232);
  found = false;
  for (std::size_t i = 0; i < fourth->voltage_V.size(); ++i) {
    if (std::fabs(fourth->voltage_V[i] - by_hand) > 1e-9) continue;
    EXPECT_NEAR(fourth->current_A[i], 6.92, 1e-12);
    found = true;
  }
  EXPECT_TRUE(found);
}

TEST(Procedures, AllowForLeadsBeforeAllElse) {
  const SyntheticModule module;
  PreparedCurve bare = module.Curve(800, 45, {1000, 25});
  PreparedCurve led = bare;
  constexpr double kLeads_ohm = 0.25;
  for (std::size_t i = 0; i < led.points.voltage_V.size(); ++i) {
    led.points.voltage_V[i] -= kLeads_ohm * led.points.current_A[i];
  }
  led.diode->resistance_series_ohm += kLeads_ohm;
  TranslationInputs with = module.Inputs(800, 45);
  with.lead_resistance_ohm = kLeads_ohm;
  for (const Procedure procedure : kAll) {
    const auto expected = TranslatedKeyPoints(procedure, bare, module.Inputs(800, 45));
    const auto found = TranslatedKeyPoints(procedure, led, with);
    ASSERT_TRUE(expected && found) << ToText(procedure);
    EXPECT_NEAR(found->max_power_W, expected->max_power_W, 1e-9 * expected->max_power_W)
        << ToText(procedure);
  }
}

// IEC TS 60904-1-2: 850 W/m2 on the front and 100 on the rear at a bifaciality of 0.7 equal 920
// W/m2.
TEST(Procedures, CountTheLightBehind) {
  const SyntheticModule module;
  TranslationInputs both = module.Inputs(920, 40);
  both.irradiance_W_m2 = 850;
  both.rear_irradiance_W_m2 = 100;
  both.bifaciality_isc = 0.7;
  EXPECT_DOUBLE_EQ(EquivalentIrradiance(both), 920);
  const PreparedCurve curve = module.Curve(920, 40, {1000, 25});
  for (const Procedure procedure : kAll) {
    const auto expected = TranslatedKeyPoints(procedure, curve, module.Inputs(920, 40));
    const auto found = TranslatedKeyPoints(procedure, curve, both);
    ASSERT_TRUE(expected && found);
    EXPECT_DOUBLE_EQ(found->max_power_W, expected->max_power_W);
  }
}

// Gains of voltage and current scale the fitted curve and nothing else.
TEST(Procedures, BendTheFittedDiodeWithTheGains) {
  const SyntheticModule module;
  const PreparedCurve curve = module.Curve(800, 45, {800, 45});
  TranslationInputs in = module.Inputs(800, 45);
  const auto plain = TranslatedKeyPoints(Procedure::kDeSoto, curve, in);
  in.voltage_gain = 1.01;
  in.current_gain = 0.98;
  const auto found = TranslatedKeyPoints(Procedure::kDeSoto, curve, in);
  ASSERT_TRUE(plain && found);
  EXPECT_NEAR(found->open_circuit_voltage_V, 1.01 * plain->open_circuit_voltage_V, 1e-9);
  EXPECT_NEAR(found->max_power_W, 1.01 * 0.98 * plain->max_power_W, 1e-7);
}

TEST(Procedures, SayWhatIsMissing) {
  const SyntheticModule module;
  PreparedCurve curve = module.Curve(800, 45, {1000, 25});
  const TranslationInputs in = module.Inputs(800, 45);
  EXPECT_FALSE(TranslatedKeyPoints(Procedure::kIec3, curve, in));
  EXPECT_FALSE(TranslatedKeyPoints(Procedure::kExtended, curve, in));
  EXPECT_FALSE(TranslatedKeyPoints(Procedure::kExtended, curve, in, 3));
  TranslationInputs dark = in;
  dark.irradiance_W_m2 = 0;
  for (const Procedure procedure : kAll) {
    const auto key = TranslatedKeyPoints(procedure, curve, dark);
    ASSERT_FALSE(key) << ToText(procedure);
    EXPECT_NE(key.error().message.find("without light"), std::string::npos);
  }
  curve.diode.reset();
  for (const Procedure procedure : kAll) {
    EXPECT_FALSE(TranslatedKeyPoints(procedure, curve, in)) << ToText(procedure);
  }
}

}  // namespace
}  // namespace lyrefit
