#include "lyrefit/curve/check_readings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "cases.h"
#include "error_of.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/curve/plausibility.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// Scales the voltages so that the open-circuit voltage is `voc_V`.
void ScaleVoc(double voc_V, IvCurve* curve) {
  const double factor =
      voc_V / FindKeyPoints(curve->voltage_V, curve->current_A).open_circuit_voltage_V;
  for (double& voltage : curve->voltage_V) voltage *= factor;
}

TEST(CheckReadingsTest, SoundCurvesHaveNoFindings) {
  EXPECT_THAT(CheckReadings(SyntheticModule()), IsEmpty());
  EXPECT_THAT(CheckReadings(SyntheticModule(1, 1, 0.5)), IsEmpty());
  EXPECT_THAT(CheckReadings(SyntheticCell()), IsEmpty());
  EXPECT_THAT(CheckReadings(SyntheticCell(0)), IsEmpty());  // dark
}

TEST(CheckReadingsTest, AnImplausibleCurrentIsDoubtedButNotRefused) {
  IvCurve curve = SyntheticModule();
  for (double& i : curve.current_A) i *= 30;
  const auto findings = CheckReadings(curve);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].id, "current");
  EXPECT_FALSE(findings[0].refuse);
}

TEST(CheckReadingsTest, LightThatIsNotStatedIsDoubted) {
  for (const double stated : {0.0, 5.0}) {
    IvCurve curve = SyntheticModule();
    curve.conditions.irradiance_W_m2 = stated;
    const auto findings = CheckReadings(curve);
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].id, "light");
    EXPECT_FALSE(findings[0].refuse);
    EXPECT_THAT(findings[0].sentence, HasSubstr("W/m2 are stated, but the device delivers"));
    EXPECT_THAT(findings[0].sentence, HasSubstr("--irradiance-Wm2"));
  }
  IvCurve dim = SyntheticCell(0.01);  // 1.5 mA at 10 W/m2
  dim.conditions.irradiance_W_m2 = 10;
  IvCurve dark = SyntheticCell(0);
  dark.conditions.irradiance_W_m2 = 0;
  EXPECT_THAT(CheckReadings(dim), IsEmpty());
  EXPECT_THAT(CheckReadings(dark), IsEmpty());
}

TEST(CheckReadingsTest, ATemperatureOfTheHeadThatIsNotUsedIsADoubt) {
  IvCurve curve = SyntheticModule();
  curve.temperature_known = false;
  curve.assumptions = {LeftTemperature("line 3 'Temp1 47.3'")};
  const auto findings = CheckReadings(curve);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].id, "head");
  EXPECT_FALSE(findings[0].refuse);
  EXPECT_THAT(findings[0].sentence, HasSubstr("line 3 'Temp1 47.3' speaks of a temperature"));
  curve.temperature_known = true;
  EXPECT_THAT(CheckReadings(curve), IsEmpty());
}

// Ways in which the readings of a module are spoilt.
const std::map<std::string, std::function<void(IvCurve*)>> kSpoilt = {
    {"Keithley's overflow", [](IvCurve* c) { c->current_A[5] = 9.91e37; }},
    {"two overflows", [](IvCurve* c) { c->voltage_V[2] = c->voltage_V[9] = 1e308; }},
    {"all zero", [](IvCurve* c) { c->current_A.assign(100, 0); }},
    {"all equal", [](IvCurve* c) { c->current_A.assign(100, 0.5); }},
    {"below any instrument",
     [](IvCurve* c) {
       for (double& i : c->current_A) i *= 1e-70;
     }},
    {"voltage of the wrong sign",
     [](IvCurve* c) {
       for (double& v : c->voltage_V) v = -v;
     }},
    {"milliampere",
     [](IvCurve* c) {
       for (double& i : c->current_A) i *= 1e3;
       c->current_unit_known = false;
     }},
    {"registers",
     [](IvCurve* c) {
       for (double& v : c->voltage_V) v = std::round(1e3 * v);
       c->voltage_unit_known = false;
     }},
    {"millivolt",
     [](IvCurve* c) {
       for (double& v : c->voltage_V) v *= 1e3;
       c->voltage_unit_known = false;
     }},
    {"nothing delivers so much",
     [](IvCurve* c) {
       for (double& i : c->current_A) i *= 1e5;
     }},
    {"columns exchanged, no units",
     [](IvCurve* c) {
       std::swap(c->voltage_V, c->current_A);
       c->current_unit_known = c->voltage_unit_known = c->cells_known = false;
       c->conditions.cells_in_series = 1;
     }},
    {"columns exchanged, cells known", [](IvCurve* c) { std::swap(c->voltage_V, c->current_A); }},
    {"columns exchanged, units named",
     [](IvCurve* c) {
       std::swap(c->voltage_V, c->current_A);
       c->cells_known = false;
       c->conditions.cells_in_series = 1;
     }},
    {"too many cells", [](IvCurve* c) { c->conditions.cells_in_series = 600; }},
    {"too few cells", [](IvCurve* c) { c->conditions.cells_in_series = 10; }},
    {"cells not stated",
     [](IvCurve* c) {
       c->conditions.cells_in_series = 1;
       c->cells_known = false;
     }},
    {"a cell in millivolt without a unit",
     [](IvCurve* c) {
       c->conditions.cells_in_series = 1;
       c->cells_known = c->voltage_unit_known = false;
       for (double& v : c->voltage_V) v *= 1e3 / 60;
     }},
    {"one stated cell with the voltage of two junctions",
     [](IvCurve* c) {
       c->conditions.cells_in_series = 1;
       ScaleVoc(1.73, c);
     }},
    {"cells not stated, and the voltage of two junctions",
     [](IvCurve* c) {
       c->conditions.cells_in_series = 1;
       c->cells_known = false;
       ScaleVoc(1.73, c);
     }},
    {"cells not stated, and a sweep that ends before open circuit",
     [](IvCurve* c) {
       c->conditions.cells_in_series = 1;
       c->cells_known = false;
       while (c->current_A.back() < 0.3 * c->current_A.front()) {
         c->current_A.pop_back();
         c->voltage_V.pop_back();
       }
     }},
};

std::string Spoilt(const std::string& what) {
  IvCurve curve = SyntheticModule();
  kSpoilt.at(what)(&curve);
  std::string told;
  for (const ReadingFinding& finding : CheckReadings(curve)) {
    told += (told.empty() ? "" : "; ") + finding.id + (finding.refuse ? " refused: " : ": ") +
            finding.sentence;
  }
  return told;
}

// Magnitudes of a curve, as in "isc 9, light 800".
const std::map<std::string, std::function<void(double, IvCurve*)>> kMagnitudes = {
    {"isc",
     [](double isc_A, IvCurve* c) {
       for (double& i : c->current_A) i *= isc_A;
     }},
    {"cells", [](double n, IvCurve* c) { c->conditions.cells_in_series = static_cast<int>(n); }},
    {"strings",
     [](double n, IvCurve* c) { c->conditions.strings_in_parallel = static_cast<int>(n); }},
    {"light", [](double light, IvCurve* c) { c->conditions.irradiance_W_m2 = light; }},
    {"celsius", [](double t, IvCurve* c) { c->conditions.cell_temperature_K = 273.15 + t; }},
    {"area", [](double cm2, IvCurve* c) { c->notes.area_cm2 = cm2; }},
    {"light known", [](double known, IvCurve* c) { c->irradiance_known = known != 0; }},
    {"cells known", [](double known, IvCurve* c) { c->cells_known = known != 0; }}};

// Why the results of a curve would be unreliable: "KIND: MAGNITUDE NUMBER, ...", with "rated W" for the
// rated power. A module has 60 cells and an Isc of 1 A at 800 W/m2.
std::string Implausible(const std::string& what) {
  const std::string kind = what.substr(0, what.find(':'));
  IvCurve curve = SyntheticCell();
  if (kind != "cell") {
    curve.conditions.cells_in_series = 60;
    curve.conditions.irradiance_W_m2 = 800;
    curve.voltage_V = {0, 10, 20, 30, 36};
    curve.current_A = {1.0, 0.99, 0.98, 0.8, 0.0};
  }
  if (kind == "rectangle") {
    curve.voltage_V = {0, 10, 20, 35, 36, 37};
    curve.current_A = {1, 1, 1, 1, 1, -0.1};
  } else if (kind == "hollow") {
    curve.voltage_V = {0, 1, 2, 3, 4, 30};
    curve.current_A = {1, 0.5, 0.25, 0.125, 0.05, -0.001};
  }
  std::optional<double> rated_W;
  for (std::size_t at = what.find(':'); at != std::string::npos;) {
    const std::size_t next = what.find(',', at + 1);
    const std::string one = what.substr(at + 2, next == std::string::npos ? next : next - at - 2);
    const std::size_t space = one.rfind(' ');
    const double value = std::stod(one.substr(space + 1));
    if (one.rfind("rated ", 0) == 0) {
      rated_W = value;
    } else {
      kMagnitudes.at(one.substr(0, space))(value, &curve);
    }
    at = next;
  }
  return PlausibilityProblem(curve, rated_W).value_or("");
}

TEST(CheckReadingsTest, NamesWhatCannotBeAndSaysWhatToDo) {
  CheckCases("curve_readings",
             {{"module that is spoilt", Spoilt}, {"implausible magnitudes", Implausible}});
}

TEST(CheckReadingsTest, OverflowsAreNamedByTheirReadings) {
  IvCurve curve = SyntheticModule();
  for (const int k : {3, 17}) curve.current_A[k] = 1e38;
  const auto findings = CheckReadings(curve);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_THAT(findings[0].points, ElementsAre(3, 17));
}

TEST(CheckReadingsTest, ACellInDimLightMayHaveLittleVoltage) {
  IvCurve curve = SyntheticCell(1e-5);
  for (double& voltage : curve.voltage_V) voltage /= 4;
  curve.conditions.irradiance_W_m2 = 10;
  EXPECT_THAT(CheckReadings(curve), IsEmpty());
}

TEST(CheckReadingsTest, ManyAmperesAreTakenWhereTheUnitIsNamedOrStringsShareThem) {
  IvCurve curve = SyntheticModule();
  for (double& current : curve.current_A) current *= 100;
  ASSERT_EQ(CheckReadings(curve).size(), 1U);
  EXPECT_EQ(CheckReadings(curve)[0].id, "current");
  EXPECT_FALSE(CheckReadings(curve)[0].refuse) << "taken, with a doubt";
  curve.current_unit_known = false;
  EXPECT_THAT(CheckReadings(curve), Not(IsEmpty()));
  curve.conditions.strings_in_parallel = 40;
  EXPECT_THAT(CheckReadings(curve), IsEmpty());
}

TEST(CheckReadingsTest, CoarseInstrumentsHaveNoLimit) {
  for (const double step : {0.01, 0.02, 0.1, 0.2}) {
    SCOPED_TRACE(step);
    IvCurve curve = SyntheticModule();
    for (double& current : curve.current_A) current = std::round(current / step) * step;
    EXPECT_THAT(CheckReadings(curve), IsEmpty());
    for (double& voltage : curve.voltage_V) voltage = std::round(voltage / 0.8) * 0.8;
    EXPECT_THAT(CheckReadings(curve), IsEmpty());
  }
}

TEST(JudgeReadingsTest, RefusesWithTheFileAndTheWayOut) {
  IvCurve curve = SyntheticModule();
  curve.source = "roof.csv";
  curve.conditions.cells_in_series = 600;
  const auto judged = JudgeReadings(curve);
  ASSERT_FALSE(judged);
  EXPECT_EQ(judged.error().file, "roof.csv");
  EXPECT_THAT(judged.error().message, HasSubstr("--as-is"));
}

TEST(JudgeReadingsTest, AsIsTurnsARefusalIntoADoubt) {
  IvCurve curve = SyntheticModule();
  curve.conditions.cells_in_series = 600;
  EXPECT_FALSE(JudgeReadings(curve));
  curve.as_is = true;
  const auto judged = JudgeReadings(curve);
  ASSERT_TRUE(judged);
  EXPECT_THAT(*judged, ElementsAre(HasSubstr("600 stated cells")));
}

TEST(JudgeReadingsTest, OverflowsAndDeadChannelsAreNeverTaken) {
  IvCurve overflow = SyntheticModule();
  overflow.as_is = true;
  IvCurve dead = overflow;
  overflow.current_A[5] = 1e308;
  dead.current_A.assign(100, 0);
  for (const IvCurve& curve : {overflow, dead}) {
    const auto judged = JudgeReadings(curve);
    ASSERT_FALSE(judged);
    EXPECT_THAT(judged.error().message, Not(HasSubstr("--as-is")));
  }
}

TEST(JudgeReadingsTest, ADoubtAboutManyCurvesIsSaidOnce) {
  std::vector<IvCurve> curves(4, SyntheticModule());
  for (std::size_t c = 0; c < curves.size(); ++c) {
    curves[c].name = std::to_string(c);
    curves[c].cells_known = c == 0;
    if (c > 0) curves[c].conditions.cells_in_series = 1;
  }
  const auto judged = JudgeReadings(curves);
  ASSERT_TRUE(judged);
  EXPECT_THAT(*judged,
              ElementsAre(::testing::AllOf(HasSubstr("curve 1: Voc"), HasSubstr("for 2 more"))));
  curves[3].current_A.assign(100, 0);
  EXPECT_THAT(MessageOf(JudgeReadings(curves)), HasSubstr("curve 3: all 100 currents are 0"));
}

}  // namespace
}  // namespace lyrefit
