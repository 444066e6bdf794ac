#include "lyrefit/model/make_readings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "error_of.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Synthetic {
  Readings readings;
  std::vector<std::string> warnings;
};

Synthetic Make(const CurveSet& set) {
  Synthetic made;
  auto readings = MakeReadings(set, &made.warnings);
  EXPECT_TRUE(readings.has_value());
  if (readings) made.readings = *readings;
  return made;
}

TEST(MakeReadingsTest, ScalesCurrentsAndVoltages) {
  Recipe recipe;
  recipe.cells = 60;
  recipe.noise_A = 0;
  const IvCurve curve = SyntheticCurve(recipe);
  const Synthetic made = Make(SetOf({curve}));
  const Readings& readings = made.readings;
  EXPECT_THAT(made.warnings, IsEmpty());
  EXPECT_EQ(readings.scale.cells, 60);
  EXPECT_NEAR(readings.scale.current_A, 8, 0.05);
  ASSERT_EQ(readings.points.size(), curve.size());
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const Reading& r = readings.points[k];
    EXPECT_DOUBLE_EQ(r.voltage * 60, curve.voltage_V[k]);
    EXPECT_DOUBLE_EQ(r.current * readings.scale.current_A, curve.current_A[k]);
    EXPECT_EQ(r.irradiance, 1);
    EXPECT_EQ(r.temperature_K, 298.15);
    EXPECT_EQ(r.segment, 0);
    EXPECT_EQ(r.index, static_cast<int>(k));
    EXPECT_NEAR(r.rate, 1, 1e-9);  // an even sweep
  }
  EXPECT_DOUBLE_EQ(readings.points.front().x, -0.5);
  EXPECT_DOUBLE_EQ(readings.points.back().x, 0.5);
  EXPECT_NEAR(readings.scale.rate_V_per_s, 0.665 / 59, 1e-12);
  EXPECT_FALSE(readings.scale.times);
  EXPECT_NEAR(readings.pivot_voltage, 0.627, 0.005);  // Voc
  EXPECT_DOUBLE_EQ(readings.scale.reach_V, 0.645);
}

TEST(MakeReadingsTest, FindsTheTraitsOfASweep) {
  const Synthetic made = Make(SetOf({SyntheticCurve({})}));
  const DataTraits& traits = made.readings.traits;
  EXPECT_TRUE(traits.single && traits.beyond_voc);
  EXPECT_FALSE(traits.reverse || traits.up_down || traits.dark || traits.only_dark ||
               traits.module);
  EXPECT_EQ(traits.curves, 1);
  EXPECT_EQ(traits.readings, 60);
  EXPECT_EQ(traits.step_times.size(), 57U);
  EXPECT_GT(traits.step_times.front(), made.readings.points[1].x);
  EXPECT_LT(traits.step_times.front(), made.readings.points[2].x);
  const std::vector<double>& places = traits.range_currents;
  ASSERT_GT(places.size(), 20U);
  EXPECT_GE(places.front(), 0.03);
  EXPECT_LE(places.back(), 0.97);
  for (std::size_t k = 1; k < places.size(); ++k) EXPECT_GE(places[k] - places[k - 1], 0.01);
}

TEST(MakeReadingsTest, FindsUpAndDownAndReverse) {
  Recipe recipe;
  recipe.and_back = true;
  recipe.from_V = -5;
  IvCurve curve = SyntheticCurve(recipe);
  curve.notes.bypass_diodes = 3;
  for (std::size_t k = 0; k < curve.size(); ++k) curve.time_s.push_back(10 + 0.01 * k);
  const Synthetic made = Make(SetOf({curve}));
  EXPECT_TRUE(made.readings.traits.up_down && made.readings.traits.reverse);
  EXPECT_EQ(made.readings.traits.substrings, 3);
  EXPECT_EQ(made.readings.points.front().segment, 0);
  EXPECT_EQ(made.readings.points.back().segment, 1);
  EXPECT_GT(made.readings.points[5].rate, 0);
  EXPECT_LT(made.readings.points[100].rate, 0);
  EXPECT_TRUE(made.readings.scale.times);
  EXPECT_NEAR(made.readings.scale.span_s, 1.19, 1e-9);
}

TEST(MakeReadingsTest, FindsLightAndDark) {
  const Synthetic made = Make(SetOf({SyntheticCurve({}), SyntheticDarkCurve()}));
  const DataTraits& traits = made.readings.traits;
  EXPECT_THAT(made.warnings, IsEmpty());
  for (const Reading& r : made.readings.points) EXPECT_EQ(r.dark, r.curve == 1);
  EXPECT_TRUE(traits.dark);
  EXPECT_FALSE(traits.single || traits.only_dark || traits.up_down);
  EXPECT_EQ(traits.irradiance_levels, 1);
  EXPECT_NEAR(made.readings.scale.current_A, 8, 0.05);
  EXPECT_EQ(made.readings.points.back().irradiance, 0);
  EXPECT_EQ(made.readings.points.back().index, 59);
  EXPECT_TRUE(traits.step_times.empty());
}

TEST(MakeReadingsTest, FindsTheLevelsOfAFamily) {
  std::vector<IvCurve> curves;
  for (const double irradiance : {200.0, 600.0, 1000.0, 1005.0}) {
    for (const double celsius : {25.0, 26.0, 60.0}) {
      Recipe recipe;
      recipe.irradiance_W_m2 = irradiance;
      recipe.points = 12;
      curves.push_back(SyntheticCurve(recipe));
      curves.back().conditions.cell_temperature_K = celsius + kZeroCelsius_K;
    }
  }
  const Synthetic made = Make(SetOf(curves));
  EXPECT_EQ(made.readings.traits.curves, 12);
  EXPECT_EQ(made.readings.traits.irradiance_levels, 3);
  EXPECT_EQ(made.readings.traits.temperature_levels, 2);
  EXPECT_EQ(made.readings.reference_temperature_K, 298.15);
}

TEST(MakeReadingsTest, TheDataDecideWhatIsDark) {
  IvCurve dark = SyntheticDarkCurve();
  dark.conditions.irradiance_W_m2 = 1000;
  const Synthetic stated_lit = Make(SetOf({dark}));
  EXPECT_TRUE(stated_lit.readings.points.front().dark);
  EXPECT_THAT(stated_lit.warnings, ElementsAre(HasSubstr("taken as dark")));
  EXPECT_TRUE(stated_lit.readings.traits.only_dark);
  EXPECT_EQ(stated_lit.readings.points.front().irradiance, 0);
  IvCurve lit = SyntheticCurve({});
  lit.conditions.irradiance_W_m2 = 0;
  const Synthetic stated_dark = Make(SetOf({lit}));
  EXPECT_FALSE(stated_dark.readings.points.front().dark);
  EXPECT_THAT(stated_dark.warnings, ElementsAre(HasSubstr("taken as lit")));
  EXPECT_EQ(stated_dark.readings.points.front().irradiance, 1);
}

// Curves from 5 W/m2 on count as lit.
TEST(MakeReadingsTest, ACurveUnderLittleLightIsLitByIt) {
  for (const double irradiance : {5.0, 10.0, 20.0}) {
    Recipe recipe;
    recipe.irradiance_W_m2 = irradiance;
    recipe.noise_A = 1e-5;
    const Synthetic made = Make(SetOf({SyntheticCurve(recipe)}));
    EXPECT_THAT(made.warnings, IsEmpty());
    EXPECT_FALSE(made.readings.points.front().dark);
    EXPECT_NEAR(made.readings.points.front().irradiance, irradiance / 1000, 1e-12);
  }
}

TEST(MakeReadingsTest, ASensorThatShowsALittleInTheDarkIsNotReproached) {
  IvCurve dark = SyntheticDarkCurve();
  dark.conditions.irradiance_W_m2 = 3;
  const Synthetic made = Make(SetOf({dark}));
  EXPECT_TRUE(made.readings.points.front().dark);
  EXPECT_THAT(made.warnings, IsEmpty());
}

TEST(MakeReadingsTest, WarnsOfSweepsThatAreNone) {
  IvCurve curve = SyntheticCurve({});
  for (std::size_t k = 0; k < curve.size(); ++k) curve.sweep.push_back(k < 30 ? 1 : 2);
  EXPECT_THAT(Make(SetOf({curve})).warnings, ElementsAre(HasSubstr("several sweeps are stated")));
}

TEST(MakeReadingsTest, WarnsOfTimesThatDoNotIncrease) {
  IvCurve curve = SyntheticCurve({});
  curve.time_s.assign(curve.size(), 1.0);
  const Synthetic made = Make(SetOf({curve}));
  EXPECT_THAT(made.warnings, ElementsAre(HasSubstr("the times do not increase")));
  EXPECT_FALSE(made.readings.scale.times);
  EXPECT_DOUBLE_EQ(made.readings.points.back().x, 0.5);
}

TEST(MakeReadingsTest, FollowsAMonitorOfTheLight) {
  IvCurve curve = SyntheticCurve({});
  for (std::size_t k = 0; k < curve.size(); ++k) curve.irradiance_W_m2.push_back(1000 - 2. * k);
  const Synthetic made = Make(SetOf({curve}));
  EXPECT_DOUBLE_EQ(made.readings.points[50].irradiance, 0.9);
  curve.irradiance_W_m2.assign(curve.size(), 1000.0);
  EXPECT_EQ(Make(SetOf({curve})).readings.points[50].irradiance, 1);
}

TEST(MakeReadingsTest, TakesWhatTheNotesState) {
  IvCurve curve = SyntheticCurve({});
  curve.notes.bandgap_eV = 1.4;
  curve.notes.isc_tempco_A_per_K = 0.004;
  const Readings readings = Make(SetOf({curve})).readings;
  EXPECT_EQ(readings.bandgap_eV, 1.4);
  EXPECT_NEAR(readings.isc_tempco_scales_per_K * readings.scale.current_A, 0.004, 1e-15);
}

TEST(MakeReadingsTest, RefusesWhatIsNoMeasurement) {
  std::vector<std::string> warnings;
  EXPECT_FALSE(MakeReadings(CurveSet(), &warnings));
  Recipe module;
  module.cells = 60;
  EXPECT_THAT(
      MessageOf(MakeReadings(SetOf({SyntheticCurve({}), SyntheticCurve(module)}), &warnings)),
      HasSubstr("number of cells differs"));
  IvCurve broken = SyntheticCurve({});
  broken.current_A[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(MakeReadings(SetOf({broken}), &warnings));
}

TEST(UsualSubstringsTest, AreThreeOfEveryModuleThatTheCellsMake) {
  EXPECT_THAT(UsualSubstrings(1200), ::testing::ElementsAre(60));
  EXPECT_THAT(UsualSubstrings(1440), ::testing::ElementsAre(72, 60));
  EXPECT_THAT(UsualSubstrings(20 * 66), ::testing::ElementsAre(66, 60));
  EXPECT_THAT(UsualSubstrings(1082), ::testing::ElementsAre(54)) << "20 cells a group";
  EXPECT_TRUE(UsualSubstrings(144).empty()) << "a module";
}

TEST(MakeReadingsTest, AStringHasTheUsualDiodesWhereNobodyStatesThem) {
  CurveSet set;
  set.curves = {SyntheticCurve({})};
  IvCurve& curve = set.curves.front();
  for (double& voltage : curve.voltage_V) voltage *= 1200.0 / curve.conditions.cells_in_series;
  curve.conditions.cells_in_series = 1200;
  std::vector<std::string> warnings;
  auto readings = MakeReadings(set, &warnings);
  ASSERT_TRUE(readings) << readings.error().message;
  EXPECT_EQ(SubstringsOf(readings->traits), 60);
  EXPECT_FALSE(readings->traits.bypass_known);
  curve.notes.bypass_diodes = 30;
  readings = MakeReadings(set, &warnings);
  EXPECT_EQ(SubstringsOf(readings->traits), 30);
  EXPECT_TRUE(readings->traits.bypass_known);
}

}  // namespace
}  // namespace lyrefit
