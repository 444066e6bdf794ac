#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "repeats.h"
#include "run_app.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

void ExpectRefused(const std::string& arguments, const std::string& complaint) {
  const AppResult result = RunApp("fit " + arguments);
  EXPECT_EQ(result.exit_code, 1) << arguments;
  EXPECT_EQ(result.out, "") << arguments;
  EXPECT_THAT(result.err, StartsWith("lyrefit: "));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_THAT(result.err, HasSubstr(complaint)) << arguments;
}

// The parameters of a small module.
struct Truth {
  double photocurrent = 5.0;
  double saturation_current = 1.2e-9;
  double n = 1.08;
  double resistance_series = 0.25;
  double resistance_shunt = 300;
  double alpha = 0.0025;
};

// A folder of six curves of the module above by De Soto's law, written by `lyrefit simulate`, each
// with its sidecar.
class FamilyVerbOnASet : public ::testing::Test {
 protected:
  void SetUp() override {
    const double conditions[][2] = {{1000, 25}, {1000, 50}, {700, 25},
                                    {700, 60},  {400, 25},  {250, 40}};
    int number = 0;
    for (const auto& [irradiance, temperature_C] : conditions) {
      Simulate(++number, irradiance, temperature_C);
    }
  }

  void Simulate(int number, double irradiance, double temperature_C) const {
    const Truth truth;
    const double k = 8.617333262e-5, reference = 298.15;
    const double kelvin = temperature_C + 273.15;
    const double gap = 1.121 * (1 - 0.0002677 * (kelvin - reference));
    const double saturation = truth.saturation_current * std::pow(kelvin / reference, 3) *
                              std::exp(1.121 / (k * reference) - gap / (k * kelvin));
    const double light =
        irradiance / 1000 * (truth.photocurrent + truth.alpha * (kelvin - reference));
    std::ostringstream arguments;
    arguments.precision(15);
    arguments << "simulate --set Iph=" << light << " --set Is1=" << saturation
              << " --set n1=" << truth.n << " --set Rs=" << truth.resistance_series
              << " --set Rsh=" << truth.resistance_shunt * 1000 / irradiance
              << " --cells 36 --points 30 --noise-A 0.001 --seed " << number << " --temperature-C "
              << temperature_C << " --irradiance-Wm2 " << irradiance << " --out '"
              << folder_.Path("set/c" + std::to_string(number) + ".csv") << "'";
    std::filesystem::create_directories(folder_.Path("set"));
    const AppResult result = RunApp(arguments.str());
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }

  std::string Set() const { return "'" + folder_.Path("set") + "'"; }

  TempFolder folder_;
};

// Options of a short run, for tests of other results.
const std::string kQuickFamily = " --folds 0 --no-individual-fits --iterations 20 --population 15";

TEST_F(FamilyVerbOnASet, FindsTheDeviceBehindTheCurves) {
  const json j = FitJson(Set() + " --family desoto");
  const Truth truth;
  EXPECT_EQ(j["family"], "desoto");
  EXPECT_EQ(j["cells_in_series"], 36);
  EXPECT_EQ(j["curves"].size(), 6U);
  const json& p = j["parameters"];
  EXPECT_NEAR(p["I_L_ref"]["refined"].get<double>(), truth.photocurrent, 0.005);
  EXPECT_NEAR(p["n"]["refined"].get<double>(), truth.n, 0.01);
  EXPECT_NEAR(p["R_s"]["refined"].get<double>(), truth.resistance_series, 0.01);
  EXPECT_NEAR(p["alpha_sc"]["refined"].get<double>(), truth.alpha, 3e-4);
  EXPECT_NEAR(j["rmse"]["refined"]["solved_current_A"].get<double>(), 1e-3, 2e-4);
  EXPECT_EQ(j["usable"], true);
}

TEST_F(FamilyVerbOnASet, PrintsTheReportAndWritesEveryFile) {
  const std::string csv = folder_.Path("free.csv"), pvlib = folder_.Path("pvlib.json");
  const std::string picture = folder_.Path("set.svg");
  const AppResult result = RunApp("fit " + Set() + " --family desoto --folds 0 --csv '" + csv +
                                  "' --pvlib '" + pvlib + "' --plot '" + picture + "'");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("by the law of De Soto"));
  EXPECT_THAT(result.out, HasSubstr("Shared parameters"));
  const std::string rows = FileText(csv);
  EXPECT_THAT(rows, StartsWith("Index,photocurrent,saturation_current,"));
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 7);
  EXPECT_TRUE(json::accept(FileText(pvlib)));
  EXPECT_THAT(FileText(pvlib), HasSubstr("I_L_ref"));
  EXPECT_THAT(FileText(picture), HasSubstr("</svg>"));
}

TEST_F(FamilyVerbOnASet, TestsParametersFromElsewhereOnTheSameCurves) {
  SKIP_IF_SANITIZED();
  const std::string own = folder_.Path("own.json");
  const std::string other = folder_.Write(
      "other.json",
      R"({"a_ref": 1.0, "I_L_ref": 5.05, "I_o_ref": 1.2e-9, "R_s": 0.25, "R_sh_ref": 300,
          "alpha_sc": 0.0025})");
  const std::string flags = " --family desoto" + kQuickFamily;
  ASSERT_EQ(RunApp("fit " + Set() + flags + " --pvlib '" + own + "'").exit_code, 0);
  const std::string against = flags + " --against '" + own + "' --against '" + other + "'";
  const json j = FitJson(Set() + against);
  ASSERT_EQ(j["against"].size(), 2U);
  EXPECT_EQ(j["against"][0]["name"], "own.json");
  EXPECT_EQ(j["against"][0]["curves"], 6);
  EXPECT_NEAR(j["against"][0]["rmse"]["solved_current_A"].get<double>(),
              j["in_sample"]["rmse"]["solved_current_A"].get<double>(), 1e-8);
  EXPECT_GT(j["against"][1]["rmse"]["solved_current_A"].get<double>(), 0.02);
  const AppResult text = RunApp("fit " + Set() + " --against '" + other +
                                "' --family auto --fit-curves 4 --iterations 20 --population 15");
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("2 curves that were not fitted"));
  EXPECT_THAT(text.out, HasSubstr("other.json"));
  EXPECT_THAT(text.out, HasSubstr("each curve on its own"));
}

TEST_F(FamilyVerbOnASet, RefusesParametersOfAnotherModule) {
  const std::string text =
      R"({"a_ref": 1.0, "I_L_ref": 5, "I_o_ref": 1e-9, "R_s": 0.2, "R_sh_ref": 300,
          "alpha_sc": 0.002, "cells_in_series": 60})";
  const std::string other = folder_.Write("other.json", text);
  ExpectRefused(Set() + " --family desoto --against '" + other + "'",
                "other.json: expected the cells_in_series of the set, 36, found 60");
  ExpectRefused(Set() + " --family desoto --against '" + folder_.Path("none.json") + "'",
                "none.json");
  const std::string bad = folder_.Write("bad.json", "{\"a_ref\": 1, \"I_L_ref\": \"x\"}");
  ExpectRefused(Set() + " --family desoto --against '" + bad + "'", "bad.json:1:14: expected");
  ExpectRefused(Set() + " --family free --against '" + bad + "'",
                "--against is about what curves share");
}

TEST_F(FamilyVerbOnASet, WritesAPanFileThatItReadsBack) {
  const std::string pan = folder_.Path("module.PAN"), fit = " --family pvsyst --fix EgRef=1.12";
  const AppResult made =
      RunApp("fit " + Set() + fit + " --quiet --pan '" + pan + "'" + kQuickFamily);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(FileText(pan), StartsWith("PVObject_=pvModule\r\n"));
  const json j = FitJson(Set() + fit + " --against '" + pan + "'" + kQuickFamily);
  EXPECT_EQ(j["against"][0]["name"], "module.PAN");
  EXPECT_NEAR(j["against"][0]["rmse"]["solved_current_A"].get<double>(),
              j["rmse"]["refined"]["solved_current_A"].get<double>(), 1e-9);
  ExpectRefused(Set() + " --family desoto --pan x.PAN", "--pan: a PAN file takes the law pvsyst");
  ExpectRefused(Set() + fit + " --model dd --pan x.PAN", "--pan: a PAN file has one diode");
  ExpectRefused(Set() + " --family free --pan x.PAN", "--pan is about what curves share");
}

TEST_F(FamilyVerbOnASet, WritesAPanFileWithTheGapOfItsTechnology) {
  const std::string pan = folder_.Path("module.PAN");
  const AppResult made =
      RunApp("fit " + Set() + " --family pvsyst --json - --pan '" + pan + "'" + kQuickFamily);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(json::parse(made.out)["parameters"]["EgRef"]["refined"], 1.12);
}

TEST_F(FamilyVerbOnASet, WritesARowOfSamThatItReadsBack) {
  const std::string sam = folder_.Path("module.csv");
  const AppResult made =
      RunApp("fit " + Set() + " --family cec --quiet --sam '" + sam + "'" + kQuickFamily);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const json j = FitJson(Set() + " --family cec --against '" + sam + "'" + kQuickFamily);
  EXPECT_EQ(j["family"], "cec");
  EXPECT_NEAR(j["against"][0]["rmse"]["solved_current_A"].get<double>(),
              j["rmse"]["refined"]["solved_current_A"].get<double>(), 1e-9);
  ExpectRefused(Set() + " --family pvsyst --sam x.csv", "--sam: SAM's modules follow the law cec");
  ExpectRefused(Set() + " --family free --sam x.csv", "--sam is about what curves share");
}

TEST_F(FamilyVerbOnASet, FitsAMatrixOfKeyPoints) {
  const std::string matrix = std::string(LYREFIT_DATA_DIR) + "/formats/matrix_long.csv";
  const json j = FitJson("'" + matrix + "' --cells 60 --family desoto" + kQuickFamily);
  EXPECT_EQ(j["residuals"], "key-points");
  EXPECT_EQ(j["weights"], "auto");
  EXPECT_NEAR(j["parameters"]["n"]["refined"].get<double>(), 1.1, 1e-3);
  EXPECT_LT(j["key_points"]["rms"]["max_power_of_reference"].get<double>(), 1e-4);
  EXPECT_NEAR(j["curves"][3]["key_points"]["measured"]["max_power_W"].get<double>(), 249.27, 0.01);
  EXPECT_EQ(j["equal_devices"], nullptr);
  const AppResult text =
      RunApp("fit '" + matrix + "' -v --cells 60 --family pvsyst" + kQuickFamily);
  EXPECT_THAT(text.out, HasSubstr("Key points, model less measured (%)"));
  EXPECT_THAT(text.out, HasSubstr("key points (Isc, Voc, Vmp, Pmp); search: solved-current"));
}

// A matrix under these names of Isc, Voc, Imp and Vmp.
std::string MatrixText(const std::string& names, const std::string& imp_of_800 = "6.3376") {
  return "temp_cell,effective_irradiance," + names +
         "\n15,200,1.6947,37.096,1.5666,31.742\n15,500,4.2247,38.699,3.9298,32.562\n15,1000,8.4442,"
         "39.993,7.9205,32.587\n"
         "25,200,1.6988,35.895,1.5676,30.435\n25,500,4.2486,37.475,3.9489,31.295\n"
         "25,800,6.7936,38.35," +
         imp_of_800 +
         ",31.414\n25,1000,8.49,38.695,7.9447,31.36\n50,500,4.2955,34.421,3.9539,28.124\n50,1000,8."
         "599,35.689,7.9438,28.315\n"
         "75,500,4.3342,31.266,3.9546,24.931\n75,1000,8.6937,32.631,7.9299,25.208\n";
}

TEST_F(FamilyVerbOnASet, NamesWrongCellsAndExchangedColumnsOfAMatrix) {
  const std::string names = "i_sc,v_oc,i_mp,v_mp", fit = "' --cells 60 --family pvsyst";
  const std::string wrong = folder_.Write("wrong.csv", MatrixText(names, "6.971"));
  const json j = FitJson("'" + wrong + fit + kQuickFamily);
  ASSERT_EQ(j["without_outliers"]["cells"].size(), 1U);
  EXPECT_EQ(j["without_outliers"]["cells"][0]["point"], "Imp");
  EXPECT_EQ(j["without_outliers"]["cells"][0]["id"], "800 W/m2, 25 C");
  EXPECT_NEAR(j["without_outliers"]["cells"][0]["expected"].get<double>(), 6.338, 0.1);
  EXPECT_TRUE(j["curves"][5]["outlier"]);
  EXPECT_THAT(j.dump(), HasSubstr("Imp 6.971 A is above Isc 6.794 A"));
  const json left = FitJson("'" + wrong + fit + " --leave-out '800 W/m2, 25 C'" + kQuickFamily);
  EXPECT_EQ(left["without_outliers"], nullptr);
  EXPECT_EQ(left["curves"][5]["role"], "left-out");
  const std::string exchanged = folder_.Write("exchanged.csv", MatrixText("i_sc,v_oc,v_mp,i_mp"));
  ExpectRefused("'" + exchanged + fit, "exchanged.csv:1: Imp and Vmp look exchanged");
  const std::string dashed = folder_.Write("dashed.csv", MatrixText(names, "-"));
  ExpectRefused("'" + dashed + fit, "--skip-missing takes a dash as a missing value");
  EXPECT_EQ(FitJson("'" + dashed + fit + " --skip-missing" + kQuickFamily)["curves"].size(), 11U);
}

TEST_F(FamilyVerbOnASet, WritesAPanFileOfAnAmorphousTandem) {
  const std::string matrix = folder_.Write("film.csv", MatrixText("i_sc,v_oc,i_mp,v_mp"));
  folder_.Write("film.json",
                R"({"cells_in_series": 60, "technology": "Amorphous silicon tandem junction"})");
  const std::string pan = folder_.Path("film.PAN");
  const AppResult made =
      RunApp("fit '" + matrix + "' --family pvsyst --json - --pan '" + pan + "'" + kQuickFamily);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(json::parse(made.out)["parameters"]["EgRef"]["refined"], 3.4);
  EXPECT_THAT(FileText(pan), HasSubstr("Technol=mtaSiH_Tandem"));
}

TEST_F(FamilyVerbOnASet, FitsEveryCurveOnItsOwn) {
  const json j = FitJson(Set() + " --family free");
  EXPECT_EQ(j["family"], "free");
  ASSERT_EQ(j["curves"].size(), 6U);
  for (const json& curve : j["curves"]) {
    EXPECT_NEAR(curve["individual_rmse"]["solved_current_A"].get<double>(), 1e-3, 4e-4);
    EXPECT_EQ(curve["individual_parameters"].size(), 5U);
  }
  const AppResult text = RunApp("fit " + Set() + " --family free");
  EXPECT_THAT(text.out, HasSubstr("Curves, each fitted on its own"));
}

TEST_F(FamilyVerbOnASet, LeavesOutHoldsAndFrees) {
  const json j = FitJson(Set() + " --family desoto --leave-out c2,c5 --fix n=1.08 --free dEgdT" +
                         kQuickFamily);
  int left_out = 0;
  for (const json& curve : j["curves"]) left_out += curve["role"] == "left-out";
  EXPECT_EQ(left_out, 2);
  EXPECT_EQ(j["parameters"]["n"]["fixed"], true);
  EXPECT_EQ(j["parameters"]["dEgdT"]["fixed"], false);
  const AppResult unknown = RunApp("fit " + Set() + " --family desoto --leave-out c77");
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("c77"));
}

TEST_F(FamilyVerbOnASet, GivesTheSameTwice) {
  json first = FitJson(Set() + " --family pvsyst --seed 7 --threads 1" + kQuickFamily);
  json second = FitJson(Set() + " --family pvsyst --seed 7 --threads 2" + kQuickFamily);
  for (json* j : {&first, &second}) {
    RemoveSeconds(j);
    j->erase("options");
  }
  EXPECT_EQ(first, second);
}

TEST_F(FamilyVerbOnASet, IsBriefOnRequest) {
  const AppResult result = RunApp("fit " + Set() + " --family desoto --brief" + kQuickFamily);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("set: desoto sd, 6 fitted"));
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1);
}

TEST_F(FamilyVerbOnASet, IsNamedWhereOneCurveWasExpected) {
  ExpectRefused(Set(),
                "this is a set of 6 curves: give one of its files, or fit all of them with "
                "--family desoto|pvsyst|free|auto");
  const std::string table = folder_.Write(
      "two.csv",
      "curve,voltage_V,current_A,irradiance_Wm2\n1,0,1,1000\n1,0.3,0.9,1000\n1,0.5,0.1,1000\n"
      "2,0,0.5,500\n2,0.3,0.45,500\n2,0.48,0.05,500\n");
  ExpectRefused("'" + table + "'", "this is a set of 2 curves: choose one with --curve INDEX, or");
}

}  // namespace
}  // namespace lyrefit
