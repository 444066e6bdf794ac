#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "run_app.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// A measurement with its sidecar, and links that lead to it.
class NothingIsLost : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::copy_file(DataFolder("rtc_france") + "/curve.csv", folder_.Path("module.csv"));
    folder_.Write("module.json", kSidecar);
    folder_.Write("set/a.csv", FileText(folder_.Path("module.csv")));
    folder_.Write("set/a.json", kSidecar);
    folder_.Write("set/b.csv", FileText(folder_.Path("module.csv")));
    fs::create_symlink(folder_.Path("module.csv"), folder_.Path("soft.csv"));
    fs::create_hard_link(folder_.Path("module.csv"), folder_.Path("hard.csv"));
    before_ = FileText(folder_.Path("module.csv"));
  }

  std::string Quoted(const std::string& name) const { return "'" + folder_.Path(name) + "'"; }

  // Expects an error of one sentence, exit code 1 and every file unchanged.
  void ExpectRefused(const std::string& arguments, const std::string& says) {
    const AppResult result = RunApp(arguments);
    EXPECT_EQ(result.exit_code, 1) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
    EXPECT_THAT(result.err, StartsWith("lyrefit: "));
    EXPECT_THAT(result.err, HasSubstr(says)) << arguments;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(FileText(folder_.Path("module.csv")), before_) << arguments;
    EXPECT_EQ(FileText(folder_.Path("module.json")), kSidecar) << arguments;
    EXPECT_EQ(FileText(folder_.Path("set/a.csv")), before_) << arguments;
    EXPECT_EQ(FileText(folder_.Path("set/a.json")), kSidecar) << arguments;
    EXPECT_FALSE(fs::exists(folder_.Path("set/b.json"))) << arguments;
  }

  static constexpr char kSidecar[] = "{\"cells_in_series\": 1, \"nominal_temperature_C\": 33}\n";
  const TempFolder folder_;
  std::string before_;
};

TEST_F(NothingIsLost, WhereAnOutputIsAnInput) {
  const std::string reads = "this run reads the file: name another file, or say --force";
  for (const char* verb : {"fit", "certify", "diagnose"}) {
    const std::string line = std::string(verb) + " " + Quoted("module.csv") + " --json ";
    for (const char* output :
         {"module.csv", "./module.csv", "set/../module.csv", "soft.csv", "hard.csv"}) {
      ExpectRefused(line + Quoted(output), reads);
    }
  }
  ExpectRefused("fit " + Quoted("soft.csv") + " --json " + Quoted("module.csv"), reads);
  ExpectRefused("fit " + Quoted("module.csv") + " --csv " + Quoted("module.csv"), reads);
  for (const char* flag : {"--extend", "--answers"}) {
    ExpectRefused("diagnose " + Quoted("module.csv") + " " + flag + " " + Quoted("module.csv"),
                  reads);
  }
  for (const char* flag : {"--json", "--csv"}) {
    ExpectRefused("compare " + Quoted("module.csv") + " " + flag + " " + Quoted("module.csv"),
                  reads);
  }
  ExpectRefused("audit " + Quoted("module.csv") + " --csv " + Quoted("hard.csv"), reads);
  const std::string other = folder_.Write(
      "other.json",
      R"({"a_ref": 1.0, "I_L_ref": 5, "I_o_ref": 1e-9, "R_s": 0.2, "R_sh_ref": 300, "alpha_sc": 0})");
  const std::string before = FileText(other);
  ExpectRefused("fit " + Quoted("set") + " --family desoto --against " + Quoted("other.json") +
                    " --pvlib " + Quoted("other.json"),
                reads);
  EXPECT_EQ(FileText(other), before);
}

TEST_F(NothingIsLost, WhereAnOutputStandsInASidecarsPlace) {
  const std::string says = "a file of this name is read together with ";
  ExpectRefused("fit " + Quoted("module.csv") + " --json " + Quoted("module.json"), says);
  ExpectRefused("fit " + Quoted("set/b.csv") + " --json " + Quoted("set/b.json"), says);
  ExpectRefused("fit " + Quoted("set") + " --family free --json " + Quoted("set/a.json"), says);
  ExpectRefused("fit " + Quoted("set") + " --family free --json " + Quoted("set/index.csv"), says);
  ExpectRefused("diagnose " + Quoted("set") + " --extend " + Quoted("set/dataset.json"), says);
  ExpectRefused("compare " + Quoted("module.csv") + " --csv " + Quoted("module-index.csv"), says);
  // The table would count as a curve of the set in the next run.
  ExpectRefused("fit " + Quoted("set") + " --family free --csv " + Quoted("set/table.csv"),
                "every table in " + folder_.Path("set") + " is read as a curve");
}

TEST_F(NothingIsLost, WhereTwoOutputsAreOneFile) {
  ExpectRefused("fit " + Quoted("module.csv") + " --json " + Quoted("x.json") + " --csv " +
                    Quoted("./x.json") + " --force",
                "--csv and --json are to write the same file");
  ExpectRefused("diagnose " + Quoted("module.csv") + " --json - --answers -",
                "only one of --json and --answers can have standard output");
  EXPECT_FALSE(fs::exists(folder_.Path("x.json")));
}

TEST_F(NothingIsLost, UnlessItIsMeant) {
  const AppResult result =
      RunApp("fit " + Quoted("module.csv") + " --quiet --force --json " + Quoted("module.json"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(FileText(folder_.Path("module.json")), HasSubstr("lyrefit_version"));
}

TEST_F(NothingIsLost, BySimulateEither) {
  const std::string device =
      "simulate --set Iph=0.76 --set Is1=3e-7 --set n1=1.48 --set Rs=0.036 --set Rsh=54 --out ";
  const std::string says = "holds something else than a simulated curve";
  ExpectRefused(device + Quoted("module.csv"), says);
  folder_.Write("report.json", "{}");
  ExpectRefused(device + Quoted("report.csv"), says);
  EXPECT_EQ(FileText(folder_.Path("report.json")), "{}");
  // `simulate` replaces curves that it wrote itself, whatever device they are of.
  EXPECT_EQ(RunApp(device + Quoted("own.csv") + " --noise-A 1e-4 --temperature-C 33.3").exit_code,
            0);
  const std::string first = FileText(folder_.Path("own.csv"));
  const AppResult again = RunApp(device + Quoted("own.csv") + " --cells 2 --voltages -1:1:40");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(FileText(folder_.Path("own.csv")), first);
  EXPECT_EQ(RunApp(device + Quoted("module.csv") + " --force").exit_code, 0);
}

// The sidecar of the simulated curve would replace the report that the device is read from.
TEST_F(NothingIsLost, OfTheReportThatIsSimulated) {
  ASSERT_EQ(
      RunApp("fit " + Quoted("module.csv") + " --quiet --json " + Quoted("fit.json")).exit_code, 0);
  const std::string report = FileText(folder_.Path("fit.json"));
  ExpectRefused("simulate --from " + Quoted("fit.json") + " --out " + Quoted("fit.csv"),
                "fit.json: --out: this run reads the file");
  EXPECT_EQ(FileText(folder_.Path("fit.json")), report);
  EXPECT_FALSE(fs::exists(folder_.Path("fit.csv")));
}

TEST_F(NothingIsLost, ByALimitOfTheFileSize) {
  ASSERT_EQ(
      RunApp("fit " + Quoted("module.csv") + " --quiet --json " + Quoted("fit.json")).exit_code, 0);
  const std::string report = FileText(folder_.Path("fit.json"));
  const std::string command = "ulimit -f 1; '" + std::string(LYREFIT_APP) + "' fit " +
                              Quoted("module.csv") + " --quiet --json " + Quoted("fit.json") +
                              " 2>/dev/null";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_EQ(FileText(folder_.Path("fit.json")), report);
  for (const auto& entry : fs::directory_iterator(folder_.Path(""))) {
    EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
  }
}

TEST_F(NothingIsLost, WhereANameIsEmpty) {
  ExpectRefused("fit ''", "CURVE: expected the name of a file, found nothing");
  ExpectRefused("fit " + Quoted("module.csv") + " --json ''",
                "--json: expected the name of a file, found nothing");
  ExpectRefused("diagnose ''", "CURVE: expected the name of a file, found nothing");
}

}  // namespace
}  // namespace lyrefit
