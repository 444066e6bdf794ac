// Readings that no device can give, in every verb that takes a curve.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "repeats.h"
#include "run_app.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kVerbs[] = {"fit", "diagnose", "certify", "compare"};

// Arguments of a short run of each verb.
std::string Quick(const std::string& verb) {
  if (verb == "fit") return "fit --intervals none ";
  if (verb == "diagnose") return "diagnose --no-held-out ";
  if (verb == "certify") return "certify --models sd --effort 200 ";
  return "compare --models sd --algorithms mlo --runs 2 ";
}

std::string Csv(const IvCurve& curve, const char* header = "V,I\n") {
  std::ostringstream text;
  text.precision(7);
  text << header;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    text << curve.voltage_V[k] << "," << curve.current_A[k] << "\n";
  }
  return text.str();
}

IvCurve Changed(IvCurve curve, const std::function<void(double*, double*)>& change) {
  for (std::size_t k = 0; k < curve.size(); ++k) change(&curve.voltage_V[k], &curve.current_A[k]);
  return curve;
}

// Expects an error of one sentence that holds every text of `says`, and exit code 1.
void ExpectRefused(const std::string& content, const std::string& flags,
                   const std::vector<std::string>& says) {
  const TempFolder folder;
  const std::string file = folder.Write("curve.csv", content);
  for (const std::string verb : kVerbs) {
    SCOPED_TRACE(verb);
    const AppResult result = RunApp(Quick(verb) + file + " " + flags);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, StartsWith("lyrefit: "));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    for (const std::string& text : says) EXPECT_THAT(result.err, HasSubstr(text));
  }
}

// Expects a result with the warning `says` at its top, in the text and in the JSON.
void ExpectDoubted(const std::string& content, const std::string& flags, const std::string& says) {
  const TempFolder folder;
  const std::string file = folder.Write("curve.csv", content);
  for (const std::string verb : kVerbs) {
    SCOPED_TRACE(verb);
    const AppResult result = RunApp(Quick(verb) + file + " " + flags);
    EXPECT_THAT(result.exit_code, AnyOf(0, 2));
    EXPECT_THAT(result.out, AnyOf(StartsWith("DOUBTFUL: "), StartsWith("NOT USABLE: ")));
    std::string text = result.out;
    std::replace(text.begin(), text.end(), '\n', ' ');
    EXPECT_THAT(text.substr(0, 800), HasSubstr(says));
    const AppResult json = RunApp(Quick(verb) + file + " " + flags + " --json -");
    const auto document = nlohmann::json::parse(json.out, nullptr, false);
    ASSERT_TRUE(document.is_object());
    EXPECT_THAT(document["warnings"].dump(), HasSubstr(says));
  }
}

TEST(Implausible, OverflowCodes) {
  for (const double code : {9.9e37, 9.91e37, 1e38, 1e300, 1e308}) {
    IvCurve curve = SyntheticModule();
    curve.current_A[5] = code;
    ExpectRefused(Csv(curve), "--cells 60", {"reading 6", "overflow", "--skip-missing"});
  }
}

TEST(Implausible, UnitsNobodyNamed) {
  const IvCurve in_mA = Changed(SyntheticModule(), [](double*, double* i) { *i *= 1e3; });
  ExpectRefused(Csv(in_mA), "--cells 60", {"milliampere?", "--current-unit mA"});
  ExpectRefused(Csv(in_mA, ""), "--cells 60", {"milliampere?"});
  const TempFolder folder;
  const AppResult named = RunApp("fit --intervals none --cells 60 " +
                                 folder.Write("curve.csv", Csv(in_mA, "V,I (mA)\n")));
  EXPECT_EQ(named.exit_code, 0) << named.err;
}

TEST(Implausible, CellsThatCannotBe) {
  ExpectRefused(Csv(SyntheticCell()), "--cells 60", {"each of 60 stated cells", "give --cells 1?"});
  ExpectRefused(Csv(SyntheticModule()), "--cells 10",
                {"each of 10 stated cells", "give --cells 60?"});
}

TEST(Implausible, CellsNobodyCounted) {
  const TempFolder folder;
  const AppResult fit = RunApp("fit " + folder.Write("curve.csv", Csv(SyntheticModule())));
  EXPECT_EQ(fit.exit_code, 0) << fit.err;
  EXPECT_THAT(fit.out, StartsWith("DOUBTFUL: Voc is 38"));
  EXPECT_THAT(fit.out, HasSubstr("some 60 cells in series?"));
  EXPECT_THAT(fit.out, HasSubstr("n is then the ideality of the whole module"));
}

TEST(Implausible, LimitsOfTheInstrument) {
  SKIP_IF_SANITIZED();
  const IvCurve forward =
      Changed(SyntheticCell(), [](double*, double* i) { *i = std::max(*i, -0.05); });
  ExpectDoubted(Csv(forward), "--cells 1", "exactly the same current -0.05 A");
}

TEST(Implausible, AsIsTakesThem) {
  ExpectRefused(Csv(SyntheticModule()), "--cells 20", {"(--as-is takes the readings as they are)"});
  IvCurve overflow = SyntheticModule();
  overflow.current_A[5] = 1e308;
  ExpectRefused(Csv(overflow), "--cells 60 --as-is", {"overflow"});
  const TempFolder folder;
  const std::string file = folder.Write("curve.csv", Csv(SyntheticModule()));
  const AppResult fit = RunApp("fit --cells 20 --as-is " + file);
  EXPECT_THAT(fit.exit_code, AnyOf(0, 2)) << fit.err;
  EXPECT_THAT(fit.out, HasSubstr("DOUBTFUL: Voc is 38"));
  EXPECT_THAT(fit.out, HasSubstr("each of 20 stated"));
}

TEST(Implausible, AStepIsTheFirstThingAFitSays) {
  const TempFolder folder;
  const std::string file = folder.Write("curve.csv", Csv(SyntheticModule(1, 1, 0.5)));
  const AppResult fit = RunApp("fit --intervals none --cells 60 " + file);
  EXPECT_EQ(fit.exit_code, 2);
  EXPECT_THAT(fit.out, StartsWith("NOT USABLE: the curve has a step near 2"));
  EXPECT_THAT(fit.out.substr(0, 200), HasSubstr("lyrefit diagnose"));
  const AppResult brief = RunApp("fit --intervals none --cells 60 --brief " + file);
  EXPECT_EQ(brief.exit_code, 2);
  EXPECT_THAT(brief.out, HasSubstr("NOT USABLE: the curve has a step near 2"));
  const AppResult json = RunApp("fit --intervals none --cells 60 --json - " + file);
  const auto report = nlohmann::json::parse(json.out, nullptr, false);
  ASSERT_TRUE(report.is_object());
  EXPECT_FALSE(report["usable"].get<bool>());
  EXPECT_THAT(report["not_usable_because"].get<std::string>(), HasSubstr("a step near 2"));
  EXPECT_THAT(report["warnings"][0].get<std::string>(), HasSubstr("a step near 2"));
}

TEST(Implausible, WhatIsNoCurveIsNotUsable) {
  IvCurve curve = SyntheticModule();
  for (std::size_t k = 0; k < curve.size(); ++k) {
    std::swap(curve.current_A[k], curve.current_A[k * 37 % curve.size()]);
  }
  const TempFolder folder;
  const AppResult fit =
      RunApp("fit --intervals none --cells 60 " + folder.Write("curve.csv", Csv(curve)));
  EXPECT_THAT(fit.exit_code, AnyOf(1, 2));
  if (fit.exit_code == 2) {
    EXPECT_THAT(fit.out, StartsWith("NOT USABLE: "));
  }
}

TEST(Implausible, AFamilyLeavesImplausibleCurvesOut) {
  std::string table = "curve,voltage_V,current_A,irradiance_W_m2,temperature_C\n";
  for (int c = 0; c < 4; ++c) {
    const double light = 0.4 + 0.2 * c;
    const IvCurve curve = SyntheticModule(light, light, light, 40);
    for (std::size_t k = 0; k < curve.size(); ++k) {
      const double current = c == 2 ? 0 : curve.current_A[k];
      table += std::to_string(c) + "," + std::to_string(curve.voltage_V[k]) + "," +
               std::to_string(current) + "," + std::to_string(1000 * light) + ",25\n";
    }
  }
  const TempFolder folder;
  const std::string file = folder.Write("set.csv", table);
  const AppResult joint = RunApp("fit --family desoto --cells 60 " + file);
  EXPECT_EQ(joint.exit_code, 0) << joint.err;
  EXPECT_THAT(joint.out, HasSubstr("all 40 currents are 0"));
  const AppResult free = RunApp("fit --family free --cells 60 " + file);
  EXPECT_EQ(free.exit_code, 0) << free.err;
  EXPECT_THAT(free.out, HasSubstr("all 40 currents are 0"));
  const AppResult none = RunApp("fit --family desoto --cells 600 " + file);
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.err, HasSubstr("each of 600 stated cells"));
}

}  // namespace
}  // namespace lyrefit
