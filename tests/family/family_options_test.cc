#include <gtest/gtest.h>

#include "lyrefit/family/fit_family.h"

namespace lyrefit {
namespace {

TEST(FamilyOptionTable, ReadsPercentWithAndWithoutTheirSign) {
  FamilyOptions options;
  for (const char* text : {"2", "2%", "2 %"}) {
    options.irradiance_accuracy = 0;
    ASSERT_TRUE(ReadIrradianceAccuracy(text, &options, {})) << text;
    EXPECT_EQ(options.irradiance_accuracy, 0.02) << text;
  }
  for (const char* text : {"", "%", "-1", "51", "nan", "two"}) {
    const auto read = ReadIrradianceAccuracy(text, &options, {});
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().message,
              std::string("expected percent from 0 to 50, such as 2 or 2%, found '") + text + "'");
  }
}

TEST(FamilyOptionTable, TakesCurvesOneByOneAndInLists) {
  FamilyOptions options;
  ASSERT_TRUE(ReadLeaveOut("17,18", &options, {}));
  ASSERT_TRUE(ReadLeaveOut("3", &options, {}));
  EXPECT_EQ(options.leave_out, (std::vector<std::string>{"17", "18", "3"}));
}

TEST(FamilyOptionTable, EchoesInTheOrderOfTheTable) {
  FamilyOptions options;
  options.folds = 0;
  options.shunt = ShuntLaw::kConstant;
  options.search.population = 40;
  options.irradiance_accuracy = 0.02;
  options.leave_out = {"17", "18"};
  options.starts = StartsFrom::kShape;
  std::string text;
  for (const OptionEcho& echo : NonDefaults(options, kFamilyOptionTable)) {
    text += echo.name + " " + echo.value + " (" + echo.default_value + ")\n";
  }
  EXPECT_EQ(text,
            "shunt constant ()\npopulation 40 (30)\nstarts shape (all)\nirradiance-accuracy 2 "
            "(0)\nfolds 0 (5)\nleave-out 17 ()\nleave-out 18 ()\n");
}

}  // namespace
}  // namespace lyrefit
