#include "lyrefit/diagnose/reference.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "lyrefit/curve/key_points.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/diagnose/expectation.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kSeriesOhm = 0.24, kNoise_A = 0.005;

// A sweep of one module at some moment of a fair day, with its own irradiance and cell temperature.
// `bump_A`: amplitude of a deviation from the single diode that all sweeps share.
IvCurve Sweep(int number, double bump_A = 0.01) {
  Recipe recipe;
  recipe.name = "s" + std::to_string(number);
  recipe.cells = 60;
  recipe.irradiance_W_m2 = 850 + 20 * ((7 * number) % 13);
  recipe.noise_A = kNoise_A;
  recipe.seed = number;
  IvCurve curve = SyntheticCurve(recipe);
  const double kelvin = (5 * number) % 11;
  curve.conditions.cell_temperature_K += kelvin;
  for (double& v : curve.voltage_V) v *= 1 - 0.003 * kelvin;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    curve.current_A[k] += bump_A * std::sin(12 * curve.voltage_V[k] / 36);
  }
  return curve;
}

std::vector<IvCurve> Sweeps(int count, double bump_A = 0.01) {
  std::vector<IvCurve> sweeps;
  for (int k = 0; k < count; ++k) sweeps.push_back(Sweep(k + 1, bump_A));
  return sweeps;
}

IvCurve WithResistance(IvCurve curve, double ohm) {
  for (std::size_t k = 0; k < curve.size(); ++k) curve.voltage_V[k] -= ohm * curve.current_A[k];
  return curve;
}

IvCurve WithLeak(IvCurve curve, double siemens) {
  for (std::size_t k = 0; k < curve.size(); ++k) curve.current_A[k] -= siemens * curve.voltage_V[k];
  return curve;
}

ReferenceComparison Compare(const IvCurve& curve, const std::vector<IvCurve>& reference) {
  auto comparison = CompareWithReferences(curve, reference);
  EXPECT_TRUE(comparison) << comparison.error().message;
  return comparison ? *comparison : ReferenceComparison();
}

TEST(CompareWithReferences, SaysThatAReferenceSweepIsLikeTheOthers) {
  const ReferenceComparison c = Compare(Sweep(50), Sweeps(24));
  EXPECT_FALSE(c.differs) << c.sentence;
  EXPECT_THAT(c.sentence, HasSubstr("The sweep agrees with its 24 reference sweeps"));
  EXPECT_THAT(c.causes, IsEmpty());
  EXPECT_EQ(c.references.size(), 24U);
  for (const ReferenceRow& row : c.rows) {
    EXPECT_LT(row.low_95, row.high_95) << row.symbol;
    EXPECT_LT(std::fabs(row.z), 4) << row.symbol;
  }
}

TEST(CompareWithReferences, NamesASeriesResistanceWithItsSizeAndItsPower) {
  const IvCurve before = Sweep(50, 0), now = WithResistance(before, 0.1 * kSeriesOhm);
  const ReferenceComparison c = Compare(now, Sweeps(24, 0));
  ASSERT_TRUE(c.differs);
  ASSERT_FALSE(c.causes.empty());
  const ReferenceCause& cause = c.causes.front();
  EXPECT_EQ(cause.id, "series_resistance");
  // The change is relative to this sweep's own Rs. Its cells are warmer than those of the
  // references, so its voltages, and with them its Rs, are smaller.
  const CauseParameter& size = cause.strength.front();
  EXPECT_NEAR(size.value, 10.25, 1);
  EXPECT_LT(size.low_95, size.value);
  EXPECT_GT(size.high_95, size.value);
  const double lost = FindKeyPoints(now.voltage_V, now.current_A).max_power_W /
                          FindKeyPoints(before.voltage_V, before.current_A).max_power_W -
                      1;
  EXPECT_NEAR(-cause.power_effect.value, lost, 0.3 * std::fabs(lost));
  EXPECT_THAT(c.sentence, HasSubstr("series resistance +"));
}

TEST(CompareWithReferences, NamesALeak) {
  const ReferenceComparison c = Compare(WithLeak(Sweep(50), 0.02 * 8 / 36), Sweeps(24));
  ASSERT_TRUE(c.differs);
  ASSERT_FALSE(c.causes.empty());
  EXPECT_EQ(c.causes.front().id, "shunt");
  EXPECT_NEAR(c.causes.front().strength.front().value, 2, 0.7);
  EXPECT_GT(c.causes.front().power_effect.value, 0.01);
}

// Light that fades steadily takes current in proportion to the time, which only a fit of the whole
// sweep tells from a leak.
TEST(CompareWithReferences, NamesLightThatFades) {
  IvCurve curve = Sweep(50);
  const double last = static_cast<double>(curve.size()) - 1;
  const double isc = curve.current_A.front();
  for (std::size_t k = 0; k < curve.size(); ++k) {
    curve.current_A[k] -= 0.02 * isc * (static_cast<double>(k) / last - 0.5);
  }
  const ReferenceComparison c = Compare(curve, Sweeps(24));
  ASSERT_TRUE(c.differs);
  const auto drift = std::find_if(c.causes.begin(), c.causes.end(),
                                  [](const ReferenceCause& cause) { return cause.id == "drift"; });
  ASSERT_NE(drift, c.causes.end());
  EXPECT_NEAR(drift->strength.front().value, -2, 0.5);
}

TEST(CompareWithReferences, FewReferenceSweepsShowOnlyLargeDifferencesAndSaySo) {
  const ReferenceComparison c = Compare(WithResistance(Sweep(50), kSeriesOhm), Sweeps(5));
  EXPECT_TRUE(c.differs);
  EXPECT_THAT(c.warnings, Contains(HasSubstr("only large differences")));
  EXPECT_THAT(c.regressed_on, IsEmpty());
}

TEST(CompareWithReferences, TakesOffWhatAllMissAlike) {
  const IvCurve sweep = Sweep(50);
  const ReferenceComparison c = Compare(sweep, Sweeps(24));
  const auto size = [](const IvCurve& curve) {
    double squares = 0;
    const auto fitted = FitSweep(curve);
    for (const double off : fitted->state.off) squares += off * off;
    return std::sqrt(squares / static_cast<double>(curve.size()));
  };
  const double before = size(sweep), after = size(c.without_common);
  EXPECT_GT(c.common, 5e-4);
  EXPECT_NEAR(after, kNoise_A / 7.5, 0.2 * kNoise_A / 7.5);
  EXPECT_GT(before, 1.2 * after);
  EXPECT_THAT(SentencesOf(c.without_common.assumptions), Contains(HasSubstr("miss alike")));
}

TEST(CompareWithReferences, LeavesOutlierReferencesAndTheSweepItselfOut) {
  std::vector<IvCurve> reference = Sweeps(24);
  reference[5] = WithResistance(reference[5], 0.5 * kSeriesOhm);
  reference.push_back(Sweep(50));
  const ReferenceComparison c = Compare(Sweep(50), reference);
  EXPECT_THAT(c.left_out, Contains(HasSubstr("s6: unlike")));
  EXPECT_THAT(c.left_out, Contains(HasSubstr("s50: it is the sweep")));
  EXPECT_EQ(c.references.size(), 23U);
}

TEST(CompareWithReferences, SeesSoilingByTheStatedLight) {
  IvCurve soiled = Sweep(50);
  soiled.conditions.irradiance_W_m2 *= 1.05;
  const ReferenceComparison c = Compare(soiled, Sweeps(24));
  EXPECT_TRUE(c.differs);
  EXPECT_EQ(c.rows.back().symbol, "Isc/G");
  EXPECT_NEAR(c.rows.back().power, -0.048, 0.005);
  EXPECT_THAT(c.sentence, HasSubstr("soiling"));
  EXPECT_THAT(c.causes, IsEmpty());
  soiled.irradiance_known = false;
  EXPECT_FALSE(Compare(soiled, Sweeps(24)).differs);
}

TEST(CompareWithReferences, RefusesWhatCannotBeCompared) {
  const auto complaint = [](const IvCurve& curve, const std::vector<IvCurve>& reference) {
    const auto comparison = CompareWithReferences(curve, reference);
    return comparison ? std::string() : comparison.error().message;
  };
  EXPECT_THAT(complaint(Sweep(50), Sweeps(3)), HasSubstr("needs 4 or more; to put"));
  IvCurve other = Sweep(50);
  other.conditions.cells_in_series = 72;
  EXPECT_THAT(complaint(other, Sweeps(8)), HasSubstr("72 cells"));
  IvCurve bright = Sweep(50);
  for (double& current : bright.current_A) current *= 1.6;
  EXPECT_THAT(complaint(bright, Sweeps(8)), HasSubstr("more than 20 % beyond"));
  ReferenceOptions options;
  options.level = 2;
  EXPECT_FALSE(CompareWithReferences(Sweep(50), Sweeps(8), options));
}

TEST(FindOutlierSweeps, ListsTheOutlierOnesFirst) {
  std::vector<IvCurve> sweeps = Sweeps(26);
  sweeps[3] = WithResistance(sweeps[3], 0.3 * kSeriesOhm);
  sweeps[17] = WithLeak(sweeps[17], 0.03 * 8 / 36);
  const auto outlier = FindOutlierSweeps(sweeps);
  ASSERT_TRUE(outlier) << outlier.error().message;
  ASSERT_EQ(outlier->sweeps.size(), 26U);
  EXPECT_EQ(outlier->outlier, 2);
  std::vector<std::string> first = {outlier->sweeps[0].name, outlier->sweeps[1].name};
  std::sort(first.begin(), first.end());
  EXPECT_EQ(first, (std::vector<std::string>{"s18", "s4"}));
  for (std::size_t k = 0; k < 26; ++k) EXPECT_EQ(outlier->sweeps[k].differs, k < 2);
}

TEST(FindOutlierSweeps, GivesTheSameAnswerOnAnyNumberOfThreads) {
  ReferenceOptions options;
  options.threads = 1;
  const auto one = FindOutlierSweeps(Sweeps(12), options);
  options.threads = 3;
  const auto three = FindOutlierSweeps(Sweeps(12), options);
  ASSERT_TRUE(one && three);
  for (std::size_t k = 0; k < one->sweeps.size(); ++k) {
    EXPECT_EQ(one->sweeps[k].name, three->sweeps[k].name);
    EXPECT_EQ(one->sweeps[k].p_value, three->sweeps[k].p_value);
  }
}

TEST(FindOutlierSweeps, RefusesTooFewAndOtherModules) {
  EXPECT_THAT(FindOutlierSweeps(Sweeps(4)).error().message, HasSubstr("takes 5 or more"));
  std::vector<IvCurve> sweeps = Sweeps(8);
  sweeps[2].conditions.cells_in_series = 72;
  EXPECT_THAT(FindOutlierSweeps(sweeps).error().message, HasSubstr("not sweeps of one module"));
}

// A module in one light, with part of its current and of its voltage left.
IvCurve WithLess(double current, double volts) {
  IvCurve curve = SyntheticCurve({"face", 60, 60});
  for (double& i : curve.current_A) i *= current;
  for (double& v : curve.voltage_V) v -= volts;
  curve.notes.setup = Setup::kFlash;
  return curve;
}

std::vector<std::string> CauseIds(const ReferenceComparison& c) {
  std::vector<std::string> ids;
  for (const ReferenceCause& cause : c.causes) ids.push_back(cause.id);
  return ids;
}

TEST(CompareWithReferences, OneReferenceTellsPolarisationFromLessLight) {
  const std::vector<IvCurve> before = {WithLess(1, 0)};
  const ReferenceComparison same = Compare(WithLess(1.001, 0), before);
  EXPECT_FALSE(same.differs) << same.sentence;
  // 20 % less current takes some 0.4 V of 38 V by itself.
  const ReferenceComparison polarised = Compare(WithLess(0.8, 2), before);
  EXPECT_THAT(CauseIds(polarised),
              ::testing::ElementsAre("polarisation", "degradation", "less_light"));
  for (const char* words : {"PID-p", "LeTID", "the other face", "days of sun"}) {
    EXPECT_THAT(polarised.sentence, HasSubstr(words));
  }
  const ReferenceComparison dirty = Compare(WithLess(0.8, 0.4), before);
  EXPECT_THAT(CauseIds(dirty), ::testing::ElementsAre("less_light"));
  EXPECT_THAT(dirty.sentence, HasSubstr("soiling"));
}

TEST(CompareWithReferences, OneReferenceShowsShuntsOfManyCells) {
  const std::vector<IvCurve> before = {WithLess(1, 0)};
  const ReferenceComparison c = Compare(WithLeak(before.front(), 0.03), before);
  EXPECT_THAT(CauseIds(c), Contains("shunt"));
  for (const char* words : {"PID-s", "a fifth of the light", "dark at 60 C"}) {
    EXPECT_THAT(c.sentence, HasSubstr(words));
  }
}

TEST(CompareWithReferences, FewReferencesNeedStatedAndLikeLight) {
  IvCurve unknown = WithLess(1, 0);
  unknown.irradiance_known = false;
  EXPECT_FALSE(CompareWithReferences(WithLess(1, 0), {unknown}));
  IvCurve dim = WithLess(0.5, 0);
  dim.conditions.irradiance_W_m2 = 500;
  EXPECT_FALSE(CompareWithReferences(WithLess(1, 0), {dim}));
}

}  // namespace
}  // namespace lyrefit
