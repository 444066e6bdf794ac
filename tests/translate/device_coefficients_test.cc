#include "lyrefit/translate/device_coefficients.h"

#include "lyrefit/estimate/fit/text_readers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "synthetic_string.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(Coefficients, AreAbsoluteOrInPercent) {
  StatedCoefficients c;
  ASSERT_TRUE(ReadAlpha("0.05%", &c, {}));
  EXPECT_DOUBLE_EQ(*c.alpha_percent_K, 0.05);
  ASSERT_TRUE(ReadAlpha("0.004", &c, {}));
  EXPECT_FALSE(c.alpha_percent_K);
  EXPECT_DOUBLE_EQ(*c.alpha_A_K, 0.004);
  ASSERT_TRUE(ReadBeta("-0.31%", &c, {}));
  EXPECT_EQ(BetaTexts(c), std::vector<std::string>{"-0.31%"});
  for (const char* text : {"", "%", "a%", "nan", "inf%", "-0.3 %/K"}) {
    EXPECT_FALSE(ReadBeta(text, &c, {})) << text;
  }
}

TEST(Coefficients, ComeFromAFileBehindTheFlags) {
  const TempFolder folder;
  const std::string path = folder.Path("sheet.json");
  std::ofstream(path) << R"({"coefficients": {"alpha_sc_percent_K": 0.05, "beta_oc_V_K": -0.12,
                              "kappa_ohm_K": 0.0015}})";
  StatedCoefficients c;
  c.alpha_A_K = 0.004;
  ASSERT_TRUE(ReadCoefficients(path, &c));
  EXPECT_DOUBLE_EQ(*c.alpha_A_K, 0.004);
  EXPECT_FALSE(c.alpha_percent_K);
  EXPECT_DOUBLE_EQ(*c.beta_V_K, -0.12);
  EXPECT_DOUBLE_EQ(*c.kappa_ohm_K, 0.0015);
}

TEST(Coefficients, RefuseFilesThatHoldNone) {
  const TempFolder folder;
  const std::string path = folder.Path("sheet.json");
  for (const char* text : {"", "[1]", "{}", R"({"beta_oc_V_K": "steep"})", "{\"beta_oc_V_K\": "}) {
    std::ofstream(path) << text;
    StatedCoefficients c;
    EXPECT_FALSE(ReadCoefficients(path, &c)) << text;
  }
  StatedCoefficients c;
  EXPECT_FALSE(ReadCoefficients(folder.Path("none.json"), &c));
}

// Coefficients that are not stated are derived from the curve and are near the true ones.
TEST(SettledInputs, AreNearTheTruthOfAModule) {
  const SyntheticModule module;
  const SettledInputs settled =
      SettleInputs(module.Coefficients(), "c-Si", module.Curve(800, 45, {}), module.Bare(800, 45));
  EXPECT_NEAR(settled.values.resistance_series_ohm, 0.25, 1e-9);
  // Voc(1000) / Voc(500) by the derived B1 and B2, compared with that of the module.
  const double x = std::log(2.0);
  const double f = 1 + x * (settled.values.b1 + x * settled.values.b2);
  const double truth =
      module.Truth(1000, 25).open_circuit_voltage_V / module.Truth(500, 25).open_circuit_voltage_V;
  EXPECT_NEAR(f, truth, 2e-3);
  EXPECT_GT(settled.values.kappa_ohm_K, 0.0005);
  EXPECT_LT(settled.values.kappa_ohm_K, 0.003);
  EXPECT_FALSE(settled.beta_scatter);
  EXPECT_THAT(settled.assumptions, ::testing::SizeIs(1));
}

TEST(SettledInputs, SayWhatWasAssumed) {
  const SyntheticModule module;
  const SettledInputs settled =
      SettleInputs({}, "", module.Curve(800, 45, {}), module.Bare(800, 45));
  ASSERT_TRUE(settled.alpha_scatter && settled.beta_scatter);
  EXPECT_THAT(settled.assumptions, ::testing::Contains(HasSubstr("nobody stated beta")));
  EXPECT_THAT(settled.assumptions, ::testing::Contains(HasSubstr("technology")));
  EXPECT_LT(settled.values.beta_oc_V_K, 0);
}

}  // namespace
}  // namespace lyrefit
