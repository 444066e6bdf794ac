// Effects of the reading flags on files of data/formats.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "run_app.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

const std::string kFormats = std::string(LYREFIT_DATA_DIR) + "/formats/";
const std::string kQuickFit = " --brief --no-polish --intervals none --population 5 --iterations 2";

TEST(ReadingFlags, ChooseColumnsAndArea) {
  for (const char* line :
       {"wide.csv --column 2", "pairs.csv --column I2", "two_tables.csv --curve 1",
        "other_names.csv --voltage-column 2 --current-column Proud", "density.txt --area-cm2 4"}) {
    const AppResult result = RunApp("fit " + kFormats + line + kQuickFit);
    EXPECT_NE(result.exit_code, 1) << line << ": " << result.err;
    EXPECT_THAT(result.out, HasSubstr("RMSE")) << line;
  }
}

TEST(ReadingFlags, ColumnsAreListed) {
  const AppResult result = RunApp("fit --list-columns " + kFormats + "wide.csv");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, RunApp("inspect " + kFormats + "wide.csv").out);
  EXPECT_THAT(result.out, HasSubstr("  1  Voltage (V)    voltage    V "));
  EXPECT_THAT(result.out, HasSubstr("  3  Current 2 (A)  current 2  A "));
}

TEST(ReadingFlags, StandardInputIsRead) {
  for (const char* file : {"ec_lab.mpt", "utf16le.csv", "lists.json"}) {
    const AppResult result = RunApp("fit -" + kQuickFit, kFormats + file);
    EXPECT_NE(result.exit_code, 1) << file << ": " << result.err;
    EXPECT_THAT(result.out, HasSubstr("standard input: sd")) << file;
  }
}

// Every verb reads a pipe once and completely.
TEST(ReadingFlags, APipeIsReadAsItsFile) {
  const TempFolder folder;
  const std::string pipe = folder.Path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string table = FileText(DataFolder("rtc_france") + "/curve.csv");
  const std::string told = " --cells 1 --temperature-C 33 ";
  for (const std::string& verb :
       {"fit" + told + "--no-polish --intervals none", "certify" + told, "diagnose" + told,
        "translate" + told + "--irradiance-Wm2 1000 --draws 0",
        std::string("compare --runs 1 --population 5 --iterations 3 --temperature-C 33")}) {
    std::thread writer([&] { std::ofstream(pipe) << table; });
    const AppResult result = RunApp(verb + " " + pipe);
    writer.join();
    EXPECT_NE(result.exit_code, 1) << verb << ": " << result.err;
    EXPECT_NE(result.out, "") << verb;
  }
}

TEST(ReadingFlags, AReportInThePlaceOfTheSidecarIsUnderstood) {
  const TempFolder folder;
  const std::string curve = folder.Path("module.csv");
  std::filesystem::copy_file(kFormats + "plain.csv", curve);
  const std::string report = folder.Path("module.json");
  const std::string fit = "fit " + curve + " --cells 60 --temperature-C 47" + kQuickFit;
  ASSERT_NE(RunApp(fit + " --json " + report + " --force").exit_code, 1);
  const AppResult again = RunApp("fit -v " + curve + " --no-polish --intervals none");
  EXPECT_THAT(again.out, HasSubstr("module.json is a report of lyrefit, not a sidecar"));
  EXPECT_THAT(again.out, HasSubstr("60 cells"));
}

}  // namespace
}  // namespace lyrefit
