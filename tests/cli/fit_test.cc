#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "repeats.h"
#include "run_app.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(App, PrintsVersionAndHelp) {
  const AppResult version = RunApp("--version");
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, StartsWith("lyrefit "));
  for (const char* verb : {"", "fit ", "simulate "}) {
    const AppResult help = RunApp(std::string(verb) + "--help");
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_EQ(help.err, "");
    EXPECT_THAT(help.out, HasSubstr("Examples:"));
  }
}

TEST(Fit, PrintsTwoDozenLinesByDefaultAndTheWholeReportOnRequest) {
  const AppResult result = RunApp("fit " + kRtc);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_LE(std::count(result.out.begin(), result.out.end(), '\n'), 24);
  EXPECT_THAT(result.out, HasSubstr("solved-current *"));
  EXPECT_THAT(result.out, HasSubstr("7.730063e-04"));
  for (const char* whole : {" -v", " --verbose"}) {
    EXPECT_THAT(RunApp("fit " + kRtc + whole).out, HasSubstr("7.730062690e-04"));
  }
}

TEST(Fit, PrintsOneLineWithBrief) {
  const AppResult result = RunApp("fit " + kRtc + " --brief");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out.find('\n'), result.out.size() - 1);
}

TEST(Fit, PutsTheJsonAloneOnStandardOutput) {
  const TempFolder folder;
  const AppResult result =
      RunApp("fit " + kRtc + " --json - --plot " + folder.Path("fit.svg") + " --brief");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(json::accept(result.out));
  EXPECT_THAT(FileText(folder.Path("fit.svg")), HasSubstr("<svg"));
}

TEST(Fit, WritesJsonAndPictureIntoFiles) {
  const TempFolder folder;
  const AppResult result = RunApp("fit " + kRtc + " --quiet --json " + folder.Path("fit.json") +
                                  " --plot " + folder.Path("fit.png"));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(json::accept(FileText(folder.Path("fit.json"))));
  EXPECT_THAT(FileText(folder.Path("fit.png")), StartsWith("\x89PNG"));
}

TEST(Fit, TracesTheSearchToItsEnd) {
  const json j = FitJson(kRtc);
  ASSERT_EQ(j["search"]["trace"].size(), 21U);
  EXPECT_EQ(j["search"]["trace"].back()["best_A"], j["rmse"]["searched"]["solved_current_A"]);
  EXPECT_EQ(j["search"]["algorithm"], "mlo");
  EXPECT_EQ(j["objective"], "solved-current");
  EXPECT_EQ(j["bounds"], "physical");
}

TEST(Fit, NamesTheParametersOfThreeDiodes) {
  const json j = FitJson(kRtc + " --model td");
  std::set<std::string> names;
  for (const auto& [name, value] : j["parameters"].items()) names.insert(name);
  EXPECT_EQ(names, (std::set<std::string>{"photocurrent", "saturation_current",
                                          "saturation_current_2", "saturation_current_3", "n",
                                          "n_2", "n_3", "resistance_series", "resistance_shunt"}));
}

TEST(Fit, GoesByTheFlags) {
  const json j = FitJson(
      kRtc +
      " --model dd --objective measured-current --fix n2=2 --seed 5 "
      "--bound Rs=0:0.1 --bound Rsh=1:500 --bound Is=0:1e-4 --population 20 --iterations 30 "
      "--algorithm lo+mblss --constants literature --bounds literature "
      "--temperature-C 30 --cells 2 --irradiance-Wm2 800 --elites 2");
  EXPECT_EQ(j["model"], "dd");
  EXPECT_EQ(j["objective"], "measured-current");
  EXPECT_EQ(j["parameters"]["n_2"]["fixed"], true);
  EXPECT_EQ(j["parameters"]["n_2"]["refined"], 2);
  EXPECT_EQ(j["parameters"]["resistance_series"]["upper"], 0.1);
  EXPECT_EQ(j["parameters"]["resistance_shunt"]["upper"], 500);
  EXPECT_EQ(j["search"]["seed"], 5);
  EXPECT_EQ(j["search"]["population"], 20);
  EXPECT_EQ(j["search"]["algorithm"], "lo+mblss");
  EXPECT_EQ(j["constants"], "literature");
  EXPECT_EQ(j["bounds"], "literature");
  EXPECT_EQ(j["curve"]["conditions"]["cell_temperature_C"], 30);
  EXPECT_EQ(j["curve"]["conditions"]["cells_in_series"], 2);
  EXPECT_EQ(j["curve"]["conditions"]["irradiance_Wm2"], 800);
}

TEST(Fit, TakesABoundsFile) {
  const TempFolder folder;
  const std::string bounds = folder.Write(
      "my.json", R"({"Iph":[0,2],"Is":[0,5e-5],"n":[1,2],"Rs":[0,0.36],"Rsh":[0,1000]})");
  const json j = FitJson(kRtc + " --bounds " + bounds);
  EXPECT_EQ(j["parameters"]["resistance_series"]["upper"], 0.36);
}

TEST(Fit, AnswersWithTheSearchWithoutPolish) {
  const json j = FitJson(kRtc + " --no-polish");
  EXPECT_TRUE(j["parameters"]["n"]["refined"].is_null());
  EXPECT_TRUE(j["parameters"]["n"]["searched"].is_number());
  EXPECT_TRUE(j["rmse"]["refined"]["solved_current_A"].is_null());
  EXPECT_THAT(RunApp("fit " + kRtc + " --no-polish").out, HasSubstr("No polish was done"));
}

TEST(Fit, FlagsReplaceWhatTheReaderAssumed) {
  const TempFolder folder;
  const std::string curve = folder.Write("bare.csv", FileText(DataFolder("rtc_france/curve.csv")));
  const json nothing_said = FitJson(curve)["curve"];
  EXPECT_EQ(nothing_said["assumed"].dump(),
            R"(["cells_in_series","strings_in_parallel","cell_temperature_C","irradiance_Wm2"])");
  const std::string assumed = nothing_said["assumptions"].dump();
  EXPECT_THAT(assumed, HasSubstr("cells in series not given"));
  EXPECT_THAT(assumed, HasSubstr("temperature not given"));
  EXPECT_THAT(assumed, HasSubstr("irradiance not given"));
  const json told = FitJson(curve + " --cells 1 --temperature-C 33");
  EXPECT_EQ(told["curve"]["assumed"].dump(), R"(["strings_in_parallel","irradiance_Wm2"])");
  EXPECT_THAT(told["curve"]["assumptions"].dump(), Not(HasSubstr("cells in series")));
  EXPECT_THAT(told["curve"]["assumptions"].dump(), Not(HasSubstr("temperature")));
  EXPECT_THAT(told["curve"]["assumptions"].dump(), HasSubstr("irradiance not given"));
}

TEST(Fit, AutoChoosesOneDiodeForRtcFrance) {
  const json j = FitJson(kRtc + " --model auto");
  EXPECT_EQ(j["model"], "sd");
  EXPECT_EQ(j["model_choice"]["chosen"], "sd");
  EXPECT_EQ(j["model_choice"]["candidates"].size(), 3U);
  EXPECT_FALSE(j["model_choice"]["sentence"].get<std::string>().empty());
}

TEST(Fit, GivesTheSameBitsForTheSameSeedOnAnyNumberOfThreadsAndKernel) {
  SKIP_IF_SANITIZED();
  for (const char* model : {"sd", "dd", "auto"}) {
    const std::string arguments = kRtc + " --seed 11 --model " + model;
    json first = FitJson(arguments + " --threads 1");
    RemoveSeconds(&first);
    for (const char* other : {" --threads 1", " --threads 2", " --kernel portable"}) {
      json second = FitJson(arguments + other);
      RemoveSeconds(&second);
      EXPECT_EQ(first, second) << model << other << json::diff(first, second).dump();
    }
  }
}

TEST(Fit, WeighsByErrorsThatAreFoundOrStated) {
  const json plain = FitJson(kRtc);
  EXPECT_FALSE(plain["errors"]["weighed"]);
  EXPECT_EQ(plain["errors"]["kind"], "equal");
  const json field = FitJson(kRtc + " --noise field");
  EXPECT_GT(field["errors"]["path_of_isc"], 0);
  EXPECT_TRUE(field["errors"]["weighed"]);
  EXPECT_EQ(field["rmse"]["least_squares"], plain["rmse"]["refined"]);
  EXPECT_GT(field["rmse"]["refined"]["solved_current_A"],
            plain["rmse"]["refined"]["solved_current_A"]);
  const TempFolder folder;
  const std::string file = folder.Write(
      "errors.json", R"({"current_noise_A": 1e-3, "voltage_noise_V": 0, "path_of_isc": 2e-3})");
  const json stated = FitJson(kRtc + " --noise " + file);
  EXPECT_EQ(stated["errors"]["sizes"], "stated");
  EXPECT_EQ(stated["errors"]["path_of_isc"], 2e-3);
  const AppResult text = RunApp("fit -v " + kRtc + " --noise field");
  EXPECT_THAT(text.out, HasSubstr("its plain RMSE is not the lowest"));
}

TEST(Fit, EndsWith2WhereTheFitIsNotUsable) {
  // The search may only use an Iph far below the measured one.
  const AppResult result = RunApp(
      "fit " + kRtc + " --no-polish --population 4 --iterations 1 --bound Iph=0:0.01 --json -");
  EXPECT_EQ(result.exit_code, 2) << result.err;
  const json j = json::parse(result.out, nullptr, false);
  ASSERT_TRUE(j.is_object());
  EXPECT_EQ(j["usable"], false);
}

}  // namespace
}  // namespace lyrefit
