#include "lyrefit/report/json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "sample_data_sheet.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using Set = std::set<std::string>;

Set Keys(const json& j) {
  Set keys;
  for (const auto& [key, value] : j.items()) keys.insert(key);
  return keys;
}

TEST(DataSheetJson, HoldsExactlyTheKeysOfTheContract) {
  const json j = json::parse(DataSheetJson(SampleDataSheetFit()));
  EXPECT_EQ(Keys(j), (Set{"lyrefit_version", "law", "model", "cells_in_series", "constants",
                          "parameters", "checks", "largest_relative_error", "warnings"}));
  EXPECT_EQ(Keys(j["parameters"]["R_s"]), (Set{"symbol", "name", "unit", "value", "low", "high"}));
  EXPECT_EQ(j["parameters"]["R_s"]["high"], 0.41);
  EXPECT_TRUE(j["parameters"]["R_sh_ref"]["value"].is_null());
  EXPECT_TRUE(j["parameters"]["EgRef"]["low"].is_null());
  EXPECT_EQ(j["checks"]["beta_oc"]["printed"], -0.076);
}

}  // namespace
}  // namespace lyrefit
