#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "json_keys.h"
#include "lyrefit/report/json.h"
#include "lyrefit/trend/trend_documents.h"
#include "sample_trend.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using Set = std::set<std::string>;

const Set kRangedKeys = {"value", "low_95", "high_95"};

TEST(TrendJson, HoldsExactlyTheKeysOfTheContract) {
  const json j = json::parse(TrendJson(SampleTrend(90)));
  EXPECT_EQ(Keys(j), (Set{"lyrefit_version",
                          "name",
                          "verdict",
                          "source",
                          "cells_in_series",
                          "substrings",
                          "n",
                          "law",
                          "first",
                          "last",
                          "reference_end",
                          "measurements",
                          "states",
                          "reasons",
                          "days",
                          "reference_power_W",
                          "quantities",
                          "loss",
                          "onsets",
                          "not_decided",
                          "seed",
                          "options",
                          "interrupted",
                          "warnings"}));
  EXPECT_EQ(Keys(j["states"]),
            (Set{"used", "shaded", "dim", "limited", "off maximum", "unusable"}));
  EXPECT_EQ(Keys(j["reasons"][0]), (Set{"reason", "measurements"}));
  EXPECT_EQ(Keys(j["quantities"][1]),
            (Set{"name", "title", "unit", "reference", "rate_per_year", "rate_percent",
                 "rate_until", "steps", "onsets", "seasonal", "day_scatter", "shared_scatter",
                 "half_life_days", "missing", "days"}));
  EXPECT_EQ(Keys(j["quantities"][1]["steps"][0]),
            (Set{"date", "date_low", "date_high", "size", "p_value"}));
  EXPECT_EQ(Keys(j["quantities"][1]["onsets"][0]), Keys(j["quantities"][1]["steps"][0]));
  EXPECT_EQ(Keys(j["onsets"][0]), (Set{"date", "date_low", "date_high", "id", "quantity", "cause",
                                       "lost_percent", "sentence"}));
  EXPECT_EQ(Keys(j["loss"]), (Set{"energy_percent", "now_percent", "days"}));
  const Set parts = {"light", "resistance_series", "recombination", "shunt", "mismatch"};
  EXPECT_EQ(Keys(j["loss"]["days"]), parts);
  Set with_total = parts;
  with_total.insert("total");
  EXPECT_EQ(Keys(j["loss"]["energy_percent"]), with_total);
  EXPECT_EQ(Keys(j["loss"]["now_percent"]), with_total);
  EXPECT_EQ(Keys(j["loss"]["now_percent"]["total"]), kRangedKeys);
  EXPECT_EQ(Keys(j["quantities"][0]["rate_per_year"]), kRangedKeys);
  EXPECT_EQ(Keys(j["options"][0]), (Set{"name", "value", "default"}));
}

TEST(TrendJson, HoldsTheValues) {
  const json j = json::parse(TrendJson(SampleTrend(90)));
  EXPECT_EQ(j["source"], "sweeps");
  EXPECT_EQ(j["first"], "2025-03-12 10:00:00");
  EXPECT_EQ(j["measurements"], 549);
  EXPECT_EQ(j["states"]["used"], 540);
  EXPECT_EQ(j["states"]["unusable"], 6);
  EXPECT_EQ(j["reasons"][1]["measurements"], 1);
  EXPECT_EQ(j["reference_power_W"], 274.5);
  EXPECT_EQ(j["quantities"][1]["rate_per_year"]["value"], 0.03);
  EXPECT_EQ(j["quantities"][1]["steps"][0]["date"], "2025-05-01");
  EXPECT_EQ(j["quantities"][1]["steps"][0]["date_low"], "2025-04-30");
  EXPECT_EQ(j["quantities"][1]["onsets"][0]["size"]["high_95"], 0.7);
  EXPECT_EQ(j["loss"]["energy_percent"]["total"]["value"], 3.125);
  EXPECT_EQ(j["loss"]["days"]["light"].size(), 90U);
  EXPECT_EQ(j["onsets"][0]["cause"], "a step of the series resistance");
}

// [time, value, fitted, measurements]
TEST(TrendJson, HoldsTheDaysOfAQuantity) {
  const TrendReport report = SampleTrend(90);
  const json days = json::parse(TrendJson(report))["quantities"][1]["days"];
  ASSERT_EQ(days.size(), 90U);
  ASSERT_EQ(days[3].size(), 4U);
  EXPECT_EQ(days[3][0], "2025-03-15 10:00:00");
  EXPECT_NEAR(days[3][1].get<double>(), report.quantities[1].days[3].value, 1e-12);
  EXPECT_NEAR(days[3][2].get<double>(), report.quantities[1].days[3].fitted, 1e-12);
  EXPECT_EQ(days[3][3], 6);
}

TEST(TrendJson, HasNullForWhatIsNotKnown) {
  const json j = json::parse(TrendJson(SampleTrend(90)));
  const json& shunt = j["quantities"][2];
  EXPECT_EQ(shunt["missing"], "too few days tell it");
  EXPECT_TRUE(shunt["reference"].is_null());
  EXPECT_TRUE(shunt["rate_until"].is_null());
  EXPECT_TRUE(shunt["days"].empty());
  EXPECT_TRUE(j["quantities"][0]["seasonal"].is_null());
}

TEST(TrendJson, TakesNamesThatAreNotUtf8) {
  TrendReport report = SampleTrend(12);
  report.name = "caf\xe9";
  report.reasons[0].reason = "\xff\xfe";
  EXPECT_TRUE(json::accept(TrendJson(report)));
}

}  // namespace
}  // namespace lyrefit
