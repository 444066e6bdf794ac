#include "lyrefit/diagnose/priors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "lyrefit/base/file.h"
#include "lyrefit/effects/catalogue.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(EffectPriorTest, NamesItsSource) {
  double sum = 0;
  int stated = 0;
  for (const Effect* effect : Catalogue()) {
    const EffectPrior& prior = effect->prior;
    EXPECT_EQ(prior.in_cells > 0, prior.in_modules > 0) << effect->id;
    EXPECT_EQ(*prior.source != '\0', prior.in_modules > 0) << effect->id;
    sum += prior.in_modules;
    stated += prior.in_modules > 0 ? 1 : 0;
  }
  EXPECT_GE(stated, 31);
  EXPECT_LT(sum, 1);
}

double Of(const CausePriors& priors, const char* id, bool module) {
  return priors.Of(*FindEffect(id), module);
}

class ReadPriorsTest : public ::testing::Test {
 protected:
  Expected<CausePriors> Read(const std::string& text) {
    const std::string path = folder_.Path("priors.json");
    EXPECT_TRUE(WriteTextFile(path, text));
    return PriorsNamed(path);
  }
  TempFolder folder_;
};

TEST_F(ReadPriorsTest, ReplacesThoseOfTheTable) {
  const auto priors = Read(R"({"shading": 0.25})");
  ASSERT_TRUE(priors);
  EXPECT_EQ(Of(*priors, "shading", true), 0.25);
  EXPECT_EQ(Of(*priors, "drift", true), Of({}, "drift", true));
  EXPECT_EQ(priors->Of(Effect(), false), kOtherPrior);
}

TEST_F(ReadPriorsTest, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(Read(R"({"shadow": 0.25})").error().message, HasSubstr("the id of an effect"));
  EXPECT_THAT(Read(R"({"shading": 1.5})").error().message, HasSubstr("a probability above 0"));
  EXPECT_THAT(Read("[0.1]").error().message, HasSubstr("as an object like"));
  EXPECT_FALSE(PriorsNamed(folder_.Path("absent.json")));
}

TEST(PriorsNamedTest, AlikeGivesAllTheSame) {
  const auto alike = PriorsNamed("alike");
  ASSERT_TRUE(alike);
  EXPECT_EQ(Of(*alike, "shading", true), Of(*alike, "clip", false));
}

TEST(PriorFactorTest, NamesItsSourceAndHoldsInNoUsualField) {
  int factors = 0;
  for (const Effect* effect : Catalogue()) {
    for (const PriorFactor& one : effect->prior.factors) {
      EXPECT_STRNE(one.source, "") << effect->id;
      EXPECT_FALSE(one.holds({})) << effect->id << ": the prior is that of no setup";
      EXPECT_FALSE(one.holds({Setup::kOutdoor, true, false, "c-Si", 5})) << effect->id;
      ++factors;
    }
  }
  EXPECT_GE(factors, 27);
}

TEST(PriorFactorTest, SetupAgeAndTechnologyCount) {
  CausePriors priors;
  const auto in = [&](const Circumstances& where, const char* id) {
    priors.where = where;
    return Of(priors, id, true) / Of({}, id, true);
  };
  EXPECT_LT(in({Setup::kFlash, true}, "shading"), 1);
  EXPECT_LT(in({Setup::kLaboratory, true}, "shading"), 1);
  EXPECT_EQ(in({Setup::kOutdoor, true}, "shading"), 1);
  EXPECT_LT(in({Setup::kUnknown, true, false, "", 0.5}, "aged_contacts"), 1);
  EXPECT_EQ(in({Setup::kUnknown, true, false, "", 5}, "aged_contacts"), 1);
  EXPECT_GT(in({Setup::kUnknown, true, false, "", 15}, "aged_contacts"), 1);
  EXPECT_GT(in({Setup::kUnknown, true, false, "CdTe", {}}, "nonohmic_shunt"), 1);
  priors.given["shading"] = 0.25;  // replaces number and factor
  priors.where = {Setup::kFlash, true};
  EXPECT_EQ(Of(priors, "shading", true), 0.25);
}

const char* NotThere(const char* id, const Circumstances& where) {
  return WhyNotThere(*FindEffect(id), where);
}

TEST(WhyNotThereTest, NoSkyInAFlasherAndNoChargeInSlowSweeps) {
  for (const char* id : {"irr_step", "transient", "drift", "temp_drift"}) {
    EXPECT_NE(NotThere(id, {Setup::kFlash, true}), nullptr) << id;
    EXPECT_EQ(NotThere(id, {Setup::kOutdoor, true}), nullptr) << id;
  }
  EXPECT_NE(NotThere("capacitance", {Setup::kOutdoor, true, true}), nullptr);
  EXPECT_EQ(NotThere("capacitance", {Setup::kOutdoor, true, false}), nullptr);
  EXPECT_NE(NotThere("quantisation", {Setup::kInverter, true}), nullptr);
}

}  // namespace
}  // namespace lyrefit
