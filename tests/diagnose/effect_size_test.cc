#include "lyrefit/diagnose/effect_size.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "diagnose/synthetic_diagnosis.h"
#include "lyrefit/diagnose/describe.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/diagnose/law_coordinates.h"
#include "lyrefit/effects/odd_cells.h"
#include "repeats.h"
#include "synthetic_data.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(ExceedsFloors, WhereTheWholeIntervalIsAboveAFloor) {
  const Floors floors = {0.0025, 0.005};
  EffectSize size;
  size.reach = 0.1;
  size.current = 0.003;
  EXPECT_TRUE(ExceedsFloors(size, floors));
  size.reach = 0.2;
  EXPECT_FALSE(ExceedsFloors(size, floors));
  size.power = -0.02;
  EXPECT_TRUE(ExceedsFloors(size, floors));
  size.power_error = 0.016;
  EXPECT_FALSE(ExceedsFloors(size, floors));
  EXPECT_TRUE(ExceedsFloors({}, {}));  // without floors every size passes
}

TEST(ExceedsFloors, OfOneSweepOnlyWhereItShows) {
  const Floors floors = {0.0025, 0.005};
  EffectSize size;
  size.reach = 0.1;
  size.power = -0.1;
  size.current = 0.0005;
  EXPECT_TRUE(ExceedsFloors(size, floors));  // the effect was found under another irradiance
  size.one_sweep = true;
  EXPECT_FALSE(ExceedsFloors(size, floors));
  size.current = 0.0012;
  EXPECT_TRUE(ExceedsFloors(size, floors));
}

// The stated error of ln Pmax against the spread over seeds, for a single diode alone and with an
// irradiance step at the knee.
TEST(DevicePowerAndErrorTest, IsTheSpreadOfRepeatedFits) {
  constexpr int kSeeds = 100;
  for (const bool step : {false, true}) {
    double sum = 0, square = 0, stated = 0;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      Recipe recipe;
      recipe.seed = seed;
      recipe.points = 120;
      const SyntheticData made = OnTheData(SyntheticCurve(recipe));
      LawFit fit = FitBase(made.weighted, Law());
      if (step) {
        Law law = fit.law;
        law.effects = {FindEffect("irr_step")};
        std::vector<double> start = fit.p;
        for (const double value : {0.0, 0.2}) start.push_back(value);
        fit = FitLaw(made.weighted, law, start);
      }
      const auto [power_W, error] = DevicePowerAndError(made.weighted, fit);
      const double power = std::log(power_W);
      sum += power / kSeeds;
      square += power * power / kSeeds;
      stated += error / kSeeds;
    }
    EXPECT_NEAR(stated / std::sqrt(square - sum * sum), 1, 0.25) << step;
  }
}

// A 60-cell module with one effect applied exactly, and noise. `healthy_W`: its maximum power
// without the effect.
struct Done {
  IvCurve curve;
  double healthy_W = 0;
};

Done Do(const char* id, const std::vector<double>& values, double noise_A = 0.004) {
  Recipe recipe;
  recipe.cells = 60;
  recipe.noise_A = 0;
  recipe.points = 120;
  Done done;
  done.curve = SyntheticCurve(recipe);
  done.curve.notes.bypass_diodes = 3;
  const SyntheticData made = OnTheData(done.curve);
  LawFit fit = FitBase(made.weighted, StartingLaw(*made.weighted.readings, Model::kSingleDiode));
  done.healthy_W = DevicePower(made.weighted, fit);
  fit.law.effects = {FindEffect(id)};
  fit.p.insert(fit.p.end(), values.begin(), values.end());
  LawWorkspace workspace;
  EXPECT_TRUE(EvaluateLaw(fit.law, *made.weighted.readings, fit.p.data(), &workspace,
                          fit.current.data(), nullptr));
  RandomStream random(3);
  for (std::size_t k = 0; k < fit.current.size(); ++k) {
    done.curve.current_A[k] =
        fit.current[k] * made.weighted.readings->scale.current_A + noise_A * random.Normal();
  }
  return done;
}

Diagnosis DiagnosedInTheField(const IvCurve& curve) {
  DiagnoseOptions options;
  options.held_out = false;
  auto diagnosis = Diagnose(curve, options);
  EXPECT_TRUE(diagnosis.has_value());
  return diagnosis ? *diagnosis : Diagnosis();
}

// A fit of a shaded module, from the true parameters; another noise for each seed.
struct ShadedFit {
  SyntheticData made;
  LawFit fit;
  double gain_W = 0;  // true
};

ShadedFit FitShaded(std::uint64_t seed) {
  const std::vector<double> shade = {0.2, 1.0 / 3, 0.5, 1};
  const Done done = Do("shading", shade, 0);
  IvCurve curve = done.curve;
  RandomStream random(seed);
  for (double& current : curve.current_A) current += 0.004 * random.Normal();
  ShadedFit shaded{OnTheData(curve), {}, 0};
  const SyntheticData exact = OnTheData(done.curve);
  const auto fit = [&shade](const SyntheticData& made) {
    Law law = StartingLaw(*made.weighted.readings, Model::kSingleDiode);
    std::vector<double> start = TypicalStart(*made.weighted.readings, law, 1);
    law.effects = {FindEffect("shading")};
    start.insert(start.end(), shade.begin(), shade.end());
    return FitLaw(made.weighted, law, start);
  };
  shaded.fit = fit(shaded.made);
  shaded.gain_W = done.healthy_W - DevicePower(exact.weighted, fit(exact));
  return shaded;
}

TEST(GainWithoutTest, ItsIntervalIsTheSpreadOfRepeatedFits) {
  constexpr int kSeeds = 60;
  double sum = 0, square = 0, stated = 0, truth = 0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const ShadedFit shaded = FitShaded(seed);
    ASSERT_TRUE(shaded.fit.usable);
    const PowerGain gain = GainWithout(shaded.made.weighted, shaded.fit, 0);
    EXPECT_EQ(gain.power_W, GainWithoutEffects(shaded.made.weighted, shaded.fit).power_W);
    sum += gain.power_W / kSeeds;
    square += gain.power_W * gain.power_W / kSeeds;
    stated += gain.half_W / kNormal95 / kSeeds;
    truth = shaded.gain_W;
  }
  const double spread = std::sqrt(square - sum * sum);
  EXPECT_NEAR(sum, truth, 3 * spread / std::sqrt(kSeeds) + 0.002 * truth);
  EXPECT_NEAR(stated / spread, 1, 0.35);
}

TEST(GainWithoutTest, ARoughPathWidensIt) {
  ShadedFit shaded = FitShaded(1);
  const PowerGain white = GainWithout(shaded.made.weighted, shaded.fit, 0);
  shaded.made.weighted.path = 1e-3;
  const PowerGain rough = GainWithout(shaded.made.weighted, shaded.fit, 0);
  EXPECT_EQ(rough.power_W, white.power_W);
  EXPECT_GT(rough.half_W,
            white.half_W + kNormal95 * 0.9e-3 * DevicePower(shaded.made.weighted, shaded.fit));
}

// Where n is no junction's, the brightest cells of the model are darker than the device's.
TEST(DescribeRecoverableTest, IsALowerLimitWhereTheModelIsIncomplete) {
  const ShadedFit shaded = FitShaded(1);
  Selection selection;
  selection.weighted = shaded.made.weighted;
  selection.extended = shaded.fit;
  Verdict verdict;
  verdict.causes.resize(2);
  verdict.causes[0].recoverable_power_W = {10, 9, 11};
  DescribeRecoverable(selection, &verdict);
  EXPECT_FALSE(verdict.causes[0].at_least);
  EXPECT_NEAR(verdict.recoverable_power_W.value, shaded.gain_W, 0.02 * shaded.gain_W);
  selection.extended.p[IdealityIndex(0)] = 0.5;
  DescribeRecoverable(selection, &verdict);
  EXPECT_TRUE(verdict.causes[0].at_least);
  EXPECT_FALSE(verdict.causes[1].at_least);  // a cause without power
  EXPECT_TRUE(std::isnan(verdict.causes[0].recoverable_power_W.value));
  EXPECT_EQ(verdict.causes[0].recoverable_power_W.low_95, 9);
  EXPECT_TRUE(std::isnan(verdict.recoverable_power_W.value));
  Verdict of_sweeps;
  of_sweeps.causes.resize(1);
  DescribeRecoverable(selection, &of_sweeps);
  EXPECT_TRUE(std::isnan(of_sweeps.recoverable_power_W.low_95));
}

// Of an effect that one curve shows in part only.
TEST(DescribeRecoverableTest, IsALowerLimitWhereTheEffectHidesAPart) {
  const ShadedFit shaded = FitShaded(1);
  Selection selection;
  selection.weighted = shaded.made.weighted;
  selection.extended = shaded.fit;
  Effect hiding = *FindEffect("shading");
  hiding.hides = [](const double* p, const DataTraits&) { return p[0] > 0; };
  selection.extended.law.effects = {&hiding};
  Verdict verdict;
  verdict.causes.resize(1);
  verdict.causes[0].effect = "shading";
  verdict.causes[0].recoverable_power_W = {10, 9, 11};
  DescribeRecoverable(selection, &verdict);
  EXPECT_TRUE(verdict.causes[0].at_least);
  EXPECT_TRUE(std::isnan(verdict.causes[0].recoverable_power_W.high_95));
  EXPECT_TRUE(std::isnan(verdict.recoverable_power_W.value));
  EXPECT_GT(verdict.recoverable_power_W.low_95, 0);
}

TEST(FieldDiagnosis, TheGainOfAStringIsLessCertain) {
  double half[2] = {};
  for (const int substrings : {3, 60}) {
    ShadedFit shaded = FitShaded(1);
    Readings readings = *shaded.made.weighted.readings;
    readings.traits.substrings = substrings;
    readings.traits.bypass_known = true;
    shaded.made.weighted.readings = std::make_shared<const Readings>(readings);
    shaded.made.weighted.path = 1e-3;
    half[substrings > 3] = GainWithout(shaded.made.weighted, shaded.fit, 0).half_W;
  }
  EXPECT_GT(half[1], 1.1 * half[0]);
  EXPECT_GT(half[0], 0);
}

TEST(ProbabilityAboveTest, APowerOfOneSweepCountsWhereTheEffectShows) {
  const Floors floors = {0.0025, 0.005};
  EffectSize size;
  size.current = 0.0002;
  size.reach = 1;
  size.power = 0.02;
  size.power_error = 0.005;
  EXPECT_GT(ProbabilityAbove(size, floors), 0.99);
  size.one_sweep = true;
  EXPECT_LT(ProbabilityAbove(size, floors), 0.01);
  size.current = 0.002;
  size.reach = 0.1;
  EXPECT_GT(ProbabilityAbove(size, floors), 0.99);
}

// A law that describes the forward current beyond Voc alone has no power.
TEST(ProbabilityAboveTest, APowerThatIsNotFiniteDoesNotCount) {
  const Floors floors = {0.0025, 0.005};
  EffectSize size;
  size.current = 0.01;
  size.reach = 0.1;
  for (const double power : {kUnknown, kInfinity}) {
    size.power = size.power_error = power;
    EXPECT_GT(ProbabilityAbove(size, floors), 0.99);
  }
  size.current = 0.0001;
  for (const double power : {kUnknown, kInfinity}) {
    size.power = size.power_error = power;
    EXPECT_LT(ProbabilityAbove(size, floors), 0.01);
  }
}

// Two thirds of the module give nothing: the curve ends at a third of the voltage that the repaired
// module has.
TEST(FieldDiagnosis, FindsOpenSubstringsAndTheirWatts) {
  SKIP_IF_SANITIZED();
  for (const double share : {1.0 / 3, 2.0 / 3}) {
    Done done = Do("open_substring", {share, 0.3, 1.3});
    for (std::size_t k = done.curve.size(); k-- > 0;) {
      if (done.curve.current_A[k] > -0.5) continue;
      done.curve.voltage_V.erase(done.curve.voltage_V.begin() + static_cast<std::ptrdiff_t>(k));
      done.curve.current_A.erase(done.curve.current_A.begin() + static_cast<std::ptrdiff_t>(k));
    }
    const Diagnosis d = DiagnosedInTheField(done.curve);
    ASSERT_FALSE(d.verdict.causes.empty());
    const Cause& cause = d.verdict.causes.front();
    EXPECT_EQ(cause.id, "open_substring");
    EXPECT_NEAR(cause.strength[0].value, share, 1e-6);
    double measured_W = 0;
    for (std::size_t k = 0; k < done.curve.size(); ++k) {
      measured_W = std::max(measured_W, done.curve.voltage_V[k] * done.curve.current_A[k]);
    }
    EXPECT_NEAR(cause.recoverable_power_W.value, done.healthy_W - measured_W,
                0.05 * done.healthy_W);
  }
}

// Light that grows fastest in the middle of a sweep up and down is no hysteresis of a module.
TEST(FieldDiagnosis, FindsUnsteadyDriftInASweepUpAndDown) {
  SKIP_IF_SANITIZED();
  const IvCurve up = Do("drift", {0, 0, 0}, 0).curve;
  IvCurve curve = up;
  curve.voltage_V.insert(curve.voltage_V.end(), up.voltage_V.rbegin(), up.voltage_V.rend());
  curve.current_A.insert(curve.current_A.end(), up.current_A.rbegin(), up.current_A.rend());
  const double largest = *std::max_element(up.current_A.begin(), up.current_A.end());
  const double last = static_cast<double>(curve.size()) - 1;
  RandomStream random(5);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double x = static_cast<double>(k) / last - 0.5;
    curve.sweep.push_back(k < up.size() ? 0 : 1);
    curve.current_A[k] += largest * 0.03 * x * (1 - 2.5 * x * x) + 0.004 * random.Normal();
  }
  const Diagnosis d = DiagnosedInTheField(curve);
  ASSERT_FALSE(d.verdict.causes.empty());
  EXPECT_EQ(d.verdict.causes.front().id, "drift");
}

// A barrier at a contact with a leak of its own bends the curve into an S.
TEST(LaboratoryDiagnosis, FindsTheBarrierOfAnSShape) {
  SKIP_IF_SANITIZED();
  const Done done = Do("back_contact", {20, 2, 0.3});
  const Diagnosis d = DiagnoseOrFail(done.curve, Quick(LaboratoryOptions()));
  ASSERT_FALSE(d.verdict.causes.empty());
  EXPECT_EQ(d.verdict.causes.front().id, "back_contact");
}

TEST(FieldDiagnosis, SaysTheLightOfASubstringAndThePowerToWin) {
  SKIP_IF_SANITIZED();
  const Done done = Do("shading", {0.2, 1.0 / 3, 0.5, 1});
  const Diagnosis d = DiagnosedInTheField(done.curve);
  ASSERT_FALSE(d.verdict.causes.empty());
  const Cause& cause = d.verdict.causes.front();
  EXPECT_EQ(cause.id, "shading");
  ASSERT_EQ(cause.in_words.size(), 1U);
  EXPECT_THAT(cause.in_words[0], HasSubstr("1 of 3 substrings under 80 % (7"));
  EXPECT_THAT(cause.in_words[0], HasSubstr(") of the others' light"));
  EXPECT_THAT(cause.sentence, Not(HasSubstr("=")));  // no parameters
  EXPECT_EQ(cause.action, std::string(FindEffect("shading")->action));
  EXPECT_EQ(d.verdict.sentence, "The data show partial shading (100 %).");
  EXPECT_THAT(d.verdict.comparison, HasSubstr("healthy modules 0.05 to 0.20 %"));
  const double measured_W = [&] {
    double most = 0;
    for (std::size_t k = 0; k < done.curve.size(); ++k) {
      most = std::max(most, done.curve.voltage_V[k] * done.curve.current_A[k]);
    }
    return most;
  }();
  const Sized& recoverable = cause.recoverable_power_W;
  EXPECT_NEAR(recoverable.value, done.healthy_W - measured_W, 0.02 * done.healthy_W);
  EXPECT_LT(recoverable.low_95, done.healthy_W - measured_W);
  EXPECT_GT(recoverable.high_95, done.healthy_W - measured_W);
  // Narrower intervals hold the truth in four of five modules built cell by cell only.
  EXPECT_LT(recoverable.high_95 - recoverable.low_95, 0.03 * done.healthy_W);
  EXPECT_FALSE(cause.at_least);
  EXPECT_EQ(d.verdict.recoverable_power_W.value, recoverable.value);  // of the only cause
  EXPECT_GT(cause.current_effect.low_95, 0.01);
  // The interval covers the usual scatter between sorted cells, 1 %.
  EXPECT_GT(cause.strength[0].high_95 - cause.strength[0].low_95, 0.01);
  EXPECT_GT(d.evidence.noise_path_A, 0);
}

// A misfit that no cause explains must not be reported as the state of a healthy module.
TEST(FieldDiagnosis, WhatNoCauseExplainsIsNotSaidToBeReference) {
  IvCurve curve = CurveWithAStep();
  DiagnoseOptions options = Quick();
  options.effects = {"collection"};
  const Diagnosis d = DiagnoseOrFail(curve, options);
  ASSERT_GT(d.verdict.lack_of_fit.value, 0.0025);
  EXPECT_THAT(d.verdict.causes, IsEmpty());
  EXPECT_FALSE(d.verdict.found);
  EXPECT_TRUE(d.verdict.unexplained);
  EXPECT_THAT(d.verdict.sentence, Not(HasSubstr("Nothing to act on")));
  EXPECT_THAT(d.verdict.sentence, Not(HasSubstr("as healthy modules do")));
  EXPECT_THAT(d.verdict.sentence, HasSubstr("The base model misses the data by"));
  EXPECT_THAT(d.verdict.sentence, HasSubstr("no cause of the catalogue explains it"));
  EXPECT_THAT(d.verdict.sentence, HasSubstr("To tell: repeat the measurement"));
}

TEST(FieldDiagnosis, WhatIsTooSmallToActOnStandsApart) {
  const Diagnosis d = DiagnosedInTheField(Do("shading", {0.007, 1.0 / 3, 0.5, 1}, 4e-4).curve);
  EXPECT_THAT(d.verdict.causes, IsEmpty());
  EXPECT_FALSE(d.verdict.found);
  ASSERT_THAT(d.verdict.below_floor, Not(IsEmpty()));
  EXPECT_LT(d.verdict.below_floor.front().current_effect.value, 0.005);
  EXPECT_THAT(d.verdict.sentence, HasSubstr("Nothing to act on"));
  EXPECT_THAT(d.verdict.sentence, HasSubstr("present, but not certainly above"));
  EXPECT_THAT(d.verdict.sentence, HasSubstr("One sweep cannot show dirt or slight ageing"));
}

TEST(FieldDiagnosis, SaysHowHotAWeakCellIs) {
  SKIP_IF_SANITIZED();
  // Soft reverse characteristic: the cell carries its missing photocurrent, 0.6 of Isc, at the
  // voltage -A (0.6)^(1 / m).
  const std::vector<double> weak = {0.6, 1, 0, 0.5, 0.1, 15, 3.4, 3.2, 1};
  const Done done = Do("weak_cell", weak);
  const SyntheticData made = OnTheData(done.curve);
  LawFit fit = FitBase(made.weighted, StartingLaw(*made.weighted.readings, Model::kSingleDiode));
  fit.law.effects = {FindEffect("weak_cell")};
  fit.p = LawCoordinates(fit.law, *made.weighted.readings).Parameters({1, 0, 1.2, 0.015, 1e-3});
  fit.p.insert(fit.p.end(), weak.begin(), weak.end());
  const HotCell hot = FindHotCell(
      {*made.weighted.readings, fit.law, fit.p, 0, fit.p.data() + fit.law.Offset(0), {}});
  EXPECT_NEAR(hot.voltage_V, -3.2 * std::pow(0.6, 1 / 3.4), 0.15);
  EXPECT_NEAR(hot.heat_W, -hot.voltage_V * 8, 1.5);
  const Diagnosis d = DiagnosedInTheField(done.curve);
  ASSERT_FALSE(d.verdict.causes.empty());
  EXPECT_EQ(d.verdict.causes.front().id, "weak_cell");
  EXPECT_THAT(d.verdict.causes.front().in_words.front(),
              HasSubstr("one cell has 40 % (39 to 41) of the others' light"));
}

TEST(FieldDiagnosis, SaysThatAGroupMayBeShorted) {
  Recipe recipe;
  recipe.cells = 40;
  recipe.points = 120;
  IvCurve curve = SyntheticCurve(recipe);
  curve.conditions.cells_in_series = 60;
  curve.notes.bypass_diodes = 3;
  const Diagnosis d = DiagnosedInTheField(curve);
  ASSERT_EQ(d.verdict.causes.size(), 1U);
  const Cause& cause = d.verdict.causes.front();
  EXPECT_EQ(cause.id, "bypass_short");
  EXPECT_THAT(cause.sentence, HasSubstr("a group of cells is shorted, or the number of cells"));
  EXPECT_EQ(cause.equivalents, std::vector<std::string>{"temperature_or_cells"});
  // With two groups, a shorted group would be half of the cells, which leaves no plausible n.
  curve.notes.bypass_diodes = 2;
  const Diagnosis other = DiagnosedInTheField(curve);
  ASSERT_EQ(other.verdict.causes.size(), 1U);
  EXPECT_EQ(other.verdict.causes.front().id, "temperature_or_cells");
}

TEST(FieldDiagnosis, FindsAWeakCellInOneHalfOfAHalfCutModule) {
  SKIP_IF_SANITIZED();
  // The terminals see a third of the substring's photocurrent missing. The weak cell, in one of two
  // parallel chains, lacks two thirds of its own.
  const Done done = Do("weak_cell", {0.33, 1, 0, 0.5, 0.1, 15, 3.4, 3.2, 2});
  const Diagnosis d = DiagnosedInTheField(done.curve);
  ASSERT_FALSE(d.verdict.causes.empty());
  EXPECT_EQ(d.verdict.causes.front().id, "weak_cell");
  EXPECT_NEAR(d.verdict.causes.front().strength.front().value, 0.33, 0.01);
  EXPECT_THAT(d.verdict.causes.front().in_words.front(), HasSubstr("one cell has 34 %"));
}

}  // namespace
}  // namespace lyrefit
