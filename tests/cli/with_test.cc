#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "../repeats.h"
#include "lyrefit/base/file.h"
#include "run_app.h"
#include "same_curve.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::nlohmann::json;
using ::testing::HasSubstr;

const std::string kShaded = "'" + std::string(LYREFIT_DATA_DIR) + "/diagnosis/shaded_module.csv'";
const std::string kModule =
    "simulate --set Iph=8.2 --set Is1=2e-9 --set n1=1.15 --set Rs=0.25 --set Rsh=300 --cells 60 "
    "--temperature-C 25 ";

std::string ReadFile(const std::string& file) {
  const auto text = ReadTextFile(file, 64U << 20);
  EXPECT_TRUE(text) << text.error().ToString();
  return text.value_or("");
}

TEST(With, AFitIsReportedAndSimulatedAgain) {
  const TempFolder folder;
  const std::string file = folder.Path("fit.json");
  const AppResult fit = RunApp("fit -v " + kShaded + " --with shading --json '" + file + "'");
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  EXPECT_THAT(fit.out, HasSubstr("effects       partial shading (shading)\n"));
  EXPECT_THAT(fit.out, HasSubstr("shading.d"));
  EXPECT_THAT(fit.out, HasSubstr("with = shading"));
  const json report = json::parse(ReadFile(file));
  EXPECT_EQ(report["causes"], json::array({"shading"}));
  EXPECT_EQ(report["law"]["bypass_diodes"], 3);
  EXPECT_EQ(report["singlediode"]["resistance_series"],
            report["parameters"]["resistance_series"]["refined"]);  // of the base model
  const json& depth = report["parameters"]["shading.d"];
  EXPECT_LT(depth["low_95"], depth["refined"]);
  EXPECT_GT(depth["high_95"], depth["refined"]);
  // `--with shading` without ranges fits two model variants, and a share in whole thirds since the
  // three substrings are known.
  EXPECT_THAT(fit.out, HasSubstr("d, w, Vb free <-\n"));
  EXPECT_EQ(report["variants"].size(), 2u);
  const json& share = report["parameters"]["shading.w"];
  EXPECT_NEAR(share["whole"].get<double>(), 1.0 / 3, 1e-15);
  EXPECT_TRUE(share["low_95"].is_null());
  EXPECT_FALSE(share["fixed"].get<bool>());
  EXPECT_THAT(fit.out, HasSubstr("whole number, by trying"));
  const json& local_optima = report["refine"]["local_optima"];
  EXPECT_GE(local_optima["ends"], local_optima["local_optima"]);
  EXPECT_GE(local_optima["best_visits"], 1);
  EXPECT_LE(local_optima["ends"], report["refine"]["start_list"].size());
  ExpectSameCurve(file, report);
}

TEST(With, AnotherVersionsReportIsNotGuessedAt) {
  const TempFolder folder;
  const std::string file = folder.Path("fit.json");
  ASSERT_EQ(
      RunApp("fit " + kShaded + " --with shading --intervals none --quiet --json '" + file + "'")
          .exit_code,
      0);
  json report = json::parse(ReadFile(file));
  report["lyrefit_version"] = "0.0.1";
  const AppResult refused =
      RunApp("simulate --from '" + folder.Write("old.json", report.dump()) + "'");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("a model with effects, written by lyrefit 0.0.1"));
}

TEST(With, ASimulationNeedsNoReport) {
  const AppResult plain = RunApp(kModule + "--voltages 0:35:8");
  const AppResult shaded =
      RunApp(kModule + "--voltages 0:35:8 --with shading:d=0.4,w=0.3333333333");
  ASSERT_EQ(shaded.exit_code, 0) << shaded.err;
  const std::vector<double> full = CurrentsOf(plain.out), less = CurrentsOf(shaded.out);
  ASSERT_EQ(less.size(), 8U);
  EXPECT_NEAR(less.front(), full.front(), 0.02);   // the bypass diode carries the difference
  EXPECT_NEAR(less[6], 0.6 * full.front(), 0.15);  // 30 V: the shaded third limits
}

TEST(With, SearchesAreComparedOnIt) {
  SKIP_IF_SANITIZED();
  const AppResult compare =
      RunApp("compare " + kShaded +
             " --with shading:w=0.3333 --models sd --algorithms random --population 5 "
             "--iterations 4 --runs 2");
  ASSERT_EQ(compare.exit_code, 0) << compare.err;
  EXPECT_THAT(compare.out, HasSubstr("solved-current, with shading:w=0.3333"));
}

}  // namespace
}  // namespace lyrefit
