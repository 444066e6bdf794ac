#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_app.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string kTandem =
    "simulate --junctions 2 --set Is1=1e-14 --set n1=1.4 --set Rsh1=3000 --set Is2=3e-10 --set "
    "n2=1.2 "
    "--set Rsh2=1500 --set Rs=2 ";

TEST(TwoJunctionsCommand, FitsWhatItSimulatesUnderTwoSpectra) {
  const TempFolder folder;
  const std::string white = folder.Path("white.csv"), top = folder.Path("top.csv");
  const std::string report = folder.Path("fit.json");
  ASSERT_EQ(RunApp(kTandem + "--set Iph1=0.0195 --set Iph2=0.0202 --out " + white).exit_code, 0);
  ASSERT_EQ(RunApp(kTandem + "--set Iph1=0.0195 --set Iph2=0 --out " + top).exit_code, 0);
  const AppResult fit = RunApp(
      "fit " + white + " " + top +
      " --junctions 2 --light white=1:1 --light top=1:0 --intervals symmetric --json " + report);
  ASSERT_EQ(fit.exit_code, 0) << fit.err;
  EXPECT_THAT(fit.out, HasSubstr("two junctions in series"));
  EXPECT_THAT(fit.out, HasSubstr("solved-current *"));
  const json record = json::parse(FileText(report));
  EXPECT_EQ(record["curves"][1]["limiting"], 2);
  EXPECT_NEAR(record["parameters"]["n_1"]["refined"].get<double>(), 1.4, 1e-4);
  EXPECT_NEAR(record["parameters"]["n_2"]["refined"].get<double>(), 1.2, 1e-4);
  const AppResult again = RunApp("simulate --from " + report + " --curve white --voltages 0:1.4:3");
  const AppResult truth =
      RunApp(kTandem + "--set Iph1=0.0195 --set Iph2=0.0202 --voltages 0:1.4:3");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const auto last = [](const std::string& table) {
    return std::stod(table.substr(table.rfind(',') + 1));
  };
  EXPECT_NEAR(last(again.out), last(truth.out), 1e-9);
}

}  // namespace
}  // namespace lyrefit
