#include "lyrefit/family/family_problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "family/family_fixture.h"
#include "family/synthetic_effects.h"
#include "lyrefit/family/fit_individually.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

class FamilyEffectsTest : public FamilyFixture {
 protected:
  FamilyEffectsTest() : FamilyFixture(/*points=*/40, /*noise_A=*/0) {}
  void Make(const std::vector<EffectUse>& uses, double noise_A = 1e-3) {
    AddSyntheticEffects(uses, law_, truth_, noise_A, &set_);
  }
};

const Estimate& Of(const FamilyReport& report, const std::string& symbol) {
  static const Estimate kNone;
  for (const Estimate& e : report.estimates) {
    if (e.info.symbol == symbol) return e;
  }
  ADD_FAILURE() << symbol;
  return kNone;
}

// Expects the estimate within 1.5 half widths of the 95 % interval from the truth, and the interval
// shorter than `width` times the truth.
void ExpectFound(const FamilyReport& report, const std::string& symbol, double truth,
                 double width = 0.3) {
  const Estimate& e = Of(report, symbol);
  EXPECT_LT(std::fabs(e.refined - truth), 0.75 * (e.high_95 - e.low_95)) << symbol << e.refined;
  EXPECT_LT(e.high_95 - e.low_95, width * truth) << symbol;
  EXPECT_TRUE(e.identifiable) << symbol;
  EXPECT_LE(e.low_95, e.refined);
  EXPECT_GE(e.high_95, e.refined);
}

TEST_F(FamilyEffectsTest, ADarkCurveMayBeNoisy) {
  set_.curves.push_back(DarkCurve(law_, truth_, 25, 40));
  IvCurve& dark = set_.curves.back();
  const double noise = 0.005 * std::fabs(dark.current_A.back());
  RandomStream random(3);
  for (std::size_t k = 0; k < dark.size(); ++k) {
    const bool at_0 = std::fabs(dark.voltage_V[k]) < 1;
    dark.current_A[k] += noise * (at_0 ? 1 : random.Normal());
  }
  options_.with = {UseOf("second_diode")};
  const FamilyReport report = Fit();
  EXPECT_EQ(report.curves.back().role, CurveRole::kFitted) << report.curves.back().reason;
}

// With two irradiances only, both laws of the photoshunt give identical curves, with different
// strengths.
TEST_F(FamilyEffectsTest, AnIntervalReachesOverEverySettingThatFitsAsWell) {
  TranslationSpec spec = law_.spec;
  spec.shunt = ShuntLaw::kConstant;
  options_.shunt = ShuntLaw::kConstant;
  law_ = *MakeTranslation(spec);
  truth_ = SyntheticTruth(law_);
  set_ = SyntheticSet(law_, truth_, {{1000, 25}, {600, 25}}, 40, 0);
  Make({UseOf("photoshunt", {{"Gph", {0.05, 0.05}}, {"law", {0, 0}}})}, 2e-3);
  Estimate held[2];
  for (const double law : {0.0, 1.0}) {
    options_.with = {UseOf("photoshunt", {{"law", {law, law}}})};
    held[static_cast<int>(law)] = Of(Fit(), "photoshunt.Gph");
  }
  ASSERT_GT(std::fabs(held[1].refined - held[0].refined), 0.002);
  options_.with = {UseOf("photoshunt")};
  const FamilyReport report = Fit();
  const Estimate& strength = Of(report, "photoshunt.Gph");
  EXPECT_NEAR(strength.low_95, std::min(held[0].low_95, held[1].low_95), 2e-3);
  EXPECT_NEAR(strength.high_95, std::max(held[0].high_95, held[1].high_95), 2e-3);
  EXPECT_EQ(Of(report, "photoshunt.law").low_95, 0);
  EXPECT_EQ(Of(report, "photoshunt.law").high_95, 1);
  EXPECT_FALSE(Of(report, "photoshunt.law").identifiable);
}

TEST_F(FamilyEffectsTest, ANonOhmicShuntIsFound) {
  Make({UseOf("nonohmic_shunt", {{"k", {0.15, 0.15}}, {"m", {2.5, 2.5}}})});
  options_.with = {UseOf("nonohmic_shunt")};
  options_.folds = 5;
  const FamilyReport report = Fit();
  ExpectFound(report, "nonohmic_shunt.k", 0.15);
  ExpectFound(report, "nonohmic_shunt.m", 2.5);
  ExpectFound(report, "n1", 1.2);
  ExpectFound(report, "Rs", 0.25);
  EXPECT_NEAR(report.rmse.refined.solved_current_A, 1e-3, 1e-4);
  EXPECT_TRUE(std::isnan(report.rmse.refined.measured_current_A));
  ASSERT_TRUE(report.held_out);
  EXPECT_LT(report.held_out->rmse.solved_current_A, 1.3e-3);
  ASSERT_EQ(report.jackknife.size(), report.estimates.size());
  const Interval& curves = report.jackknife[*report.translation.Find("nonohmic_shunt.k")];
  EXPECT_LT(curves.low_95, 0.15);
  EXPECT_GT(curves.high_95, 0.15);
  EXPECT_TRUE(report.usable);
  for (const FamilyCurve& curve : report.curves) {
    EXPECT_EQ(curve.residual_A.size(), 40U);
    EXPECT_LT(curve.rmse.solved_current_A, 1.5e-3);
  }
}

// The reported strength depends on the exponent, whose uncertainty must be included.
TEST_F(FamilyEffectsTest, StandardErrorsAreThoseOfWhatIsReported) {
  SKIP_IF_SANITIZED();
  options_.with = {UseOf("nonohmic_shunt")};
  constexpr int kSets = 16;
  double mean = 0, squares = 0, stated = 0;
  for (int s = 0; s < kSets; ++s) {
    AddSyntheticEffects({UseOf("nonohmic_shunt", {{"k", {0.15, 0.15}}, {"m", {2.5, 2.5}}})}, law_,
                        truth_, 1e-3, &set_, s);
    const FamilyReport report = Fit();
    const Estimate& k = Of(report, "nonohmic_shunt.k");
    mean += k.refined / kSets;
    squares += k.refined * k.refined / kSets;
    stated += k.standard_error / kSets;
  }
  const double found = std::sqrt((squares - mean * mean) * kSets / (kSets - 1));
  EXPECT_GT(stated, 0.7 * found);
  EXPECT_LT(stated, 1.5 * found);
}

TEST_F(FamilyEffectsTest, ASecondDiodeFollowsTheTemperature) {
  Make({UseOf("second_diode", {{"Is2", {2e-6, 2e-6}}})}, 3e-4);
  options_.with = {UseOf("second_diode")};
  ExpectFound(Fit(), "second_diode.Is2", 2e-6);
}

TEST_F(FamilyEffectsTest, AShadedModuleIsFoundWhereOneInsists) {
  SKIP_IF_SANITIZED();
  Make({UseOf("shading", {{"d", {0.3, 0.3}}, {"w", {1.0 / 3, 1.0 / 3}}, {"Vb", {0.5, 0.5}}})});
  options_.with = {UseOf("shading")};
  EXPECT_THAT(Error(), HasSubstr("shading: acts during one sweep; each curve of a set has its own "
                                 "(--force fits it all the same)"));
  options_.force_effects = true;
  const FamilyReport report = Fit();
  ExpectFound(report, "shading.d", 0.3);
  ExpectFound(report, "shading.w", 1.0 / 3);
  EXPECT_NEAR(report.rmse.refined.solved_current_A, 1e-3, 1e-4);
  // The bypassed one of three substrings delivers no voltage.
  EXPECT_LT(report.reference.max_power_W, 55);
}

TEST_F(FamilyEffectsTest, WholeSubstringsAreCountedAndNotMeasured) {
  SKIP_IF_SANITIZED();
  for (IvCurve& curve : set_.curves) curve.notes.bypass_diodes = 3;
  Make({UseOf("shading", {{"d", {0.3, 0.3}}, {"w", {2.0 / 3, 2.0 / 3}}, {"Vb", {0.5, 0.5}}})});
  options_.with = {UseOf("shading")};
  options_.force_effects = true;
  const FamilyReport report = Fit();
  EXPECT_DOUBLE_EQ(Of(report, "shading.w").refined, 2.0 / 3);
  ExpectFound(report, "shading.d", 0.3);
  EXPECT_NEAR(report.rmse.refined.solved_current_A, 1e-3, 1e-4);
}

TEST_F(FamilyEffectsTest, ADarkCurveTellsAPhotoshuntFromTheShunt) {
  TranslationSpec spec = law_.spec;
  spec.shunt = ShuntLaw::kConstant;
  law_ = *MakeTranslation(spec);
  set_ = SyntheticSet(law_, truth_, {{1000, 25}, {1000, 60}}, 40, 0);
  set_.curves.push_back(DarkCurve(law_, truth_, 25, 40));
  options_.shunt = ShuntLaw::kConstant;
  EXPECT_EQ(Fit().curves.back().role, CurveRole::kLeftOut);  // no effect needs it
  Make({UseOf("photoshunt", {{"Gph", {0.004, 0.004}}})}, 3e-4);
  options_.with = {UseOf("photoshunt", {{"law", {0, 0}}})};
  options_.weights = FamilyWeights::kIsc;
  const FamilyReport report = Fit();
  ExpectFound(report, "photoshunt.Gph", 0.004);
  ExpectFound(report, "Rsh", 200);
  EXPECT_TRUE(Of(report, "photoshunt.law").fixed);
  EXPECT_EQ(report.curves.back().role, CurveRole::kFitted);
  EXPECT_LT(report.curves.back().rmse.solved_current_A, 5e-4);
}

TEST_F(FamilyEffectsTest, AnEffectHeldAtNothingLeavesThePlainFit) {
  Make({UseOf("second_diode", {{"Is2", {0, 0}}})});
  const FamilyReport plain = Fit();
  options_.with = {UseOf("second_diode", {{"Is2", {0, 0}}})};
  const FamilyReport report = Fit();
  for (const Estimate& e : plain.estimates) {
    if (e.fixed) continue;
    const Estimate& same = Of(report, e.info.symbol);
    EXPECT_NEAR(same.refined, e.refined, 1e-4 * e.standard_error) << e.info.symbol;
    EXPECT_NEAR(same.standard_error, e.standard_error, 1e-3 * e.standard_error) << e.info.symbol;
  }
  const double rmse = plain.rmse.refined.solved_current_A;
  EXPECT_NEAR(report.rmse.refined.solved_current_A, rmse, 1e-10 * rmse);
  EXPECT_NEAR(report.reference.max_power_W, plain.reference.max_power_W, 1e-4);
  options_.with = {UseOf("second_diode")};
  const FamilyReport free = Fit();
  EXPECT_LE(free.rmse.refined.solved_current_A, rmse * (1 + 1e-9));
  EXPECT_LE(Of(free, "second_diode.Is2").low_95, 0);
}

TEST_F(FamilyEffectsTest, AreHeldAndBoundedAsAsked) {
  Make({UseOf("nonohmic_shunt", {{"k", {0.15, 0.15}}, {"m", {2.5, 2.5}}})});
  options_.with = {UseOf("nonohmic_shunt", {{"k", {0.01, 0.1}}, {"m", {2.5, 2.5}}})};
  const FamilyReport report = Fit();
  const Estimate& k = Of(report, "nonohmic_shunt.k");
  EXPECT_NEAR(k.refined, 0.1, 1e-9);
  EXPECT_NEAR(k.bounds.lower, 0.01, 1e-9);
  EXPECT_EQ(k.at_bound, BoundSide::kUpper);
  EXPECT_TRUE(Of(report, "nonohmic_shunt.m").fixed);
  EXPECT_NEAR(Of(report, "nonohmic_shunt.m").refined, 2.5, 1e-12);
}

TEST_F(FamilyEffectsTest, ASensorsOffsetIsOne) {
  options_.fixed["EgRef"] = truth_[law_.bandgap];
  Make({UseOf("temp_offset", {{"c", {4, 4}}})});
  options_.with = {UseOf("temp_offset")};
  ExpectFound(Fit(), "temp_offset.c", 4);
}

TEST_F(FamilyEffectsTest, GiveTheSameBitsOnAnyNumberOfThreads) {
  Make({UseOf("nonohmic_shunt", {{"k", {0.15, 0.15}}, {"m", {2.5, 2.5}}})});
  options_.with = {UseOf("nonohmic_shunt")};
  options_.threads = 1;
  const FamilyReport one = Fit();
  options_.threads = 3;
  const FamilyReport three = Fit();
  EXPECT_EQ(one.refined, three.refined);
  ASSERT_EQ(one.estimates.size(), three.estimates.size());
  for (std::size_t i = 0; i < one.estimates.size(); ++i) {
    if (one.estimates[i].fixed) continue;
    EXPECT_EQ(one.estimates[i].low_95, three.estimates[i].low_95);
  }
}

TEST_F(FamilyEffectsTest, SaysWhatDoesNotGoWithThem) {
  options_.with = {UseOf("nonohmic_shunt")};
  const struct {
    const char* said;
    void (*spoil)(FamilyOptions* options, CurveSet* set);
  } cases[] = {
      {"not beside pvsyst: expected the family desoto",
       [](FamilyOptions* o, CurveSet*) { o->law = TranslationLaw::kPvsyst; }},
      {"is fitted to the solved current",
       [](FamilyOptions* o, CurveSet*) { o->objective = Objective::kMeasuredCurrent; }},
      {"dEgdT is fixed beside effects", [](FamilyOptions* o, CurveSet*) { o->freed = {"dEgdT"}; }},
      {"expected the effect sensor_offset",
       [](FamilyOptions* o, CurveSet*) { o->irradiance_offset = true; }},
      {"expected the effect temp_offset",
       [](FamilyOptions* o, CurveSet*) { o->temperature_offset = true; }},
      {"temperature-accuracy: beside effects curves have no unknowns of their own",
       [](FamilyOptions* o, CurveSet*) { o->temperature_accuracy_K = 1; }},
      {"curve c3 states no irradiance",
       [](FamilyOptions*, CurveSet* s) { s->curves[2].irradiance_known = false; }},
      {"curve c2 states no cell temperature",
       [](FamilyOptions*, CurveSet* s) { s->curves[1].temperature_known = false; }},
      {"nonohmic_shunt: has no parameter 'q', expected k, m",
       [](FamilyOptions* o, CurveSet*) {
         o->with = {UseOf("nonohmic_shunt", {{"q", {1, 1}}})};
       }},
      {"nonohmic_shunt: m = 9 is outside 1.3 to 5",
       [](FamilyOptions* o, CurveSet*) {
         o->with = {UseOf("nonohmic_shunt", {{"m", {9, 9}}})};
       }},
      {"shares of 1.2 in all leave no cell for the rest",
       [](FamilyOptions* o, CurveSet*) {
         o->force_effects = true;
         o->with = {UseOf("substrings", {{"w1", {0.6, 0.6}}, {"w2", {0.6, 0.6}}})};
       }},
      {"photoshunt: needs a second level of light, or a dark curve",
       [](FamilyOptions* o, CurveSet* s) {
         o->with = {UseOf("photoshunt")};
         s->curves.resize(2);
       }},
  };
  const FamilyOptions options = options_;
  const CurveSet set = set_;
  for (const auto& c : cases) {
    options_ = options;
    set_ = set;
    c.spoil(&options_, &set_);
    EXPECT_THAT(Error(), HasSubstr(c.said));
  }
}

TEST_F(FamilyEffectsTest, AutoTriesTheLawsThatKnowThem) {
  Make({UseOf("nonohmic_shunt", {{"k", {0.15, 0.15}}, {"m", {2.5, 2.5}}})});
  options_.with = {UseOf("nonohmic_shunt")};
  const auto report = FitFamilyAuto(set_, options_);
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_EQ(report->candidates.size(), 2U);
  ExpectFound(*report, "nonohmic_shunt.k", 0.15);
  EXPECT_THAT(report->assumptions,
              ::testing::Contains(HasSubstr("pvsyst sd was not tried: with: effects stand")));
}

TEST_F(FamilyEffectsTest, EveryCurveOnItsOwnHasThemToo) {
  Make({UseOf("nonohmic_shunt", {{"k", {0.15, 0.15}}, {"m", {2.5, 2.5}}})}, 1e-4);
  options_.with = {UseOf("nonohmic_shunt", {{"m", {2.5, 2.5}}})};
  const auto report = FitIndividually(set_, options_);
  ASSERT_TRUE(report) << report.error().ToString();
  for (const FamilyCurve& curve : report->curves) {
    ASSERT_EQ(curve.individual_parameters.size(), 7U);
    EXPECT_NEAR(curve.individual_parameters[5], 0.15, 0.02) << curve.id;
    EXPECT_EQ(curve.individual_estimates[5].refined, curve.individual_parameters[5]);
    EXPECT_NEAR(curve.individual_rmse.solved_current_A, 1e-4, 3e-5);
  }
}

}  // namespace
}  // namespace lyrefit
