#include "lyrefit/estimate/fit/effect_text.h"

#include <gtest/gtest.h>

#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/fit/fit.h"

namespace lyrefit {
namespace {

TEST(EffectText, ReadsWhatDescribeUseWrites) {
  for (const char* text : {"shading", "shading:d=0.3", "shading:d=0:0.5,w=0.25"}) {
    const auto use = ReadEffectUse(text);
    ASSERT_TRUE(use) << text;
    EXPECT_EQ(DescribeUse(*use), text);
  }
}

TEST(EffectText, SaysWhatIsWrong) {
  EXPECT_EQ(ReadEffectUse("nothing").error().message,
            "there is no effect 'nothing'; lyrefit diagnose --explain lists them");
  EXPECT_EQ(ReadEffectUse("shading:d").error().message,
            "expected PARAMETER=VALUE such as n2=2, found 'd'");
  EXPECT_EQ(ReadEffectUse("shading:d=1:").error().message,
            "expected PARAMETER=LOWER:UPPER such as Rs=0:0.5, found 'd=1:'");
}

std::vector<std::string> Echoes(const FitOptions& options) {
  std::vector<std::string> texts;
  for (const OptionEcho& echo : NonDefaults(options, kFitOptionTable)) {
    texts.push_back(echo.name + " " + echo.value);
  }
  return texts;
}

TEST(FitOptionTable, EchoesWhatIsNotUsual) {
  EXPECT_TRUE(Echoes({}).empty());
  FitOptions options;
  options.bounds.overrides["Rs"] = {0, 0.5};
  options.fixed["n1"] = 1.5;
  options.loss = Loss::kHuber;
  options.polish = false;
  options.threads = 3;  // the result does not depend on it
  EXPECT_EQ(Echoes(options),
            (std::vector<std::string>{"bound Rs=0:0.5", "fix n1=1.5", "polish no", "loss huber"}));
}

TEST(FitOptionTable, WithEffectsTheSmallPopulationIsUsual) {
  FitOptions options;
  options.with = {*ReadEffectUse("shading:d=0.3")};
  options.search = FitOptions::SearchBesideShapes();
  EXPECT_EQ(Echoes(options), std::vector<std::string>{"with shading:d=0.3"});
  options.search = {};
  EXPECT_EQ(Echoes(options),
            (std::vector<std::string>{"with shading:d=0.3", "population 20", "iterations 20"}));
}

}  // namespace
}  // namespace lyrefit
