#include "lyrefit/report/pvlib_json.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace lyrefit {
namespace {

using nlohmann::json;

const std::vector<NamedValue> kKeywords = {{"alpha_sc", 0.0025},
                                           {"R_sh_ref", std::numeric_limits<double>::infinity()},
                                           {"cells_in_series", 36}};

TEST(PvlibJson, NamesTheFunctionAndItsKeywords) {
  const CecModule row = {"sample_module", "Mono-c-Si", {{"N_s", 36}, {"a_ref", 0.97}}};
  const json j = json::parse(PvlibJson("module", TranslationLaw::kDeSoto, kKeywords, row));
  EXPECT_EQ(j["name"], "module");
  EXPECT_EQ(j["function"], "calcparams_desoto");
  EXPECT_EQ(j["parameters"]["alpha_sc"], 0.0025);
  EXPECT_TRUE(j["parameters"]["cells_in_series"].is_number_integer());
  EXPECT_TRUE(j["parameters"]["R_sh_ref"].is_null());
  EXPECT_EQ(j["cec"]["Name"], "sample_module");
  EXPECT_EQ(j["cec"]["a_ref"], 0.97);
  EXPECT_EQ(j["cec_reason"], "");
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
