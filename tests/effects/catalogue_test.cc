#include "lyrefit/effects/catalogue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <regex>
#include <set>
#include <string>

#include "effects/synthetic_readings.h"

namespace lyrefit {
namespace {

class CatalogueTest : public ::testing::TestWithParam<const Effect*> {
 protected:
  const Effect& effect() const { return *GetParam(); }
  bool IsUnknown() const { return effect().found_by == FoundBy::kWaves; }

  // Every probe of the effect in any kind of data that can show it.
  std::vector<Probe> AllProbes() const {
    std::vector<Probe> all;
    for (const DataKind kind : kDataKinds) {
      for (const int cells : {1, 60}) {
        const DataTraits traits = SyntheticReadings(kind, cells).traits;
        if (effect().probes == nullptr || effect().why_not(traits)) continue;
        for (const Probe& probe : effect().probes(traits)) all.push_back(probe);
      }
    }
    return all;
  }
};

TEST_P(CatalogueTest, SaysAllThatReportsAsk) {
  const Effect& e = effect();
  for (const char* text : {e.id, e.title, e.equation, e.sentence, e.needs, e.acts, e.action}) {
    ASSERT_NE(text, nullptr);
    EXPECT_STRNE(text, "");
  }
  ASSERT_NE(e.reference, nullptr);
  ASSERT_NE(e.separate_by, nullptr);
  EXPECT_TRUE(IsUnknown() || *e.reference != '\0');
  EXPECT_STRNE(e.separate_by, "");
  EXPECT_EQ(e.where == Where::kNowhere, IsUnknown());
  ASSERT_NE(e.why_not, nullptr);
  const std::string sheet = e.fact_sheet;
  EXPECT_TRUE(sheet.empty() || std::regex_match(sheet, std::regex("PVFS [1-4]-[1-9][0-9]?")));
}

TEST_P(CatalogueTest, BelongsToOneGroup) {
  const std::set<std::string> known = {"device", "wiring", "sweep", "instrument"};
  EXPECT_EQ(known.count(GroupOf(effect())), IsUnknown() ? 0 : 1) << GroupOf(effect());
}

TEST_P(CatalogueTest, IsFoundByItsId) {
  EXPECT_EQ(FindEffect(effect().id), &effect());
  const std::string id = effect().id;
  EXPECT_EQ(id.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos);
}

TEST_P(CatalogueTest, IsConfusedWithOthersThatExist) {
  std::set<std::string> seen;
  for (const char* id : effect().confused_with) {
    EXPECT_NE(FindEffect(id), nullptr) << id;
    EXPECT_STRNE(id, effect().id);
    EXPECT_TRUE(seen.insert(id).second) << id << " twice";
  }
}

TEST_P(CatalogueTest, BoundsHoldTheNeutralValue) {
  std::set<std::string> symbols;
  for (const EffectParameter& p : effect().parameters) {
    EXPECT_LT(p.lower, p.upper) << p.symbol;
    EXPECT_TRUE(std::isfinite(p.lower) && std::isfinite(p.upper)) << p.symbol;
    EXPECT_LE(p.lower, p.neutral) << p.symbol;
    EXPECT_GE(p.upper, p.neutral) << p.symbol;
    EXPECT_STRNE(p.symbol, "");
    EXPECT_STRNE(p.name, "");
    EXPECT_STRNE(p.doc, "");
    EXPECT_TRUE(symbols.insert(p.symbol).second) << p.symbol << " twice";
  }
}

TEST_P(CatalogueTest, ProbesAreFullAndInsideTheBounds) {
  for (const Probe& probe : AllProbes()) {
    ASSERT_EQ(static_cast<int>(probe.size()), effect().size());
    bool away = false;
    for (int k = 0; k < effect().size(); ++k) {
      EXPECT_GE(probe[k], effect().parameters[k].lower) << effect().parameters[k].symbol;
      EXPECT_LE(probe[k], effect().parameters[k].upper) << effect().parameters[k].symbol;
      away = away || probe[k] != effect().parameters[k].neutral;
    }
    EXPECT_TRUE(away);
  }
}

// An effect with parameters is testable in some kind of data, and has the stages and probes of a
// fit.
TEST_P(CatalogueTest, CanBeFittedWhereItHasParameters) {
  const Effect& e = effect();
  EXPECT_EQ(e.HasStage(), !e.parameters.empty());
  EXPECT_EQ(e.probes != nullptr, !e.parameters.empty());
  EXPECT_EQ(AllProbes().empty(), e.parameters.empty());
}

TEST_P(CatalogueTest, EveryStageKnowsEveryNumberType) {
  const auto complete = [](const auto& hook) {
    const bool value = hook.value != nullptr;
    return value == (hook.narrow != nullptr) && value == (hook.middle != nullptr) &&
           value == (hook.wide != nullptr);
  };
  const Effect& e = effect();
  EXPECT_TRUE(complete(e.conditions) && complete(e.cell) && complete(e.junction) &&
              complete(e.series) && complete(e.instrument));
}

TEST_P(CatalogueTest, ReportedFactorsAreFinite) {
  ReadingScale scale = SyntheticReadings(DataKind::kReverse, 60).scale;
  std::vector<Probe> places = AllProbes();
  places.push_back(NeutralValues(effect()));
  for (const double reach : {0.5, 6.0, 40.0}) {
    scale.reach_V = reach;
    for (const Probe& place : places) {
      for (const EffectParameter& parameter : effect().parameters) {
        const double factor = parameter.ReportedFactor(place.data(), scale);
        EXPECT_TRUE(std::isfinite(factor) && factor != 0) << parameter.symbol;
      }
    }
  }
}

std::string IdOf(const ::testing::TestParamInfo<const Effect*>& info) { return info.param->id; }

INSTANTIATE_TEST_SUITE_P(Effects, CatalogueTest, ::testing::ValuesIn(Catalogue()), IdOf);

TEST(CatalogueListTest, IdsAreUnique) {
  std::set<std::string> ids;
  for (const Effect* effect : Catalogue()) EXPECT_TRUE(ids.insert(effect->id).second) << effect->id;
  EXPECT_EQ(FindEffect("nonsense"), nullptr);
  EXPECT_EQ(FindEffect(""), nullptr);
}

TEST(CatalogueListTest, InseparableCausesSayWhatTheyBias) {
  std::set<std::string> ids;
  DataTraits lit, dark;
  dark.only_dark = true;
  for (const Inseparable& cause : InseparableCauses()) {
    EXPECT_TRUE(ids.insert(cause.id).second) << cause.id;
    EXPECT_STRNE(cause.biases, "");
    EXPECT_STRNE(cause.sentence, "");
    EXPECT_STRNE(cause.separate_by, "");
    ASSERT_NE(cause.applies, nullptr);
    EXPECT_TRUE(cause.applies(lit) || cause.applies(dark)) << cause.id;
  }
  EXPECT_EQ(ids.count("lead_resistance"), 1U);
}

// Reporting units are those of the effect's equation for the whole device: ampere, volt, second.
TEST(ReportedFactorTest, MatchesTheEquationsOfAModule) {
  ReadingScale scale;
  scale.current_A = 8;
  scale.cells = 60;
  scale.rate_V_per_s = 0.5;
  scale.reach_V = 4;
  const auto reported = [&](const char* id, int parameter, const std::vector<double>& p) {
    return p[parameter] * FindEffect(id)->parameters[parameter].ReportedFactor(p.data(), scale);
  };
  // At the largest voltage, k |Vj|^m is 0.1 of the current scale.
  EXPECT_NEAR(reported("nonohmic_shunt", 0, {0.1, 2}) * 16, 0.1 * 8, 1e-12);
  // At the most negative voltage, a Vj (1 - Vj / Vbr)^-3.4 is 0.2 of the current scale.
  const double a = reported("breakdown", 0, {0.2, 0.5}), vbr = reported("breakdown", 1, {0.2, 0.5});
  EXPECT_NEAR(vbr, -8, 1e-12);
  EXPECT_NEAR(a * 4 * std::pow(1 - 4.0 / 8, -3.4), 0.2 * 8, 1e-12);
  // Charging current of the device: C dV/dt, for 60 cells at 0.5 V/s each.
  EXPECT_NEAR(reported("capacitance", 0, {0.01, 0, 0}) * 60 * 0.5, 0.01 * 8, 1e-12);
  EXPECT_NEAR(reported("timing_skew", 0, {0.001}) * 0.5, 0.001, 1e-15);
  // At the current scale, Rs1 I |I| is the voltage drop of 60 cells.
  EXPECT_NEAR(reported("rs_current", 0, {0.01}) * 64, 60 * 0.01, 1e-12);
  EXPECT_NEAR(reported("distributed_rs", 0, {0.02}) * 8, 60 * 0.02, 1e-12);
  EXPECT_NEAR(reported("aged_contacts", 0, {0.02, 0.3}) * 8, 60 * 0.02, 1e-12);
  EXPECT_NEAR(reported("photoshunt", 0, {0.3, 0}) * 60, 0.3 * 8, 1e-12);
  EXPECT_NEAR(reported("voltage_offset", 0, {0.001}), 0.06, 1e-15);
  EXPECT_NEAR(reported("back_contact", 0, {3}), 3.0 / 8, 1e-15);
  EXPECT_NEAR(reported("clip", 0, {0.95}), 7.6, 1e-12);
}

}  // namespace
}  // namespace lyrefit
