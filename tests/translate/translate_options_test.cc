#include "lyrefit/translate/translate_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(ReadTarget, TakesWhatPeopleWrite) {
  TranslateOptions options;
  for (const char* text : {"800,45", " 800 , 45", "8e2,45.0"}) {
    ASSERT_TRUE(ReadTarget(text, &options, {})) << text;
    EXPECT_EQ(options.target.irradiance_W_m2, 800) << text;
    EXPECT_EQ(options.target.temperature_C, 45) << text;
  }
  ASSERT_TRUE(ReadTarget("stc", &options, {}));
  EXPECT_EQ(options.target.irradiance_W_m2, 1000);
  EXPECT_EQ(options.target.temperature_C, 25);
  ASSERT_TRUE(ReadTarget("1000,-10", &options, {}));
  EXPECT_EQ(options.target.temperature_C, -10);
}

TEST(ReadTarget, RefusesWhatIsNoPlace) {
  TranslateOptions options;
  for (const char* text : {"", "1000", "1000,", ",25", "1000;25", "1000,25,3", "hot", "nan,25",
                           "0,25", "-5,25", "1e9,25", "1000,nan", "1000,400", "1000,-200"}) {
    const auto read = ReadTarget(text, &options, {});
    ASSERT_FALSE(read) << text;
    EXPECT_THAT(read.error().message, HasSubstr("expected")) << text;
  }
  EXPECT_EQ(options.target.irradiance_W_m2, 1000);
}

TEST(TranslateOptions, AreCheckedBeforeAnyWork) {
  TranslateOptions options;
  EXPECT_TRUE(ValidateTranslateOptions(options));
  options.lead_resistance_ohm = -1;
  EXPECT_FALSE(ValidateTranslateOptions(options));
  options = {};
  options.coefficients.beta_percent_K = -31;
  EXPECT_FALSE(ValidateTranslateOptions(options));
  options = {};
  options.coefficients.kappa_ohm_K = kInfinity;
  EXPECT_FALSE(ValidateTranslateOptions(options));
}

TEST(ReadModule, TakesTheSheetOfAModuleWhereNothingWasSaid) {
  const TempFolder folder;
  const std::string file =
      folder.Write("module.json",
                   R"({"rated_power_W": 290, "gamma_pmp_percent_K": -0.343, "modules_in_series": 20,
          "technology": "mono-Si", "beta_oc_percent_K": -0.277})");
  TranslateOptions options;
  options.field_test.rated_W = 300;
  ASSERT_TRUE(ReadModule(file, &options));
  EXPECT_EQ(options.field_test.rated_W, 300);
  EXPECT_EQ(options.field_test.power_coefficient_percent_K, -0.343);
  EXPECT_EQ(options.layout.modules_in_series, 20);
  EXPECT_EQ(options.technology, "mono-Si");
  EXPECT_EQ(options.coefficients.beta_percent_K, -0.277);
  EXPECT_FALSE(ReadModule(folder.Write("list.json", "[290]"), &options));
  EXPECT_FALSE(ReadModule(folder.Write("text.json", R"({"rated_power_W": "many"})"), &options));
}

TEST(ReadModule, TakesTheSheetOfOtherPrograms) {
  TranslateOptions options;
  const std::string folder = std::string(LYREFIT_DATA_DIR) + "/datasheet/";
  ASSERT_TRUE(ReadModule(folder + "invented.PAN", &options));
  EXPECT_EQ(options.field_test.rated_W, 304);
  EXPECT_EQ(options.field_test.power_coefficient_percent_K, -0.362);
  EXPECT_EQ(options.technology, "mtSiMono");
  EXPECT_NEAR(*options.coefficients.alpha_A_K, 0.00487, 1e-15);
  EXPECT_NEAR(*options.coefficients.beta_V_K, -0.1225, 1e-15);
  TranslateOptions said;
  said.coefficients.beta_percent_K = -0.3;
  ASSERT_TRUE(ReadModule(folder + "invented_cec.csv#Invented I-304 M60", &said));
  EXPECT_EQ(said.field_test.rated_W, 304.2);
  EXPECT_FALSE(said.coefficients.beta_V_K);
  EXPECT_FALSE(ReadModule(folder + "invented_cec.csv", &said));
}

}  // namespace
}  // namespace lyrefit
