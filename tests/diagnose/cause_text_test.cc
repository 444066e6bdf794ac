#include "lyrefit/diagnose/describe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnose/synthetic_data.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// The words for an effect with these parameters, on a base fit of a curve. `strength`: the
// reported parameters.
std::string WordsFor(const char* id, const std::vector<double>& values,
                     const std::vector<CauseParameter>& strength,
                     const IvCurve& curve = SyntheticCurve({})) {
  const SyntheticData made = OnTheData(curve);
  LawFit fit = FitBase(made.weighted, Law());
  fit.law.effects = {FindEffect(id)};
  fit.p.insert(fit.p.end(), values.begin(), values.end());
  LawWorkspace workspace;
  EXPECT_TRUE(EvaluateLaw(fit.law, *made.weighted.readings, fit.p.data(), &workspace,
                          fit.current.data(), nullptr));
  const std::vector<std::string> words = InWords(made.weighted, fit, 0, strength);
  return words.empty() ? "" : words.front();
}

CauseParameter Reported(const char* symbol, double value, double half) {
  return {symbol, "", "", value, value - half, value + half, false};
}

TEST(InWordsTest, OfLightSaysHowMuchWeakerItWasAndWhere) {
  EXPECT_THAT(WordsFor("irr_step", {-0.05, 0}, {Reported("s", -0.05, 0.002)}),
              HasSubstr("on the light was 5.0 % (4.8 to 5.2) weaker than before"));
  EXPECT_THAT(WordsFor("irr_step", {0.05, 0}, {Reported("s", 0.05, 0.002)}),
              HasSubstr("5.0 % (4.8 to 5.2) stronger"));
  EXPECT_THAT(WordsFor("transient", {0.1, 0, 0.1, 0, 2}, {Reported("a", 0.1, 0.01)}),
              HasSubstr("V the light was 10.0 % (9.0 to 11.0) weaker for a moment"));
  EXPECT_EQ(WordsFor("drift", {0.03}, {Reported("d", 0.03, 0.01)}),
            "at the end of the sweep the light was 3.0 % (2.0 to 4.0) stronger than at its begin");
}

TEST(InWordsTest, OfAnIntervalThatRoundingHidesSaysNothing) {
  EXPECT_EQ(WordsFor("drift", {-0.03}, {Reported("d", -0.03, 1e-5)}),
            "at the end of the sweep the light was 3.0 % weaker than at its begin");
}

TEST(InWordsTest, OfLightThatIsNotDeterminedHasNoNumber) {
  EXPECT_EQ(WordsFor("drift", {0.1}, {Reported("d", 0.1, 0.2)}),
            "at the end of the sweep the light was stronger or weaker than at its begin: these "
            "readings determine neither size nor sign");
  // The interval ends at the bound of the fit.
  EXPECT_EQ(WordsFor("drift", {0.3}, {Reported("d", 0.3, 0.2)}),
            "at the end of the sweep the light was at least 10.0 % stronger than at its begin");
}

// Without times a shift is a number of readings; with them it is a time.
TEST(InWordsTest, OfTimingKnowsTimesOnlyWhereTheyAreRecorded) {
  const std::vector<CauseParameter> skew = {Reported("ts", -1.5, 0.5)};
  EXPECT_EQ(WordsFor("timing_skew", {-0.02}, skew),
            "the voltage was read 1.5 readings (1 to 2) before the current, 20 mV along the sweep; "
            "the file has no times");
  IvCurve timed = SyntheticCurve({});
  for (std::size_t k = 0; k < timed.size(); ++k) timed.time_s.push_back(0.01 * k);
  EXPECT_EQ(WordsFor("timing_skew", {-0.02}, skew, timed),
            "the voltage was read 1500 ms (1000 to 2000) before the current");
}

TEST(InWordsTest, OfInstrumentsSaysTheDirection) {
  EXPECT_EQ(WordsFor("voltage_offset", {-0.02}, {Reported("c", -0.02, 0.005)}),
            "the instrument reads 20 mV (15 to 25) too little");
  EXPECT_EQ(WordsFor("temp_drift", {2}, {Reported("r", 2, 0.5)}),
            "2 K (1.5 to 2.5) warmer at the end than at the begin");
}

TEST(InWordsTest, OfOtherEffectsSaysTheLargestChangeOfTheCurrent) {
  const std::string shunt = WordsFor("nonohmic_shunt", {0.05, 2}, {Reported("k", 0.4, 0.1)});
  EXPECT_THAT(shunt, HasSubstr("it takes up to "));
  EXPECT_THAT(shunt, HasSubstr("% of Isc, most at 0."));
  EXPECT_THAT(shunt, Not(HasSubstr("k =")));
}

}  // namespace
}  // namespace lyrefit
