#include "lyrefit/report/json.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "json_keys.h"
#include "sample_data_sheet.h"

#include "lyrefit/devices/device_documents.h"
#include "lyrefit/family/family_documents.h"

namespace lyrefit {
namespace {

using nlohmann::json;

TEST(DataSheetJson, HoldsTheFamily) {
  const DataSheetFit fit = *FitDataSheet(SampleSheet());
  const json family = json::parse(DataSheetJson(fit))["family"];
  EXPECT_EQ(family["bound"], "shunt_conductance");
  EXPECT_EQ(family["members"].size(), fit.family.members.size());
  EXPECT_EQ(family["picked"]["max_power_W"].size(), family["conditions"].size());
  EXPECT_TRUE(family["members"].back()["R_sh_ref"].is_null());
  EXPECT_LT(family["rounding"]["low"]["n"], family["picked"]["n"]);
  EXPECT_LT(family["rounding"]["spread"]["difference_A"], family["spread"]["difference_A"]);
  DataSheet exact = SampleSheet();
  exact.half_unit = {};
  const json alone = json::parse(DataSheetJson(*FitDataSheet(exact)))["family"]["rounding"];
  for (const char* key : {"low", "high", "spread"}) EXPECT_TRUE(alone[key].is_null()) << key;
}

const std::vector<NamedValue> kKeywords = {{"alpha_sc", 0.0025},
                                           {"R_sh_ref", std::numeric_limits<double>::infinity()},
                                           {"cells_in_series", 36}};

TEST(PvlibJson, NamesTheFunctionAndItsKeywords) {
  const CecModule row = {"sample_module", "Mono-c-Si", {{"N_s", 36}, {"a_ref", 0.97}}};
  const json j = json::parse(PvlibJson("module", TranslationLaw::kDeSoto, kKeywords, row));
  EXPECT_EQ(j["name"], "module");
  EXPECT_EQ(j["function"], "calcparams_desoto");
  EXPECT_EQ(j["parameters"]["alpha_sc"], 0.0025);
  EXPECT_TRUE(j["cells_in_series"].is_number_integer());
  EXPECT_TRUE(j["parameters"]["R_sh_ref"].is_null());
  EXPECT_EQ(j["cec"]["Name"], "sample_module");
  EXPECT_EQ(j["cec"]["a_ref"], 0.97);
  EXPECT_EQ(j["cec_reason"], "");
}

// Any other key would be an unexpected keyword argument of pvlib's function, a TypeError.
TEST(PvlibJson, ParametersAreTheArgumentsOfTheFunction) {
  const auto written = [](TranslationLaw law, ShuntLaw shunt, bool recombination) {
    TranslationSpec spec;
    spec.law = law;
    spec.shunt = shunt;
    spec.recombination = recombination;
    spec.cells_in_series = 36;
    const auto translation = MakeTranslation(spec);
    std::vector<double> shared(translation->size(), 1);
    if (law == TranslationLaw::kPvsyst) {
      shared[translation->resistance_shunt_dark] = 4;
      shared[translation->shunt_exponent] = 5.5;
    }
    const auto keywords = PvlibParameters(*translation, shared);
    EXPECT_TRUE(keywords) << keywords.error().message;
    return json::parse(PvlibJson("m", law, *keywords, Fail("none")));
  };
  const json desoto = written(TranslationLaw::kDeSoto, ShuntLaw::kInverse, false);
  EXPECT_EQ(Keys(desoto["parameters"]),
            (std::set<std::string>{"alpha_sc", "a_ref", "I_L_ref", "I_o_ref", "R_sh_ref", "R_s",
                                   "EgRef", "dEgdT", "irrad_ref", "temp_ref"}));
  EXPECT_EQ(desoto["cells_in_series"], 36);
  EXPECT_FALSE(desoto.contains("bishop88"));
  const std::set<std::string> pvsyst = {
      "alpha_sc", "gamma_ref",       "mu_gamma", "I_L_ref", "I_o_ref",   "R_sh_ref", "R_sh_0",
      "R_s",      "cells_in_series", "R_sh_exp", "EgRef",   "irrad_ref", "temp_ref"};
  const json plain = written(TranslationLaw::kPvsyst, ShuntLaw::kExponential, false);
  EXPECT_EQ(Keys(plain["parameters"]), pvsyst);
  const json thin = written(TranslationLaw::kPvsyst, ShuntLaw::kExponential, true);
  EXPECT_EQ(Keys(thin["parameters"]), pvsyst);
  EXPECT_EQ(Keys(thin["bishop88"]), (std::set<std::string>{"d2mutau", "NsVbi"}));
  EXPECT_EQ(thin["cells_in_series"], 36);
}

TEST(PvlibJson, SaysWhyThereIsNoRow) {
  const json j =
      json::parse(PvlibJson("module", TranslationLaw::kPvsyst, kKeywords, Fail("of another law")));
  EXPECT_EQ(j["function"], "calcparams_pvsyst");
  EXPECT_TRUE(j["cec"].is_null());
  EXPECT_EQ(j["cec_reason"], "of another law");
}

}  // namespace
}  // namespace lyrefit
