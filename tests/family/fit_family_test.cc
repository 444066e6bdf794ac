#include "lyrefit/family/fit_family.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "family/family_fixture.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

class FitFamilyTest : public FamilyFixture {
 protected:
  FitFamilyTest() : FamilyFixture(/*points=*/30, /*noise_A=*/1e-3) {}
  const Estimate& Of(const FamilyReport& report, const std::string& name) const {
    return report.estimates[*report.translation.Find(name)];
  }
};

// Expects |value - truth| within `factor` half widths of the 95 % interval.
void ExpectHolds(const Interval& interval, double truth, double factor = 1.5) {
  EXPECT_LT(std::fabs(interval.value - truth), factor * 0.5 * (interval.high_95 - interval.low_95))
      << interval.value << " " << truth;
}

struct Law {
  TranslationLaw law;
  Model model;
  bool recombination;
};

class EveryFamily : public testing::TestWithParam<Law> {};

TEST_P(EveryFamily, IsRecoveredWithinItsIntervals) {
  const Translation law = SyntheticLaw(GetParam().law, GetParam().model, GetParam().recombination);
  const std::vector<double> truth = SyntheticTruth(law);
  const CurveSet set = SyntheticSet(law, truth, kSixPlaces, 40, 2e-4, 5);
  FamilyOptions options = Quick();
  options.law = GetParam().law;
  options.model = GetParam().model;
  options.recombination = GetParam().recombination;
  const Expected<FamilyReport> report = FitFamily(set, options);
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_TRUE(report->usable);
  EXPECT_EQ(report->refine.termination, "converged");
  EXPECT_LT(report->refine.projected_gradient, 1e-6);
  EXPECT_NEAR(report->noise_A, 2e-4, 3e-5);
  for (int i = 0; i < law.size(); ++i) {
    const Estimate& e = report->estimates[i];
    SCOPED_TRACE(e.info.name);
    if (e.fixed) {
      EXPECT_NEAR(e.refined, truth[i], 1e-12 * std::fabs(truth[i]));
      continue;
    }
    EXPECT_TRUE(e.identifiable) << e.reason;
    EXPECT_NE(e.interval, IntervalMethod::kNone);
    EXPECT_LT(e.low_95 - 0.5 * (e.high_95 - e.low_95), truth[i]);
    EXPECT_GT(e.high_95 + 0.5 * (e.high_95 - e.low_95), truth[i]);
  }
  ASSERT_EQ(report->coefficients.size(), 3U);
  EXPECT_NEAR(report->coefficients[0].value.value, 2e-3, 1e-4);
  EXPECT_LT(report->coefficients[1].value.high_95, 0);
  EXPECT_EQ(report->jackknife.size(), static_cast<std::size_t>(law.size()));
}

INSTANTIATE_TEST_SUITE_P(FitFamily, EveryFamily,
                         testing::Values(Law{TranslationLaw::kDeSoto, Model::kSingleDiode, false},
                                         Law{TranslationLaw::kDeSoto, Model::kDoubleDiode, false},
                                         Law{TranslationLaw::kPvsyst, Model::kSingleDiode, false},
                                         Law{TranslationLaw::kPvsyst, Model::kSingleDiode, true}),
                         [](const testing::TestParamInfo<Law>& test) {
                           return ToText(test.param.law) + "_" + ToText(test.param.model) +
                                  (test.param.recombination ? "_recombination" : "");
                         });

TEST_F(FitFamilyTest, FindsTheConditionsThatNobodyStated) {
  set_.curves[3].irradiance_known = false;
  set_.curves[3].conditions.irradiance_W_m2 = 1000;
  set_.curves[5].temperature_known = false;
  set_.curves[5].conditions.cell_temperature_K = 298.15;
  const FamilyReport report = Fit();
  const FamilyCurve& dim = report.curves[3];
  Interval irradiance = dim.irradiance_offset_W_m2;
  ExpectHolds(irradiance, 400 - dim.irradiance_W_m2);
  EXPECT_LT(irradiance.high_95 - irradiance.low_95, 2);
  const FamilyCurve& cold = report.curves[5];
  ExpectHolds(cold.temperature_offset_K, 10 - cold.temperature_C);
  EXPECT_LT(cold.temperature_offset_K.standard_error, 0.5);
  EXPECT_TRUE(std::isnan(report.curves[0].irradiance_offset_W_m2.value));
}

TEST_F(FitFamilyTest, FindsAllIrradiancesRelativeToTheBrightest) {
  set_ = SyntheticSet(law_, truth_, {{1000, 25}, {700, 25}, {600, 45}, {400, 20}, {200, 35}}, 30,
                      1e-3);
  for (IvCurve& curve : set_.curves) curve.irradiance_known = false;
  const FamilyReport report = Fit();
  for (const int c : {1, 2, 3, 4}) {
    const FamilyCurve& row = report.curves[c];
    const double truth = std::vector<double>{1000, 700, 600, 400, 200}[c];
    ExpectHolds(row.irradiance_offset_W_m2, truth - row.irradiance_W_m2);
  }
  EXPECT_NEAR(Of(report, "n").refined, 1.2, 0.02);
  EXPECT_THAT(report.assumptions, testing::Contains(HasSubstr("brightest")));
}

TEST_F(FitFamilyTest, FindsTheErrorsThatAllReadingsShare) {
  for (IvCurve& curve : set_.curves) {
    curve.conditions.irradiance_W_m2 += 20;
    curve.conditions.cell_temperature_K -= 3;
  }
  options_.irradiance_offset = options_.temperature_offset = true;
  const FamilyReport report = Fit();
  ExpectHolds(report.irradiance_offset_W_m2, -20);
  ExpectHolds(report.temperature_offset_K, 3);
  EXPECT_LT(report.irradiance_offset_W_m2.standard_error, 2);
  EXPECT_LT(report.temperature_offset_K.standard_error, 1);
  EXPECT_TRUE(Of(report, "EgRef").fixed);
}

TEST_F(FitFamilyTest, RefusesSensorErrorsThatTheConditionsCannotShow) {
  options_.irradiance_offset = true;
  set_ = SyntheticSet(law_, truth_, {{1000, 25}, {900, 45}}, 20, 1e-3);
  EXPECT_THAT(Error(), HasSubstr("irradiance-offset: curves under one irradiance"));
  options_.irradiance_offset = false;
  options_.temperature_offset = true;
  set_ = SyntheticSet(law_, truth_, {{1000, 25}, {500, 26}}, 20, 1e-3);
  EXPECT_THAT(Error(), HasSubstr("temperature-offset: curves at one temperature"));
}

TEST_F(FitFamilyTest, WeighsReadingsByTheirAccuracy) {
  const std::vector<SyntheticAt> places = ManyPlaces(12);
  int held = 0, asked = 0;
  for (int seed = 1; seed <= 4; ++seed) {
    set_ = SyntheticSet(law_, truth_, places, 15, 1e-3, seed);
    RandomStream random(77, seed);
    std::vector<double> error;
    for (IvCurve& curve : set_.curves) {
      const double true_W_m2 = curve.conditions.irradiance_W_m2;
      curve.conditions.irradiance_W_m2 = true_W_m2 / (1 + 0.02 * random.Normal());
      error.push_back(true_W_m2 - curve.conditions.irradiance_W_m2);
    }
    options_.irradiance_accuracy = 0.02;
    const FamilyReport report = Fit();
    EXPECT_NEAR(report.noise_A, 1e-3, 3e-4);
    for (std::size_t c = 0; c < places.size(); ++c) {
      const Interval& offset = report.curves[c].irradiance_offset_W_m2;
      EXPECT_NEAR(offset.value, error[c], 0.025 * places[c].irradiance_W_m2) << c;
    }
    for (const char* name : {"I_L_ref", "I_o_ref", "n", "R_s", "R_sh_ref", "alpha_sc", "EgRef"}) {
      const Estimate& e = Of(report, name);
      ++asked;
      held += e.low_95 <= truth_[*law_.Find(name)] && truth_[*law_.Find(name)] <= e.high_95;
    }
  }
  EXPECT_GE(held, asked - 4) << asked;
}

TEST_F(FitFamilyTest, MarksOnlyWhatTheDataDoNotShow) {
  set_ = SyntheticSet(law_, truth_, {{1000, 25}, {500, 25}, {200, 25}}, 30, 1e-3);
  const FamilyReport held = Fit();
  EXPECT_TRUE(Of(held, "alpha_sc").fixed);
  EXPECT_THAT(held.assumptions, testing::Contains(HasSubstr("alpha_sc is fixed at")));
  options_.freed = {"alpha_sc"};
  for (const bool intervals : {true, false}) {
    options_.intervals = intervals;
    const FamilyReport report = Fit();
    EXPECT_THAT(report.assumptions, testing::Not(testing::Contains(HasSubstr("alpha_sc"))));
    for (const Estimate& e : report.estimates) {
      const bool unseen = !e.fixed && e.info.name == "alpha_sc";
      EXPECT_EQ(e.identifiable, !unseen) << e.info.name;
    }
    if (!intervals) continue;
    EXPECT_TRUE(std::isnan(report.coefficients[0].value.standard_error));
    EXPECT_FALSE(std::isnan(Of(report, "n").low_95));
  }
}

TEST_F(FitFamilyTest, KnowsCoefficientsWhoseParametersTradePlaces) {
  // EgRef and dEgdT act as one parameter; the temperature coefficients of the device are determined
  // nevertheless.
  const FamilyReport plain = Fit();
  options_.freed = {"dEgdT"};
  const FamilyReport report = Fit();
  for (const char* name : {"EgRef", "dEgdT"}) EXPECT_FALSE(Of(report, name).identifiable) << name;
  EXPECT_TRUE(Of(report, "I_o_ref").identifiable);
  for (const int k : {0, 1, 2}) {
    const Interval& one = plain.coefficients[k].value;
    const Interval& other = report.coefficients[k].value;
    EXPECT_NEAR(one.value, other.value, 0.01 * one.standard_error + 1e-6 * std::fabs(one.value));
    EXPECT_NEAR(one.standard_error / other.standard_error, 1, 0.02) << k;
  }
}

TEST_F(FitFamilyTest, SaysThatOneIrradianceShowsNoDarkShunt) {
  const Translation law = SyntheticLaw(TranslationLaw::kPvsyst);
  set_ = SyntheticSet(law, SyntheticTruth(law), {{1000, 25}, {1000, 45}, {1000, 65}}, 20, 1e-3);
  options_.law = TranslationLaw::kPvsyst;
  const FamilyReport report = Fit();
  for (const Estimate& e : report.estimates) {
    EXPECT_EQ(e.identifiable, e.info.name != "R_sh_0") << e.info.name << e.reason;
  }
  EXPECT_THAT(Of(report, "R_sh_0").reason, HasSubstr("do not fix it"));
}

TEST_F(FitFamilyTest, HoldsCoefficientsWhereNobodyStatedATemperature) {
  for (IvCurve& curve : set_.curves) curve.temperature_known = false;
  const FamilyReport report = Fit();
  EXPECT_TRUE(Of(report, "alpha_sc").fixed);
  EXPECT_TRUE(Of(report, "EgRef").fixed);
  for (const FamilyCurve& row : report.curves) EXPECT_NEAR(row.temperature_C, 25, 1e-9);
}

TEST_F(FitFamilyTest, BearsCurvesWithoutNoise) {
  set_ = SyntheticSet(law_, truth_, kSixPlaces, 20, 0);
  options_.individual_fits = true;
  const FamilyReport report = Fit();
  EXPECT_NEAR(Of(report, "n").refined, 1.2, 1e-9);
  for (const Coefficient& c : report.coefficients) EXPECT_FALSE(std::isnan(c.value.high_95));
  EXPECT_THAT(report.warnings, testing::IsEmpty());
  EXPECT_FALSE(report.without_outliers.has_value());
}

TEST_F(FitFamilyTest, TakesOrdinarySensorErrorsForNoOtherDevice) {
  options_.intervals = false;
  for (int seed = 1; seed <= 10; ++seed) {
    set_ = SyntheticSet(law_, truth_, ManyPlaces(12), 15, 2e-3, seed);
    RandomStream random(8, seed);
    for (IvCurve& curve : set_.curves) {
      curve.conditions.irradiance_W_m2 *= 1 + 0.008 * random.Normal();
    }
    EXPECT_FALSE(Fit().without_outliers.has_value()) << seed;
  }
}

TEST_F(FitFamilyTest, GivesEveryCurveARowAndAReason) {
  set_ = SyntheticSet(law_, truth_, ManyPlaces(10), 15, 1e-3);
  set_.curves[0].conditions.cells_in_series = 72;
  set_.curves[1].conditions.irradiance_W_m2 = 0;
  options_.leave_out = {"c3"};
  options_.fit_curves = 4;
  options_.individual_fits = true;
  const FamilyReport report = Fit();
  ASSERT_EQ(report.curves.size(), 10U);
  int fitted = 0, held = 0;
  for (std::size_t c = 0; c < 10; ++c) {
    const FamilyCurve& row = report.curves[c];
    EXPECT_EQ(row.id, set_.curves[c].name);
    fitted += row.role == CurveRole::kFitted;
    held += row.role == CurveRole::kHeldOut;
    EXPECT_EQ(row.role == CurveRole::kLeftOut, c < 3);
    EXPECT_EQ(row.reason.empty(), c >= 3);
    EXPECT_EQ(row.residual_A.size(), c < 3 ? 0U : 15U);
    if (c < 3) continue;
    EXPECT_LT(row.rmse.solved_current_A, 3e-3);
  }
  EXPECT_EQ(fitted, 4);
  EXPECT_EQ(held, 3);
  ASSERT_TRUE(report.held_out.has_value());
  EXPECT_EQ(report.held_out->curves, 3);
  EXPECT_NEAR(report.held_out->rmse.solved_current_A, 1e-3, 4e-4);
  EXPECT_GT(report.held_out->median_individual_rmse_A, 0);
  EXPECT_EQ(std::count_if(report.warnings.begin(), report.warnings.end(),
                          [](const std::string& text) {
                            return text.find("is left out") != std::string::npos;
                          }),
            2);
}

TEST_F(FitFamilyTest, TestsByFolds) {
  options_.folds = 3;
  const FamilyReport report = Fit();
  ASSERT_TRUE(report.held_out.has_value());
  EXPECT_EQ(report.held_out->curves, 6);
  EXPECT_EQ(report.held_out->how, "3 folds of whole curves");
  EXPECT_LT(report.held_out->rmse.solved_current_A, 3e-3);
}

TEST_F(FitFamilyTest, RefusesWhatMakesNoSense) {
  const auto with = [&](const std::function<void(FamilyOptions*)>& change) {
    options_ = Quick();
    change(&options_);
    return Error();
  };
  EXPECT_THAT(with([](auto* o) { o->fixed["x"] = 1; }), HasSubstr("fix: no parameter x"));
  EXPECT_THAT(with([](auto* o) { o->freed = {"x"}; }), HasSubstr("free: no parameter x"));
  EXPECT_THAT(with([](auto* o) { o->bounds["x"] = {1, 2}; }), HasSubstr("bound: no parameter x"));
  EXPECT_THAT(with([](auto* o) { o->bounds["n"] = {2, 1}; }), HasSubstr("is empty"));
  EXPECT_THAT(with([](auto* o) { o->bounds["I_o_ref"] = {0, 1}; }), HasSubstr("no bounds"));
  EXPECT_THAT(with([](auto* o) { o->fixed["n"] = 9; }), HasSubstr("is outside [0.5, 4]"));
  EXPECT_THAT(with([](auto* o) { o->search.population = 1; }), HasSubstr("population"));
  EXPECT_THAT(with([](auto* o) { o->search_curves = 0; }), HasSubstr("search-curves"));
  EXPECT_THAT(with([](auto* o) { o->fit_curves = 1; }), HasSubstr("fit-curves"));
  EXPECT_THAT(with([](auto* o) { o->folds = 1; }), HasSubstr("folds"));
  EXPECT_THAT(with([](auto* o) { o->irradiance_accuracy = -1; }), HasSubstr("irradiance-acc"));
  EXPECT_THAT(with([](auto* o) { o->temperature_accuracy_K = kUnknown; }),
              HasSubstr("temperature-accuracy"));
  EXPECT_THAT(with([](auto* o) { o->model = Model::kTripleDiode; }), HasSubstr("one or two"));
  EXPECT_THAT(with([](auto* o) { o->recombination = true; }), HasSubstr("pvsyst"));
  set_ = SyntheticSet(law_, truth_, {{1000, 25}, {500, 45}}, 3, 0);
  EXPECT_THAT(with([](auto*) {}), HasSubstr("6 points cannot determine 7 shared parameters"));
}

TEST_F(FitFamilyTest, KeepsToFixedValuesAndBounds) {
  options_.fixed["EgRef"] = 1.121;
  options_.bounds["n"] = {1.25, 1.5};
  options_.bounds["R_sh_ref"] = {1, 150};
  const FamilyReport report = Fit();
  EXPECT_EQ(Of(report, "EgRef").refined, 1.121);
  EXPECT_TRUE(Of(report, "EgRef").fixed);
  EXPECT_NEAR(Of(report, "n").refined, 1.25, 1e-12);
  EXPECT_EQ(Of(report, "n").at_bound, BoundSide::kLower);
  EXPECT_EQ(Of(report, "R_sh_ref").at_bound, BoundSide::kUpper);
  EXPECT_THAT(report.warnings, testing::Contains(HasSubstr("n ended at its lower bound")));
}

TEST_F(FitFamilyTest, FitsTheObjectiveAndTheWeightsItIsTold) {
  options_.intervals = false;
  const FamilyReport solved = Fit();
  options_.objective = Objective::kMeasuredCurrent;
  const FamilyReport measured = Fit();
  EXPECT_LE(measured.rmse.refined.measured_current_A, solved.rmse.refined.measured_current_A);
  EXPECT_LE(solved.rmse.refined.solved_current_A, measured.rmse.refined.solved_current_A);
  EXPECT_NEAR(Of(measured, "n").refined, 1.2, 0.02);
  options_.objective = Objective::kSolvedCurrent;
  options_.weights = FamilyWeights::kIsc;
  const FamilyReport relative = Fit();
  EXPECT_LT(relative.curves[4].rmse.solved_current_A,
            solved.curves[4].rmse.solved_current_A * (1 + 1e-6));
}

TEST_F(FitFamilyTest, BearsUnusualIdealitiesAndFewPoints) {
  std::vector<double> outlier = truth_;
  outlier[law_.n] = 3.2;
  outlier[law_.saturation_current] = 2.5e-3;
  set_ = SyntheticSet(law_, outlier, kSixPlaces, 30, 1e-3);
  EXPECT_NEAR(Of(Fit(), "n").refined, 3.2, 0.1);
  set_ = SyntheticSet(law_, truth_, ManyPlaces(15), 3, 1e-3);
  options_.individual_fits = true;
  options_.folds = 3;
  const FamilyReport few = Fit();
  EXPECT_TRUE(few.usable);
  EXPECT_LT(few.rmse.refined.solved_current_A, 2e-3);
}

TEST(FamilyOptionTable, ReadsPercentWithAndWithoutTheirSign) {
  FamilyOptions options;
  for (const char* text : {"2", "2%", "2 %"}) {
    options.irradiance_accuracy = 0;
    ASSERT_TRUE(ReadIrradianceAccuracy(text, &options, {})) << text;
    EXPECT_EQ(options.irradiance_accuracy, 0.02) << text;
  }
  for (const char* text : {"", "%", "-1", "51", "nan", "two"}) {
    const auto read = ReadIrradianceAccuracy(text, &options, {});
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().message,
              std::string("expected percent from 0 to 50, such as 2 or 2%, found '") + text + "'");
  }
}

TEST(FamilyOptionTable, TakesCurvesOneByOneAndInLists) {
  FamilyOptions options;
  ASSERT_TRUE(ReadLeaveOut("17,18", &options, {}));
  ASSERT_TRUE(ReadLeaveOut("3", &options, {}));
  EXPECT_EQ(options.leave_out, (std::vector<std::string>{"17", "18", "3"}));
}

TEST(FamilyOptionTable, EchoesInTheOrderOfTheTable) {
  FamilyOptions options;
  options.folds = 0;
  options.shunt = ShuntLaw::kConstant;
  options.search.population = 40;
  options.irradiance_accuracy = 0.02;
  options.leave_out = {"17", "18"};
  options.starts = StartsFrom::kShape;
  std::string text;
  for (const OptionEcho& echo : NonDefaults(options, kFamilyOptionTable)) {
    text += echo.name + " " + echo.value + " (" + echo.default_value + ")\n";
  }
  EXPECT_EQ(text,
            "shunt constant ()\npopulation 40 (30)\nstarts shape (all)\nirradiance-accuracy 2 "
            "(0)\nfolds 0 (5)\nleave-out 17 ()\nleave-out 18 ()\n");
}

}  // namespace
}  // namespace lyrefit
