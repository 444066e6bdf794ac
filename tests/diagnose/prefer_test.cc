#include "lyrefit/diagnose/prefer.h"

#include <gtest/gtest.h>

#include "made_bench.h"

namespace lyrefit {
namespace {

constexpr double kOrdinary = 1.2, kMisfit = 0.004, kFloor = 0.0025;

Recipe SweptModule(bool and_back = false) {
  Recipe recipe;
  recipe.cells = 60;
  recipe.and_back = and_back;
  return recipe;
}

// An effect fitted beside an ordinary base, not evaluated.
Rival RivalOf(const char* id, const std::vector<double>& values, double statistic,
              double n = kOrdinary) {
  Rival rival;
  rival.score.effect = FindEffect(id);
  rival.statistic = statistic;
  rival.fit.usable = true;
  rival.fit.law.effects = {rival.score.effect};
  rival.fit.p = {1, 0, n, 0.015, 0.05};
  rival.fit.p.insert(rival.fit.p.end(), values.begin(), values.end());
  return rival;
}

const std::vector<double> kShade = {0.3, 1.0 / 3, 0.5, 1}, kDip = {0.1, 0, 0.05, 0, 2},
                          kUnequal = {0.1, 0.2}, kLag = {0.001, 0};

LawFit Before(double n = kOrdinary) {
  LawFit before;
  before.p = {1, 0, n, 0.015, 0.05};
  return before;
}

TEST(HasPossibleSize, RefusesWhatCannotBe) {
  const MadeBench made = OnTheBench(MadeCurve(SweptModule()));
  const Readings& readings = *made.bench.readings;
  const auto possible = [&](const Rival& rival, const LawFit& before = Before()) {
    return HasPossibleSize(readings, before, rival);
  };
  EXPECT_TRUE(possible(RivalOf("temp_drift", {2}, 50)));
  EXPECT_FALSE(possible(RivalOf("temp_drift", {-12}, 50)));
  EXPECT_FALSE(possible(RivalOf("irr_step", {0.5, 0}, 50)));  // at its bound
  EXPECT_TRUE(possible(RivalOf("mismatch", kUnequal, 50)));
  EXPECT_FALSE(possible(RivalOf("mismatch", {0.1, 0.006}, 50)));  // a third of a cell
  EXPECT_FALSE(possible(RivalOf("nonohmic_shunt", {0.1, 5}, 50)));
  EXPECT_FALSE(possible(RivalOf("mismatch", kUnequal, 50, 0.7)));
  EXPECT_TRUE(possible(RivalOf("mismatch", kUnequal, 50, 0.7), Before(0.6)));
  // The first of the darker groups may be as bright as the brightest; one of them is not.
  EXPECT_TRUE(possible(RivalOf("substrings", {0, 0.3, 0.4, 0.3, 0, 0, 0, 0, 0.5, 1}, 50)));
  EXPECT_FALSE(possible(RivalOf("substrings", {0, 0.3, 0, 0.3, 0, 0, 0, 0, 0.5, 1}, 50)));
}

std::size_t Preferred(const MadeBench& made, const std::vector<Rival>& rivals) {
  return Prefer(made.bench, rivals, kMisfit, kFloor);
}

TEST(Prefer, TakesTheDeviceBeforeAMomentThatExplainsAboutAsMuch) {
  const MadeBench made = OnTheBench(MadeCurve(SweptModule()));
  EXPECT_EQ(Preferred(made, {RivalOf("transient", kDip, 100), RivalOf("mismatch", kUnequal, 92)}),
            1U);
  EXPECT_EQ(Preferred(made, {RivalOf("transient", kDip, 100), RivalOf("mismatch", kUnequal, 80)}),
            0U);
}

TEST(Prefer, TakesWhatLeavesAsLittleAndSupposesLess) {
  const MadeBench made = OnTheBench(MadeCurve(SweptModule()));
  const auto leaving = [](Rival rival, double left) {
    rival.left = left;
    return rival;
  };
  const Rival dip = leaving(RivalOf("transient", kDip, 100), 0.001);
  const auto with = [&](const Rival& other) { return Preferred(made, {dip, other}); };
  EXPECT_EQ(with(leaving(RivalOf("mismatch", kUnequal, 70), 0.0012)), 1U);
  EXPECT_EQ(with(leaving(RivalOf("mismatch", kUnequal, 70), 0.0013)), 0U);
  EXPECT_EQ(with(leaving(RivalOf("mismatch", kUnequal, 40), 0.0005)), 0U);  // of half of it
}

TEST(Prefer, TakesAPossibleIdealityBeforeOneThatOnlyBends) {
  const MadeBench made = OnTheBench(MadeCurve(SweptModule()));
  const Rival mismatch = RivalOf("mismatch", kUnequal, 92);
  const auto beside = [&](double n) {
    return Preferred(made, {RivalOf("distributed_rs", {0.05}, 100, n), mismatch});
  };
  EXPECT_EQ(beside(0.5), 1U);
  EXPECT_EQ(beside(kOrdinary), 0U);
}

TEST(Prefer, OneDimCellIsAWeakCell) {
  const MadeBench made = OnTheBench(MadeCurve(SweptModule()));
  const std::vector<double> weak = {0.1, 1, 0, 0.5, 0.1, 15, 3.4, 3.2, 1};
  const auto beside = [&](double cells) {
    return Preferred(made,
                     {RivalOf("mismatch", {0.1, cells / 60}, 100), RivalOf("weak_cell", weak, 99)});
  };
  EXPECT_EQ(beside(1.2), 1U);
  EXPECT_EQ(beside(12), 0U);
}

TEST(Prefer, TakesHysteresisBeforeADipOfSweepsUpAndDown) {
  const MadeBench made = OnTheBench(MadeCurve(SweptModule(/*and_back=*/true)));
  EXPECT_EQ(Preferred(made, {RivalOf("transient", kDip, 100), RivalOf("capacitance", kLag, 80)}),
            1U);
  EXPECT_EQ(Preferred(made, {RivalOf("drift", {0.02}, 100), RivalOf("capacitance", kLag, 80)}), 0U);
}

TEST(Prefer, TakesACloudBeforeARangeUnlessTwoSweepsTell) {
  const std::vector<double> range = {0.02, 0.6}, cloud = {0.02, 0};
  for (const bool both : {false, true}) {
    const MadeBench made = OnTheBench(MadeCurve(SweptModule(both)));
    const auto preferred = [&](double of_range, double of_cloud) {
      const Rival a = RivalOf("range_switch", range, of_range);
      const Rival b = RivalOf("irr_step", cloud, of_cloud);
      const std::size_t at = Preferred(
          made, of_range > of_cloud ? std::vector<Rival>{a, b} : std::vector<Rival>{b, a});
      return (at == 0) == (of_range > of_cloud) ? "range_switch" : "irr_step";
    };
    EXPECT_STREQ(preferred(100, 80), both ? "range_switch" : "irr_step");
    EXPECT_STREQ(preferred(100, 105), both ? "range_switch" : "irr_step");
    EXPECT_STREQ(preferred(100, 40), "range_switch");
    EXPECT_STREQ(preferred(40, 100), "irr_step");
  }
}

// The first sweep's current is raised by what charges, the second's is not: sorted by voltage they
// rise and fall.
TEST(LightMoved, SaysNothingOfTwoSweeps) {
  for (const bool both : {false, true}) {
    IvCurve curve = MadeCurve(SweptModule(both));
    for (std::size_t k = 0; k < curve.size(); ++k) {
      curve.current_A[k] *= 1 + 0.004 * static_cast<double>(std::min<std::size_t>(k, 15));
    }
    EXPECT_EQ(LightMoved(*OnTheBench(curve).bench.readings), !both);
  }
}

TEST(Prefer, TakesWhatSupposesLess) {
  const MadeBench made = OnTheBench(MadeCurve(SweptModule()));
  const std::vector<double> weak = {0.3, 1, 0, 0.5, 0.1, 15, 3.4, 3.2, 1};
  EXPECT_EQ(Preferred(made, {RivalOf("weak_cell", weak, 100), RivalOf("shading", kShade, 99)}), 1U);
  EXPECT_EQ(Preferred(made, {RivalOf("weak_cell", weak, 100), RivalOf("shading", kShade, 70)}), 0U);
}

TEST(Prefer, KeepsTheComplexOneWhereItsCurveIsAnother) {
  const MadeBench made = OnTheBench(MadeCurve(SweptModule()));
  const std::vector<double> both = {0.3, 1. / 3, 0.6, 1. / 3, 0, 0, 0, 0, 0.5, 1};
  const std::vector<Rival> rivals = {RivalOf("substrings", both, 100),
                                     RivalOf("shading", kShade, 99)};
  // A tenth of the misfit is left to the simple one.
  EXPECT_EQ(Prefer(made.bench, rivals, 9 * kFloor, kFloor), 1U);
  EXPECT_EQ(Prefer(made.bench, rivals, 11 * kFloor, kFloor), 0U);
}

TEST(LightMoved, WhereTheCurrentRisesWithTheVoltage) {
  IvCurve curve = MadeCurve(SweptModule());
  EXPECT_FALSE(LightMoved(*OnTheBench(curve).bench.readings));
  for (std::size_t k = 0; k < curve.size() / 2; ++k) {
    curve.current_A[k] *= 0.9 + 0.1 * static_cast<double>(k) / (0.5 * curve.size());
  }
  const MadeBench made = OnTheBench(curve);
  EXPECT_TRUE(LightMoved(*made.bench.readings));
  EXPECT_EQ(Preferred(made, {RivalOf("shading", kShade, 100), RivalOf("drift", {0.1}, 40)}), 1U);
}

}  // namespace
}  // namespace lyrefit
