#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/model/device_effects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "diagnose/synthetic_diagnosis.h"
#include "error_of.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/model/kernel.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// Conditions that every diagnosis meets, whatever its result.
void ExpectComplete(const Diagnosis& d) {
  EXPECT_FALSE(d.version.empty() || d.base_sentence.empty() || d.verdict.sentence.empty());
  EXPECT_FALSE(d.evidence.kind.empty() || d.gain.sentence.empty());
  EXPECT_GT(d.seconds, 0);
  EXPECT_EQ(d.trials.size(), Catalogue().size());
  for (std::size_t k = 0; k < d.trials.size(); ++k) {
    EXPECT_EQ(d.trials[k].effect, Catalogue()[k]->id);
    EXPECT_EQ(d.trials[k].tried, d.trials[k].why_not.empty()) << d.trials[k].effect;
  }
  int points = 0;
  for (const DiagnosedCurve& curve : d.curves) points += curve.points;
  ASSERT_EQ(static_cast<int>(d.points.size()), points);
  for (const DiagnosedPoint& point : d.points) {
    EXPECT_TRUE(std::isfinite(point.before_A) && std::isfinite(point.after_A));
    EXPECT_GT(point.sigma_A, 0);
  }
  EXPECT_EQ(d.verdict.found, !d.verdict.causes.empty());
  for (const Cause& cause : d.verdict.causes) {
    EXPECT_NE(FindEffect(cause.id), nullptr);
    EXPECT_FALSE(cause.title.empty() || cause.sentence.empty() || cause.acts.empty());
    EXPECT_TRUE(cause.evidence == "fit" || cause.evidence == "values");
    for (const int point : cause.points) EXPECT_LT(point, points);
    for (const std::string& id : cause.equivalents) EXPECT_NE(FindEffect(id), nullptr);
  }
  EXPECT_TRUE(d.extended.usable);
  EXPECT_GE(d.extended.estimates.size(), 5U);
  EXPECT_GE(d.gain.shifts.size(), 5U);
}

TEST(DiagnoseTest, ACleanCurveIsClean) {
  const Diagnosis d = DiagnoseOrFail(SyntheticCurve({}));
  ExpectComplete(d);
  EXPECT_THAT(Ids(d), IsEmpty());
  EXPECT_FALSE(d.verdict.unexplained);
  EXPECT_THAT(d.verdict.sentence, HasSubstr("Nothing to act on"));
  EXPECT_THAT(d.warnings, IsEmpty());
  for (const DiagnosedPoint& point : d.points) EXPECT_EQ(point.before_A, point.after_A);
  EXPECT_NEAR(d.points[30].sigma_A, 0.004, 0.0015);
  EXPECT_NEAR(d.evidence.misfit_ratio, 1, 0.3);
}

TEST(DiagnoseTest, ANamedCauseIsDescribed) {
  DiagnoseOptions options = Quick();
  options.held_out = true;
  options.folds = 5;
  const Diagnosis d = DiagnoseOrFail(CurveWithAStep(), options);
  ExpectComplete(d);
  ASSERT_THAT(Ids(d), Contains("irr_step"));
  const Cause& cause = d.verdict.causes.front();
  ASSERT_EQ(cause.id, "irr_step");
  EXPECT_GT(cause.probability, 0.9);
  ASSERT_EQ(cause.strength.size(), 2U);
  EXPECT_NEAR(cause.strength[0].value, 0.015, 0.002);
  EXPECT_LT(cause.strength[0].low_95, cause.strength[0].value);
  EXPECT_GT(cause.strength[0].high_95, cause.strength[0].value);
  EXPECT_FALSE(cause.points.empty());
  EXPECT_LT(d.gain.rmse_after_A, d.gain.rmse_before_A);
  EXPECT_LT(d.gain.held_out_after_A, d.gain.held_out_before_A);
  EXPECT_TRUE(d.gain.gain);
  EXPECT_GT(d.gain.folds, 2);
}

TEST(DiagnoseTest, AStatedSigmaOfTheCurrentsIsBelieved) {
  IvCurve curve = SyntheticCurve({});  // noise of 0.004 A
  curve.sigma_A.assign(curve.size(), 0.02);
  const Diagnosis d = DiagnoseOrFail(curve);
  for (const DiagnosedPoint& point : d.points) EXPECT_NEAR(point.sigma_A, 0.02, 1e-12);
  EXPECT_NEAR(d.evidence.noise_stated_A, 0.02, 1e-12);
  EXPECT_LT(d.evidence.misfit_ratio, 0.4);

  DiagnoseOptions laboratory = Quick();
  laboratory.noise = {};
  const Diagnosis estimated = DiagnoseOrFail(curve, laboratory);
  EXPECT_NEAR(estimated.points[30].sigma_A, 0.004, 0.0015);
  EXPECT_EQ(estimated.evidence.noise_stated_A, 0);
}

TEST(DiagnoseTest, OfALongCurveAStatedSigmaIsThatOfEveryReading) {
  Recipe recipe;
  recipe.points = 3000;
  IvCurve curve = SyntheticCurve(recipe);
  for (std::size_t k = 0; k < curve.size(); ++k) curve.sigma_A.push_back(0.004 + 1e-6 * k);
  const Diagnosis d = DiagnoseOrFail(curve);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    ASSERT_NEAR(d.points[k].sigma_A, curve.sigma_A[k], 1e-12);
  }
  EXPECT_THAT(Ids(d), IsEmpty());
}

TEST(DiagnoseTest, WithinOneSweepItSaysThatHeldOutConfirmsNothing) {
  DiagnoseOptions options = Quick();
  options.held_out = true;
  options.folds = 4;
  const Diagnosis one = DiagnoseOrFail(CurveWithAStep(), options);
  EXPECT_FALSE(one.gain.by_sweeps);
  EXPECT_THAT(one.gain.sentence, HasSubstr("they cannot tell a fault from it"));
  options.noise = {};
  EXPECT_THAT(DiagnoseOrFail(CurveWithAStep(), options).gain.sentence, Not(HasSubstr("sweep")));
}

TEST(DiagnoseTest, OfSeveralSweepsWholeOnesAreHeldOut) {
  DiagnoseOptions options = LaboratoryOptions();
  options.held_out = true;
  options.effects = {"nonohmic_shunt"};
  IvCurve all;
  for (int sweep = 0; sweep < 4; ++sweep) {
    Recipe recipe;
    recipe.cells = 60;
    recipe.seed = 10 + sweep;
    IvCurve one = SyntheticCurve(recipe);
    // a shunt whose current grows with the cube of the voltage
    for (std::size_t k = 0; k < one.size(); ++k) {
      one.current_A[k] -= 2 * std::pow(one.voltage_V[k] / 60, 3);
    }
    if (sweep % 2 == 1) {
      std::reverse(one.voltage_V.begin(), one.voltage_V.end());
      std::reverse(one.current_A.begin(), one.current_A.end());
    }
    if (sweep == 0) {
      all = one;
      continue;
    }
    all.voltage_V.insert(all.voltage_V.end(), one.voltage_V.begin(), one.voltage_V.end());
    all.current_A.insert(all.current_A.end(), one.current_A.begin(), one.current_A.end());
  }
  const Diagnosis d = DiagnoseOrFail(all, options);
  ASSERT_THAT(Ids(d), Contains("nonohmic_shunt"));
  EXPECT_TRUE(d.gain.by_sweeps);
  EXPECT_EQ(d.gain.folds, 4);
  EXPECT_TRUE(d.gain.gain);
  EXPECT_EQ(d.gain.sentence, "the gain holds on whole sweeps that were not fitted");
}

// A module of which a part is behind a resistance of its own, and the Suns-Voc trace of its flash:
// open-circuit voltages at Isc (1 - suns), 3 mV per cell below those of the sweep.
CurveSet FlashWithTrace(double far_ohm, double far_share) {
  Recipe recipe;
  recipe.cells = 60;
  IvCurve load = SyntheticCurve(recipe), trace = load;
  std::vector<double> p = SyntheticParameters(recipe);
  const double rs = p[kRs];
  p[kRs] = 0;
  const Device junction = MakeDevice(Model::kSingleDiode, load.conditions);
  const double open = 0.632 * recipe.cells;
  RandomStream random(5);
  for (int k = 0; k < recipe.points; ++k) {
    trace.voltage_V[k] = open * k / (recipe.points - 1);
    load.voltage_V[k] = far_ohm * p[kIph] + (open - far_ohm * p[kIph]) * k / (recipe.points - 1);
  }
  trace.current_A = SolveCurrents(junction, p.data(), trace.voltage_V);
  for (double& voltage : trace.voltage_V) voltage -= 0.003 * recipe.cells;
  const std::vector<double> far = SolveCurrents(junction, p.data(), load.voltage_V);
  for (int k = 0; k < recipe.points; ++k) load.voltage_V[k] -= far_ohm * far[k];
  load.current_A = SolveCurrents(junction, p.data(), load.voltage_V);
  for (int k = 0; k < recipe.points; ++k) {
    double& current = load.current_A[k];
    current = (1 - far_share) * current + far_share * far[k];
    load.voltage_V[k] -= rs * current;
    current += 0.004 * random.Normal();
  }
  trace.name = "trace";
  trace.suns_voc_A = p[kIph];
  return SetOf({trace, load});
}

TEST(DiagnoseTest, ASunsVocTraceIsTheDeviceWithoutItsResistances) {
  const Diagnosis aged = DiagnoseOrFail(FlashWithTrace(2, 0.35), Quick());
  ExpectComplete(aged);
  ASSERT_FALSE(aged.verdict.causes.empty());
  const Cause& cause = aged.verdict.causes.front();
  EXPECT_EQ(cause.id, "distributed_rs");
  EXPECT_EQ(cause.effect, "aged_contacts");
  ASSERT_EQ(cause.strength.size(), 2U);
  EXPECT_NEAR(cause.strength[0].value, 2, 0.2);
  EXPECT_NEAR(cause.strength[1].value, 0.35, 0.03);
  EXPECT_EQ(aged.evidence.kind, "one sweep, and Suns-Voc, beyond open circuit");
  EXPECT_THAT(Ids(DiagnoseOrFail(FlashWithTrace(0, 0.35), Quick())), IsEmpty());
  CurveSet alone = FlashWithTrace(0, 0.35);
  alone.curves.pop_back();
  EXPECT_THAT(MessageOf(Diagnose(alone)), HasSubstr("a Suns-Voc trace"));
}

TEST(DiagnoseTest, RefusesBadInput) {
  EXPECT_FALSE(Diagnose(CurveSet()));
  Recipe few;
  few.points = 6;
  EXPECT_FALSE(Diagnose(SyntheticCurve(few)));
  IvCurve broken = SyntheticCurve({});
  broken.voltage_V[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(Diagnose(broken));
  DiagnoseOptions options;
  options.effects = {"drift", "nonsense"};
  EXPECT_THAT(MessageOf(Diagnose(SyntheticCurve({}), options)), HasSubstr("'nonsense'"));
  for (const double probability : {0.0, 0.4, 1.0, std::nan("")}) {
    options = {};
    options.probability = probability;
    EXPECT_FALSE(Diagnose(SyntheticCurve({}), options)) << probability;
  }
  options = {};
  options.base = Model::kTripleDiode;
  EXPECT_FALSE(Diagnose(SyntheticCurve({}), options));
}

// Compares every result except times.
void ExpectSame(const Diagnosis& a, const Diagnosis& b) {
  EXPECT_EQ(Ids(a), Ids(b));
  EXPECT_EQ(a.gain.held_out_before_A, b.gain.held_out_before_A);
  EXPECT_EQ(a.gain.held_out_after_A, b.gain.held_out_after_A);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t k = 0; k < a.points.size(); ++k) {
    EXPECT_EQ(a.points[k].after_A, b.points[k].after_A);
    EXPECT_EQ(a.points[k].sigma_A, b.points[k].sigma_A);
  }
  ASSERT_EQ(a.extended.estimates.size(), b.extended.estimates.size());
  for (std::size_t k = 0; k < a.extended.estimates.size(); ++k) {
    EXPECT_EQ(a.extended.estimates[k].refined, b.extended.estimates[k].refined);
  }
  for (std::size_t k = 0; k < a.trials.size(); ++k) {
    if (!a.trials[k].tried) continue;
    const bool unfitted =
        std::isnan(a.trials[k].log_evidence) && std::isnan(b.trials[k].log_evidence);
    EXPECT_TRUE(unfitted || a.trials[k].log_evidence == b.trials[k].log_evidence);
    const bool both_unknown =
        std::isnan(a.trials[k].held_out_rmse_A) && std::isnan(b.trials[k].held_out_rmse_A);
    EXPECT_TRUE(both_unknown || a.trials[k].held_out_rmse_A == b.trials[k].held_out_rmse_A);
  }
}

TEST(DiagnoseTest, RepeatsItselfBitForBitOnAnyNumberOfThreads) {
  DiagnoseOptions options;
  options.folds = 4;
  options.seed = 11;
  options.threads = 1;
  const Diagnosis one = DiagnoseOrFail(CurveWithAStep(), options);
  options.threads = 2;
  ExpectSame(one, DiagnoseOrFail(CurveWithAStep(), options));
}

TEST(DiagnoseTest, ADarkCurveThatIsSaidToBeLitIsTakenAsDark) {
  IvCurve dark = SyntheticDarkCurve();
  dark.conditions.irradiance_W_m2 = 1000;
  const Diagnosis d = DiagnoseOrFail(dark);
  ExpectComplete(d);
  EXPECT_THAT(d.warnings, Contains(HasSubstr("taken as dark")));
  EXPECT_TRUE(d.curves.front().dark);
  EXPECT_THAT(Ids(d), IsEmpty());
}

TEST(DiagnoseTest, ACurveUnderLittleLightIsFittedAsOneUnderMuch) {
  for (const double irradiance : {5.0, 10.0, 15.0, 20.0, 40.0}) {
    Recipe recipe;
    recipe.irradiance_W_m2 = irradiance;
    recipe.noise_A = 2e-6 * irradiance;
    const Diagnosis d = DiagnoseOrFail(SyntheticCurve(recipe));
    EXPECT_THAT(Ids(d), IsEmpty()) << irradiance << ": " << d.verdict.sentence;
    EXPECT_LT(d.verdict.lack_of_fit.value, 5e-4) << irradiance;
    EXPECT_THAT(d.warnings, IsEmpty()) << irradiance;
    EXPECT_NEAR(d.gain.shifts[0].after, 0.008 * irradiance, 1e-4 * irradiance);
  }
}

// Curves down to 5 W/m2 count as lit, and every curve is fitted at its stated irradiance.
TEST(DiagnoseTest, ASeriesDownToLittleLightHasNothingToFind) {
  std::vector<IvCurve> curves;
  for (const double irradiance : {5.0, 10.0, 20.0, 50.0, 200.0, 1000.0}) {
    Recipe recipe;
    recipe.name = std::to_string(static_cast<int>(irradiance));
    recipe.irradiance_W_m2 = irradiance;
    recipe.noise_A = 2e-4;
    recipe.seed = 3 + static_cast<std::uint64_t>(irradiance);
    curves.push_back(SyntheticCurve(recipe));
  }
  const Diagnosis d = DiagnoseOrFail(SetOf(curves), Quick());
  EXPECT_THAT(Ids(d), IsEmpty()) << d.verdict.sentence;
  EXPECT_THAT(d.warnings, Not(Contains(HasSubstr("taken as"))));
  for (const DiagnosedCurve& curve : d.curves) EXPECT_FALSE(curve.dark) << curve.name;
  EXPECT_LT(d.verdict.lack_of_fit.value, 5e-4);
}

TEST(DiagnoseTest, ADarkCurveAloneIsEnough) {
  const Diagnosis d = DiagnoseOrFail(SyntheticDarkCurve());
  ExpectComplete(d);
  EXPECT_THAT(d.evidence.kind, HasSubstr("dark"));
  EXPECT_GT(d.evidence.noise_dark_A, 0);
}

TEST(DiagnoseTest, LightAndDarkAreOneMeasurement) {
  const Diagnosis d = DiagnoseOrFail(SetOf({SyntheticCurve({}), SyntheticDarkCurve()}));
  ExpectComplete(d);
  EXPECT_EQ(d.curves.size(), 2U);
  EXPECT_EQ(d.points.back().curve, 1);
  EXPECT_THAT(Ids(d), IsEmpty());
}

TEST(DiagnoseTest, ASecondDiodeInTheBaseIsNotACause) {
  DiagnoseOptions options = Quick();
  options.base = Model::kDoubleDiode;
  const Diagnosis d = DiagnoseOrFail(SyntheticCurve({}), options);
  ExpectComplete(d);
  EXPECT_EQ(d.base, "dd");
  EXPECT_THAT(d.base_sentence, HasSubstr("two diodes"));
  EXPECT_FALSE(d.trials.front().tried);
  EXPECT_EQ(d.trials.front().effect, "second_diode");
}

TEST(DiagnoseTest, OnlyTheEffectsAskedForAreTried) {
  DiagnoseOptions options = Quick();
  options.effects = {"drift", "second_diode"};
  const Diagnosis d = DiagnoseOrFail(CurveWithAStep(), options);
  for (const Trial& trial : d.trials) {
    const bool asked = trial.effect == "drift" || trial.effect == "second_diode";
    EXPECT_TRUE(asked || !trial.tried) << trial.effect;
    EXPECT_EQ(trial.why_not.find("not among the effects asked for") == std::string::npos, asked)
        << trial.effect << ": " << trial.why_not;
  }
  const std::vector<std::string> ids = Ids(d);
  EXPECT_THAT(ids, Not(Contains("irr_step")));
}

TEST(DiagnoseTest, EveryChoiceIsEchoed) {
  DiagnoseOptions options = Quick();
  options.base = Model::kDoubleDiode;
  options.effects = {"nonohmic_shunt", "drift"};
  std::map<std::string, std::string> echoed;
  for (const OptionEcho& echo : DiagnoseOrFail(SyntheticCurve({}), options).non_default_options) {
    echoed[echo.name] = echo.value;
  }
  EXPECT_EQ(echoed, (std::map<std::string, std::string>{
                        {"base", "dd"}, {"effects", "nonohmic_shunt,drift"}, {"held-out", "no"}}));
}

// The extended model of the report can be simulated when no cause was found: it then consists of
// its diodes.
TEST(DiagnoseTest, WithoutACauseTheExtendedModelIsItsDiodes) {
  DiagnoseOptions options = Quick();
  options.extend = true;
  for (const Model model : {Model::kSingleDiode, Model::kDoubleDiode}) {
    options.base = model;
    const IvCurve curve = SyntheticCurve({});
    const Diagnosis d = DiagnoseOrFail(curve, options);
    const FitReport& report = d.extended;
    ASSERT_THAT(Ids(d), IsEmpty());
    ASSERT_EQ(report.device.size(), static_cast<int>(report.refined.size()));
    const std::vector<double> current_A =
        SolveCurrents(report.device, report.refined.data(), curve.voltage_V);
    for (std::size_t k = 0; k < current_A.size(); ++k) {
      EXPECT_NEAR(current_A[k], report.model_current_A[k], 1e-9);
    }
  }
}

TEST(DiagnoseTest, TheModelIsExtendedAsAFit) {
  DiagnoseOptions options = Quick();
  options.extend = true;
  const Diagnosis d = DiagnoseOrFail(CurveWithAStep(), options);
  const FitReport& report = d.extended;
  ASSERT_EQ(report.estimates.size(), 7U);
  EXPECT_EQ(report.estimates[5].info.symbol, "irr_step.s");
  // The report holds a device with this law, which reproduces the currents of the report.
  ASSERT_NE(report.device.effects, nullptr);
  ASSERT_EQ(report.device.size(), 7);
  std::vector<double> current_A(d.points.size());
  ASSERT_TRUE(ExtendedCurrents(report.device, report.refined.data(), current_A.data(), nullptr));
  for (std::size_t k = 0; k < current_A.size(); ++k) {
    EXPECT_NEAR(current_A[k], report.model_current_A[k], 1e-9);
  }
  EXPECT_THAT(report.causes, testing::ElementsAre("irr_step"));
  EXPECT_EQ(report.residual_A.size(), d.points.size());
  EXPECT_GT(report.search.evaluations, 0);
  EXPECT_NEAR(report.rmse.refined.solved_current_A, d.gain.rmse_after_A, 1e-12);
  EXPECT_LE(report.rmse.refined.solved_current_A, report.rmse.random_baseline.solved_current_A);
}

TEST(DiagnoseTest, StopsWhenAskedTo) {
  const Observer observer = [](const Progress&) { return ObserverAction::kStop; };
  const auto d = Diagnose(SyntheticCurve({}), {}, observer);
  ASSERT_TRUE(d.has_value());
  EXPECT_TRUE(d->interrupted);
  EXPECT_EQ(d->gain.folds, 0);
}

}  // namespace
}  // namespace lyrefit
