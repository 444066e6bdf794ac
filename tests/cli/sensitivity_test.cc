#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_app.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string kSmallStudy = " --models sd --runs 2 --population 10 --iterations 20 ";

TEST(SensitivityVerb, PrintsGridsOfPmAndGamma) {
  const AppResult result = RunApp("sensitivity " + kRtc + kSmallStudy);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("gamma = 0.75"));
  EXPECT_THAT(result.out, HasSubstr("\n  Pm = 0.25 "));
  EXPECT_THAT(result.out, HasSubstr("50 of 50 runs of all settings end within 1e-9"));
}

TEST(SensitivityVerb, SharesTheCornerWithThePlainOptimizer) {
  const std::string grid = RunApp("sensitivity " + kRtc + kSmallStudy +
                                  "--memory-rates 0 --distance-coefficients 0 --json -")
                               .out;
  const std::string plain =
      RunApp("compare " + kRtc + kSmallStudy + "--algorithms lo --json -").out;
  const json a = json::parse(grid, nullptr, false)["problems"][0]["algorithms"][0];
  const json b = json::parse(plain, nullptr, false)["problems"][0]["algorithms"][0];
  EXPECT_EQ(a["name"], "Pm=0 gamma=0");
  EXPECT_EQ(a["searched"], b["searched"]);
}

TEST(SensitivityVerb, RefusesBadLists) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"--memory-rates 0,x", "--memory-rates: expected a number, found 'x'"},
      {"--memory-rates 2", "memory-rate = 2 is outside [0, 1]"},
      {"--distance-coefficients 0,,1", "--distance-coefficients"},
      {"--memory-rates 0,0", "is named twice"},
  };
  for (const auto& [flags, says] : cases) {
    const AppResult result = RunApp("sensitivity " + kRtc + kSmallStudy + flags);
    EXPECT_EQ(result.exit_code, 1) << flags;
    EXPECT_THAT(result.err, HasSubstr(says)) << flags;
  }
}

}  // namespace
}  // namespace lyrefit
