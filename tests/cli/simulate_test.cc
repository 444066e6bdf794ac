#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "run_app.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kParameters =
    "simulate --set Iph=8.2 --set Is1=2e-9 --set n1=1.15 --set Rs=0.25 --set Rsh=300 ";
const std::string kDevice = kParameters + "--cells 60 --temperature-C 45 ";

std::vector<double> Currents(const std::string& table) {
  std::istringstream lines(table);
  std::vector<double> currents;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) currents.push_back(std::stod(line.substr(line.find(',') + 1)));
  return currents;
}

std::int64_t Lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

TEST(Simulate, WritesATableOnStandardOutput) {
  const AppResult result = RunApp(kDevice);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("voltage_V,current_A\n0,8.19"));
  EXPECT_EQ(Lines(result.out), 101);
  EXPECT_THAT(result.out.substr(result.out.rfind(',')), StartsWith(",-"));  // beyond open circuit
}

TEST(Simulate, TakesTheVoltagesAskedFor) {
  const AppResult result = RunApp(kDevice + "--voltages -1:1:3");
  EXPECT_THAT(result.out, HasSubstr("\n-1,"));
  EXPECT_THAT(result.out, HasSubstr("\n1,"));
  EXPECT_EQ(Lines(result.out), 4);
  EXPECT_EQ(Lines(RunApp(kDevice + "--points 17").out), 18);
}

TEST(Simulate, ThenFitRecoversTheParameters) {
  const TempFolder folder;
  const std::string curve = folder.Path("module.csv");
  const AppResult made = RunApp(kDevice + "--out " + curve);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.out, "");
  const json j = FitJson(curve);
  EXPECT_EQ(j["curve"]["conditions"]["cells_in_series"], 60);
  EXPECT_EQ(j["curve"]["conditions"]["cell_temperature_C"], 45);
  EXPECT_EQ(j["curve"]["assumptions"].size(), 0U);
  const json& p = j["parameters"];
  EXPECT_NEAR(p["photocurrent"]["refined"].get<double>(), 8.2, 1e-6);
  EXPECT_NEAR(p["saturation_current"]["refined"].get<double>(), 2e-9, 1e-14);
  EXPECT_NEAR(p["n"]["refined"].get<double>(), 1.15, 1e-6);
  EXPECT_NEAR(p["resistance_series"]["refined"].get<double>(), 0.25, 1e-6);
  EXPECT_NEAR(p["resistance_shunt"]["refined"].get<double>(), 300, 1e-3);
}

TEST(Simulate, LaysOutTheCellsOfAFile) {
  const TempFolder folder;
  const std::string file = folder.Write("layout.json", R"({"bypass_diode": {"voltage_V": 0.5},
      "strings": [[{"times": 2, "cells": [{"count": 20}]},
                   {"bypass": true, "cells": [{"count": 20, "light": 0.7}]}]]})");
  const std::string at = "--temperature-C 45 --voltages 0:36:10 ";
  const AppResult laid = RunApp(kParameters + at + "--string " + file);
  ASSERT_EQ(laid.exit_code, 0) << laid.err;
  const AppResult shaded =
      RunApp(kParameters + at + "--cells 60 --with shading:d=0.3,w=0.3333333333333333,Vb=0.5");
  ASSERT_EQ(Lines(laid.out), 11);
  const std::vector<double> a = Currents(laid.out), b = Currents(shaded.out);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-6) << k;

  const AppResult other = RunApp(kParameters + "--cells 72 --string " + file);
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.err, HasSubstr("laid out of 60 cells in series, the device has 72"));
  const AppResult twice = RunApp(kDevice + "--with shading:d=0.1 --string " + file);
  EXPECT_THAT(twice.err, HasSubstr("shading: divides the cells, which are laid out already"));
}

TEST(Simulate, NoiseFollowsTheSeed) {
  const std::string noisy = kDevice + "--noise-A 0.01 --noise-relative 0.001 ";
  EXPECT_EQ(RunApp(noisy + "--seed 1").out, RunApp(noisy + "--seed 1").out);
  EXPECT_NE(RunApp(noisy + "--seed 1").out, RunApp(noisy + "--seed 2").out);
  EXPECT_NE(RunApp(noisy).out, RunApp(kDevice).out);
}

TEST(Simulate, IntervalsOfNoisyCurvesHoldTheTruth) {
  const TempFolder folder;
  const std::string curve = folder.Path("noisy.csv");
  ASSERT_EQ(RunApp(kDevice + "--noise-A 0.005 --seed 3 --out " + curve).exit_code, 0);
  const json p = FitJson(curve)["parameters"]["resistance_series"];
  // Three times the distance to each end, so that a miss indicates a defect and not chance.
  const double refined = p["refined"];
  EXPECT_LT(refined - 3 * (refined - p["low_95"].get<double>()), 0.25);
  EXPECT_GT(refined + 3 * (p["high_95"].get<double>() - refined), 0.25);
}

TEST(Simulate, RedrawsTheModelOfAFit) {
  const TempFolder folder;
  const std::string fit = folder.Path("fit.json");
  ASSERT_EQ(RunApp("fit " + DataFolder("rtc_france") + " --quiet --json " + fit).exit_code, 0);
  const AppResult redrawn = RunApp("simulate --from " + fit + " --voltages 0.59:-0.2057:2");
  EXPECT_EQ(redrawn.exit_code, 0) << redrawn.err;
  const json j = json::parse(FileText(fit));
  const std::string last = redrawn.out.substr(redrawn.out.rfind(',') + 1);
  EXPECT_NEAR(std::stod(last), j["data"]["model_current_A"][0].get<double>(), 1e-12);
}

TEST(Simulate, RedrawsAFitWithoutPolish) {
  const TempFolder folder;
  const std::string fit = folder.Path("fit.json");
  const std::string flags = " --no-polish --quiet --json ";
  ASSERT_EQ(RunApp("fit " + DataFolder("rtc_france") + flags + fit).exit_code, 0);
  EXPECT_EQ(RunApp("simulate --from " + fit).exit_code, 0);
}

TEST(Simulate, TakesAModuleByItsLaw) {
  const TempFolder folder;
  const std::string from = "simulate --from '" + DataFolder("datasheet/invented.PAN") + "' ";
  const AppResult result =
      RunApp(from + "--irradiance-Wm2 800 --temperature-C 45 --voltages 0:37.0501844:2");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const std::vector<double> currents = Currents(result.out);  // of read_pan_reference.py
  ASSERT_EQ(currents.size(), 2U);
  EXPECT_NEAR(currents[0], 7.87001408, 1e-7);
  EXPECT_NEAR(currents[1], 0, 1e-6);
  const AppResult dimmed = RunApp(from + "--set Rs=0.5 --with shading:d=0.3,w=0.3333 --points 3");
  EXPECT_EQ(dimmed.exit_code, 0) << dimmed.err;
  const std::string library = DataFolder("datasheet/invented_cec.csv");
  EXPECT_EQ(RunApp("simulate --from '" + library + "#Invented I-304 M60'").exit_code, 0);
  const std::string text = FileText(DataFolder("datasheet/invented.PAN"));
  const AppResult warned = RunApp(
      "simulate --from " + folder.Write("m.PAN", std::string(text).replace(
                                                     text.find("RSerie=0.218"), 12, "RSerie=0.4")));
  EXPECT_EQ(warned.exit_code, 0);
  EXPECT_THAT(warned.err, StartsWith("lyrefit: The model of m.PAN gives "));
}

}  // namespace
}  // namespace lyrefit
