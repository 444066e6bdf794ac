#include "lyrefit/diagnose/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/synthetic_data.h"
#include "lyrefit/diagnose/select.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr Floors kFloors = {0.0025, 0.005};

// A base fit of a clean curve as the extended model; the causes of `verdict` are said beside it.
Verdict Told(Verdict verdict, const std::vector<DeviceFinding>& findings = {},
             const Floors& floors = kFloors, const IvCurve& curve = SyntheticCurve({}),
             double sigma_A = 0.004) {
  const SyntheticData made = OnTheData(SetOf({curve}), sigma_A);
  Selection selection;
  selection.weighted = made.weighted;
  selection.extended = FitBase(made.weighted, Law());
  DescribeVerdict(selection, floors, findings, 0.8, &verdict);
  return verdict;
}

Cause NamedCause(const std::string& title) {
  Cause cause;
  cause.id = cause.title = title;
  return cause;
}

Verdict With(std::vector<Cause> causes, double lack_of_fit) {
  Verdict verdict;
  verdict.causes = std::move(causes);
  verdict.found = true;
  verdict.lack_of_fit.value = lack_of_fit;
  return verdict;
}

TEST(DescribeVerdict, TheDataShowACauseOnlyIfNothingIsLeft) {
  const Verdict shown = Told(With({NamedCause("weak cells")}, 0.05));
  EXPECT_EQ(shown.sentence, "The data show weak cells.");
  EXPECT_THAT(shown.comparison, HasSubstr("5.00 without; healthy modules 0.05 to 0.20 %"));
  Verdict left = With({NamedCause("weak cells")}, 0.05);
  left.unexplained = true;
  const std::string sentence = Told(left).sentence;
  EXPECT_THAT(sentence, HasSubstr("Weak cells would explain most of it; "));
  EXPECT_THAT(sentence, HasSubstr("% of Isc remain unexplained."));
  EXPECT_THAT(sentence, Not(HasSubstr("The data show")));
}

TEST(DescribeVerdict, SaysHowProbableACauseIs) {
  Cause probable = NamedCause("weak cells");
  probable.probability = 0.86;
  probable.equivalents = {"shading"};
  EXPECT_EQ(Told(With({probable}, 0.05)).sentence, "The data show weak cells (86 %).");
  probable.probability = 0.7;
  probable.alternatives = {{"shading", "partial shading", 0.15}, {"none", "no cause", 0.1}};
  EXPECT_EQ(Told(With({probable}, 0.05)).sentence,
            "The data show either weak cells (70 %) or partial shading (15 %).");
  probable.probability = kUnknown;
  EXPECT_EQ(Told(With({probable, NamedCause("drift")}, 0.05)).sentence,
            "The data show weak cells (or what looks like it) and drift.");
}

TEST(SaidBeside, AsManyAsReachTheProbability) {
  Cause cause = NamedCause("shading");
  cause.probability = 0.5;
  for (const auto& [id, probability] : {std::pair("drift", 0.3), {"clip", 0.15}, {"none", 0.05}}) {
    cause.alternatives.push_back({id, id, probability});
  }
  EXPECT_TRUE(SaidBeside(cause, 0.4).empty());
  ASSERT_EQ(SaidBeside(cause, 0.75).size(), 1u);
  EXPECT_EQ(SaidBeside(cause, 0.75)[0].id, "drift");
  EXPECT_EQ(SaidBeside(cause, 0.999).size(), 2u);
  cause.probability = kUnknown;
  EXPECT_TRUE(SaidBeside(cause, 0.75).empty());
}

TEST(DescribeVerdict, SilenceNamesWhatIsNeverShown) {
  const Verdict silent = Told({});
  EXPECT_THAT(silent.sentence, HasSubstr("Nothing to act on"));
  EXPECT_THAT(silent.sentence, HasSubstr("One sweep cannot show " + silent.not_shown));
  EXPECT_THAT(silent.not_shown, HasSubstr("dirt or slight ageing of all cells alike"));
  EXPECT_EQ(silent.comparison, "");
}

TEST(DescribeVerdict, SomethingToActOnIsNotCalledNothing) {
  const DeviceFinding leak = {"leak", "", {0.031, 0.029, 0.033}, 0.016, 0.04, "", false, {}};
  const std::string ill = Told({}, {leak}).sentence;
  EXPECT_THAT(ill,
              HasSubstr("a leak of 3.1 % of Isc at Voc (-4.0 % of Pmax). One sweep cannot show"));
  EXPECT_THAT(ill, Not(HasSubstr("Nothing to act on")));
  Verdict misses;
  misses.lack_of_fit.value = 0.0056;
  misses.below_floor = {NamedCause("drift")};
  const std::string missed = Told(misses).sentence;
  EXPECT_THAT(missed, HasSubstr("misses the data by 0.56 % of Isc"));
  EXPECT_THAT(missed, HasSubstr("drift"));
  EXPECT_THAT(missed, HasSubstr("One sweep cannot show"));
  EXPECT_THAT(missed, Not(HasSubstr("Nothing to act on")));
}

TEST(DescribeVerdict, ASweepThatEndsBeforeItsMaximumPowerIsNotJudged) {
  Recipe recipe;
  recipe.to_V = 0.45;
  const std::string early = Told({}, {}, kFloors, SyntheticCurve(recipe)).sentence;
  EXPECT_THAT(early, HasSubstr("cannot be judged: the sweep ends at 0.45 V"));
  EXPECT_THAT(early, HasSubstr("before the point of maximum power"));
  EXPECT_THAT(early, Not(HasSubstr("Nothing to act on")));
}

TEST(DescribeVerdict, LargeNoiseHasItsSize) {
  Verdict within;
  within.lack_of_fit.value = 1e-5;
  EXPECT_THAT(Told(within).sentence, HasSubstr("beyond their noise. "));
  EXPECT_THAT(Told(within, {}, kFloors, SyntheticCurve({}), 0.08).sentence,
              HasSubstr("beyond their noise of 1.0 % of Isc"));
}

// The device or the instrument: what there is to do depends on it.
TEST(DescribeVerdict, AFindingOfSeveralPartsIsSaidAsASet) {
  Cause cause;
  cause.id = cause.effect = "hysteresis";
  cause.title = "hysteresis by ions or traps";
  cause.group = "device";
  cause.probability = 1;
  cause.mechanisms = {{"hysteresis", cause.title, 0.6},
                      {"timing_skew", "voltage and current not read together", 0.4}};
  EXPECT_EQ(Told(With({cause}, 0.002)).sentence,
            "The data show either hysteresis by ions or traps (60 %) or voltage and current not "
            "read together (40 %).");
  cause.mechanisms[0].probability = 0.9;
  EXPECT_EQ(Told(With({cause}, 0.002)).sentence,
            "The data show hysteresis by ions or traps (100 %).");
}

TEST(DescribeVerdict, AMisfitThatNoCauseFitsHasItsSize) {
  const std::string sentence = Told(With({NamedCause("unknown_structure")}, 0.05)).sentence;
  EXPECT_THAT(sentence, HasSubstr("Something is there that noise does not explain"));
  EXPECT_THAT(sentence, HasSubstr("% of Isc)"));
}

TEST(NotShownBy, DependsOnTheReadings) {
  DataTraits traits;
  EXPECT_THAT(NotShownBy(traits), HasSubstr("light that fades steadily"));
  traits.up_down = true;
  EXPECT_THAT(NotShownBy(traits), Not(HasSubstr("light that fades")));
  traits.temperature_levels = 2;
  EXPECT_THAT(NotShownBy(traits), Not(HasSubstr("temperature")));
}

}  // namespace
}  // namespace lyrefit
