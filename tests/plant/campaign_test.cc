#include "plant/campaign.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/random.h"
#include "lyrefit/batch/sparkline.h"
#include "lyrefit/curve/key_points.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Strings = std::vector<CampaignString>;

constexpr int kDiodes = 60;

// The factors by which one string changes.
struct Factors {
  double isc = 1, voc = 1, imp = 1,
         vmp = 1;  // imp and vmp of the fill factor: Imp / Isc, Vmp / Voc
};

void Apply(const Factors& by, CampaignString* string) {
  auto& v = string->values;
  v[kCIsc] *= by.isc;
  v[kCVoc] *= by.voc;
  v[kCImp] *= by.isc * by.imp;
  v[kCVmp] *= by.voc * by.vmp;
  v[kCPmax] = v[kCImp] * v[kCVmp];
  v[kCFillFactor] = v[kCPmax] / (v[kCIsc] * v[kCVoc]);
}

CampaignString PlainString(const std::string& id) {
  CampaignString string;
  string.id = id;
  string.values = {9.6F, 780.0F, 0.0F, 0.0F, 9.0F, 640.0F};
  string.bypass_diodes = kDiodes;
  Apply({}, &string);
  for (int q = 0; q < kCampaignKept; ++q) string.expanded[q] = 0.03F * string.values[q];
  return string;
}

// Errors of one sweep.
Factors Noise(RandomStream* random) {
  return {1 + 0.006 * random->Normal(), 1 + 0.003 * random->Normal(), 1 + 0.001 * random->Normal(),
          1 + 0.001 * random->Normal()};
}

struct TwoCampaigns {
  Strings before, after;
  CampaignString& Later(const std::string& id) {
    return *std::find_if(after.begin(), after.end(),
                         [&](const CampaignString& one) { return one.id == id; });
  }
};

TwoCampaigns MakeCampaigns(int groups, int strings, std::uint64_t seed) {
  RandomStream random(seed);
  TwoCampaigns two;
  for (int g = 0; g < groups; ++g) {
    for (int s = 0; s < strings; ++s) {
      CampaignString one = PlainString(fmt::format("elm/comb{:02}/str{:02}", g, s));
      Apply({1 + 0.004 * random.Normal(), 1 + 0.003 * random.Normal(), 1, 1}, &one);
      CampaignString other = one;
      Apply(Noise(&random), &one);
      Apply(Noise(&random), &other);
      two.before.push_back(one);
      two.after.push_back(other);
    }
  }
  return two;
}

Campaign Compare(const TwoCampaigns& two, double level = 0.05) {
  return CompareCampaigns(two.before, two.after, level);
}

CampaignSummary SummaryOf(const TwoCampaigns& two) {
  CampaignSummary summary = SummariseCampaign(Compare(two), two.before, two.after);
  summary.before_version = "0.1.0";
  return summary;
}

// A cell of a later string.
ResultCell CellOf(const TwoCampaigns& two, const std::string& id, const std::string& column) {
  const std::vector<ResultColumn> columns = CampaignColumns();
  for (std::size_t i = 0; i < two.after.size(); ++i) {
    if (two.after[i].id != id) continue;
    const auto cells = CampaignCells(Compare(two), two.before, two.after, i);
    EXPECT_EQ(cells.size(), columns.size());
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (columns[k].name == column) return cells[k];
    }
  }
  ADD_FAILURE() << id << " " << column;
  return {};
}

std::string TextOf(const TwoCampaigns& two, const std::string& id, const std::string& column) {
  const ResultCell cell = CellOf(two, id, column);
  const auto* const text = std::get_if<std::string>(&cell);
  return text == nullptr ? "" : *text;
}

double NumberOf(const TwoCampaigns& two, const std::string& id, const std::string& column) {
  return std::get<double>(CellOf(two, id, column));
}

TEST(Campaign, TheIntervalOfAChangeHoldsItIn95Of100) {
  int inside = 0, all = 0;
  for (int plant = 0; plant < 12; ++plant) {
    TwoCampaigns two = MakeCampaigns(8, 25, plant);
    for (std::size_t i = 0; i < two.after.size(); i += 20) {
      Apply({0.9, 1, 1, 1}, &two.after[i]);
    }
    const Campaign campaign = Compare(two);
    for (std::size_t i = 0; i < two.after.size(); ++i) {
      const double truth = i % 20 == 0 ? std::log(0.9) : 0;
      const CampaignChange& change = campaign.changes[i];
      for (const int q : {int{kCIsc}, int{kCPmax}}) {
        ++all;
        inside += std::fabs(change.own[q] - truth) < 1.96 * change.sigma[q] ? 1 : 0;
      }
    }
  }
  const double rate = static_cast<double>(inside) / all;
  EXPECT_GT(rate, 0.93);
  EXPECT_LT(rate, 0.97);
}

TEST(Campaign, CallsAnyStringChangedAtTheStatedRate) {
  constexpr int kPlants = 400;
  constexpr double kLevel = 0.2;
  int alarms = 0;
  for (int plant = 0; plant < kPlants; ++plant) {
    const Campaign campaign = Compare(MakeCampaigns(6, 12, 1000 + plant), kLevel);
    const bool any = std::any_of(campaign.changes.begin(), campaign.changes.end(),
                                 [](const CampaignChange& one) { return one.rank > 0; });
    alarms += any ? 1 : 0;
  }
  const double rate = static_cast<double>(alarms) / kPlants;
  RecordProperty("rate", std::to_string(rate));
  EXPECT_LT(rate, kLevel * 1.3);
  EXPECT_GT(rate, 0.02) << "not by never calling one changed";
}

TEST(Campaign, AShiftOfAllStringsIsOfThePlantAndNotOfEachString) {
  TwoCampaigns two = MakeCampaigns(10, 20, 3);
  for (CampaignString& one : two.after) Apply({0.96, 1, 1, 1}, &one);
  for (CampaignString& one : two.after) {
    if (one.id.find("comb04") != std::string::npos) Apply({0.95, 1, 1, 1}, &one);
  }
  const CampaignSummary summary = SummaryOf(two);
  EXPECT_EQ(summary.changed, 0);
  EXPECT_NEAR(summary.plant.percent[0].value, -4, 0.4);
  EXPECT_LT(summary.plant.percent[0].low, -4 - 3) << "with the uncertainty of the light";
  EXPECT_THAT(summary.plant.sentence, HasSubstr("light sensor"));
  ASSERT_EQ(summary.groups.size(), 1u);
  EXPECT_EQ(summary.groups[0].name, "elm/comb04");
  EXPECT_NEAR(summary.groups[0].percent[0].value, -8.8, 0.8);
  EXPECT_NEAR(NumberOf(two, "elm/comb04/str03", "change_common_Isc_percent"), -8.8, 0.8);
  EXPECT_EQ(TextOf(two, "elm/comb04/str03", "change_against"), "group");
}

TEST(Campaign, ThePatternOfTheFiguresNamesTheKind) {
  TwoCampaigns two = MakeCampaigns(10, 20, 4);
  Apply({0.9, 1, 1, 1}, &two.Later("elm/comb00/str01"));
  Apply({1, 57.0 / kDiodes, 1, 1}, &two.Later("elm/comb01/str01"));
  Apply({1, 1, 1, 0.95}, &two.Later("elm/comb02/str01"));
  Apply({1, 1, 0.96, 1}, &two.Later("elm/comb03/str01"));
  Apply({1, 0.96, 1, 1}, &two.Later("elm/comb04/str01"));
  two.Later("elm/comb04/str01").bypass_diodes = 0;  // not stated
  Apply({0.93, 0.96, 0.97, 1}, &two.Later("elm/comb05/str01"));
  Apply({0.9, 1, 1, 1}, &two.Later("elm/comb06/str01"));
  two.Later("elm/comb06/str01").repeat = true;
  Apply({1.1, 1, 1, 1}, &two.Later("elm/comb07/str01"));
  const char* const kinds[] = {"light",      "substrings",    "fill_factor", "shunt_or_mismatch",
                               "substrings", "other_modules", "measurement", "light",
                               "none"};
  for (int g = 0; g < 9; ++g) {
    const std::string id = fmt::format("elm/comb0{}/str01", g);
    EXPECT_EQ(TextOf(two, id, "change_kind"), kinds[g]) << id << TextOf(two, id, "change_sentence");
    EXPECT_EQ(TextOf(two, id, "change_action").empty(), g == 8) << id;
  }
  EXPECT_EQ(TextOf(two, "elm/comb00/str01", "change_candidates"), "soiling shading sensor_offset");
  EXPECT_THAT(TextOf(two, "elm/comb00/str01", "change_sentence"),
              HasSubstr("one sweep does not tell which"));
  EXPECT_THAT(TextOf(two, "elm/comb01/str01", "change_sentence"), HasSubstr(", 3 of 60"));
  EXPECT_EQ(TextOf(two, "elm/comb07/str01", "change_candidates"), "cleaning sensor_offset");
  EXPECT_NEAR(NumberOf(two, "elm/comb02/str01", "change_lost_W"), 0.05 * 5760, 40);
  EXPECT_THAT(TextOf(two, "elm/comb02/str01", "change_candidates"),
              ::testing::StartsWith("series_resistance"));
}

TEST(Campaign, SaysWhatTheSweepItselfShows) {
  TwoCampaigns two = MakeCampaigns(10, 20, 5);
  Apply({1, 1, 0.96, 1}, &two.Later("elm/comb03/str01"));
  two.Later("elm/comb03/str01").cause = "shading";
  EXPECT_THAT(TextOf(two, "elm/comb03/str01", "change_sentence"),
              HasSubstr("the sweep itself shows shading"));
}

// A sweep of a usual string, of which parts are changed: i(v) in parts of Isc and Voc. Voc, Imp and
// Vmp of `string` become those of the sweep, with errors.
void SetSweep(double resistance, double shunt, double part, double shade, RandomStream* random,
              CampaignString* string) {
  std::vector<double> v, i;
  for (int k = 0; k <= 400; ++k) {
    const double current = 1 - std::pow(k / 400.0, 3);
    const auto sound = [&](double light) {
      return current < light
                 ? 1 + 0.05 * std::log((light - current) / 1.0) - (0.03 + resistance) * current
                 : -0.03;
    };
    v.push_back((1 - part) * sound(1) + part * std::fmax(sound(1 - shade), -0.03));
    i.push_back(current - shunt * std::fmax(v.back(), 0));
  }
  const double voc = FindKeyPoints(v, i).open_circuit_voltage_V;
  string->sparkline = Sparkline(v, i, voc);
  std::size_t best = 0;
  for (std::size_t k = 0; k < v.size(); ++k) {
    if (v[k] * i[k] > v[best] * i[best]) best = k;
  }
  const auto& values = string->values;
  const double imp = i[best] * values[kCIsc] / values[kCImp];
  const double vmp = v[best] * values[kCVoc] / voc / values[kCVmp];
  const double error = 1 + 0.001 * random->Normal();
  Apply({1, voc, imp * error, vmp * error}, string);
}

// The figures say that the fill factor fell alike; the sweeps say why.
TEST(Campaign, TheShapeOfTheSweepsNamesTheCause) {
  struct Case {
    double resistance, shunt, part, shade;
    const char* kind;
  };
  for (const Case& c : {Case{0.04, 0, 0, 0, "series_resistance"}, Case{0, 0.06, 0, 0, "shunt"},
                        Case{0, 0, 0.1, 0.3, "mismatch"}}) {
    for (const bool gain : {false, true}) {
      RandomStream random(18);
      TwoCampaigns two = MakeCampaigns(10, 20, 16);
      for (Strings* strings : {&two.before, &two.after}) {
        for (CampaignString& one : *strings) SetSweep(0, 0, 0, 0, &random, &one);
      }
      const std::string id = "elm/comb03/str01";
      CampaignString& ill = gain ? *std::find_if(two.before.begin(), two.before.end(),
                                                 [&](const auto& one) { return one.id == id; })
                                 : two.Later(id);
      SetSweep(c.resistance, c.shunt, c.part, c.shade, &random, &ill);
      EXPECT_EQ(TextOf(two, id, "change_kind"), c.kind) << TextOf(two, id, "change_sentence");
      EXPECT_EQ(NumberOf(two, id, "change_lost_W") > 0, !gain) << c.kind;
      EXPECT_GT(NumberOf(two, id, "change_probability"), 0.8);
      const bool repaired = TextOf(two, id, "change_candidates").rfind("repair", 0) == 0;
      EXPECT_EQ(repaired, gain) << TextOf(two, id, "change_candidates");
    }
  }
}

// A bypassed substring of 54 is within what a wrong temperature may be. It is never a gain.
TEST(Campaign, ALostSubstringIsNoRepair) {
  for (int seed = 20; seed < 30; ++seed) {
    TwoCampaigns two = MakeCampaigns(10, 20, seed);
    RandomStream random(seed);
    for (Strings* strings : {&two.before, &two.after}) {
      for (CampaignString& one : *strings) {
        SetSweep(0, 0, 0, 0, &random, &one);
        one.bypass_diodes = 54;
      }
    }
    Apply({1, 53.0 / 54, 1, 1}, &two.Later("elm/comb03/str01"));
    const std::string kind = TextOf(two, "elm/comb03/str01", "change_kind");
    if (kind == "none") continue;
    EXPECT_THAT(TextOf(two, "elm/comb03/str01", "change_candidates"),
                ::testing::AnyOf(HasSubstr("bypass_short"), HasSubstr("temp_offset")))
        << kind;
    EXPECT_GE(NumberOf(two, "elm/comb03/str01", "change_lost_W"), 0);
  }
}

// Figures of another procedure differ by more than a year does.
TEST(Campaign, CarriesAllFiguresInOneWay) {
  TwoCampaigns two = MakeCampaigns(4, 20, 17);
  for (Strings* strings : {&two.before, &two.after}) {
    for (CampaignString& one : *strings) {
      one.measured = one.values;
      one.irradiance_W_m2 = 800;
      one.temperature_C = 45;
      one.procedure = "De Soto";
      for (float& value : one.measured) value *= 0.9F;
    }
  }
  CampaignString& other = two.Later("elm/comb02/str07");
  const auto carried = other.values;
  other.procedure = "extended model";
  for (float& value : other.values) value *= 1.05F;
  CarryInOneWay(&two.before);
  CarryInOneWay(&two.after);
  for (int q = 0; q < kCampaignKept; ++q) {
    EXPECT_NEAR(other.values[q] / carried[q], 1, 1e-5) << q;
  }
  EXPECT_EQ(TextOf(two, "elm/comb02/str07", "change_kind"), "none");
}

TEST(Campaign, RanksByWattsLost) {
  TwoCampaigns two = MakeCampaigns(10, 20, 6);
  Apply({0.88, 1, 1, 1}, &two.Later("elm/comb01/str05"));
  Apply({0.8, 1, 1, 1}, &two.Later("elm/comb02/str05"));
  Apply({1.15, 1, 1, 1}, &two.Later("elm/comb03/str05"));
  const CampaignSummary summary = SummaryOf(two);
  std::vector<std::string> ids;
  for (const StringChange& change : summary.changes) ids.push_back(change.id);
  EXPECT_THAT(ids, ElementsAre("elm/comb02/str05", "elm/comb01/str05", "elm/comb03/str05"));
  EXPECT_EQ(summary.changes[2].rank, 3);
  EXPECT_LT(summary.changes[2].cause.recoverable_power_W.value, 0) << "it gained";
  EXPECT_NEAR(summary.lost_W, (0.12 + 0.2) * 5760, 150);
  EXPECT_NEAR(summary.gained_W, 0.15 * 5760, 100);
}

TEST(Campaign, NamesStringsThatAreGoneNewOrRenamed) {
  TwoCampaigns two = MakeCampaigns(10, 20, 7);
  two.Later("elm/comb01/str05").id = "elm/comb01/other";  // the same figures under another name
  two.Later("elm/comb02/str05").id = "elm/comb03/added";  // of another group: gone and new
  two.after.erase(
      std::remove_if(two.after.begin(), two.after.end(),
                     [](const CampaignString& one) { return one.id.rfind("elm/comb09", 0) == 0; }),
      two.after.end());
  const CampaignSummary summary = SummaryOf(two);
  EXPECT_THAT(summary.gone_ids, ElementsAre("elm/comb01/str05", "elm/comb02/str05"));
  EXPECT_THAT(summary.fresh_ids, ElementsAre("elm/comb01/other", "elm/comb03/added"));
  EXPECT_EQ(summary.not_repeated, 20) << "a group that was not measured again is not gone";
  EXPECT_EQ(TextOf(two, "elm/comb01/other", "change_kind"), "renamed");
  EXPECT_EQ(TextOf(two, "elm/comb01/other", "change_partner"), "elm/comb01/str05");
  EXPECT_EQ(TextOf(two, "elm/comb03/added", "change_kind"), "new");
  EXPECT_EQ(summary.compared, 178);
}

TEST(Campaign, AnIdOfSeveralCurvesIsNotCompared) {
  TwoCampaigns two = MakeCampaigns(2, 20, 8);
  two.before[1].id = two.before[0].id;
  EXPECT_THAT(TextOf(two, two.after[0].id, "change_sentence"), HasSubstr("several curves"));
  EXPECT_EQ(TextOf(two, two.after[0].id, "change_kind"), "");
  two.Later("elm/comb01/str03").values[kCPmax] = std::nanf("");
  EXPECT_EQ(TextOf(two, "elm/comb01/str03", "change_sentence"),
            "not compared: this sweep has no figures at standard conditions");
}

// The strings of two places are exchanged. The first has had a module less and more resistance since
// before the first campaign.
TwoCampaigns Exchanged(std::size_t ill, std::size_t other) {
  TwoCampaigns two = MakeCampaigns(10, 20, 9);
  const Factors factors = {1, 57.0 / kDiodes, 1, 0.96};
  Apply(factors, &two.before[ill]);
  Apply(factors, &two.Later(two.before[ill].id));
  std::swap(two.after[ill].id, two.after[other].id);
  std::swap(two.after[ill], two.after[other]);
  return two;
}

TEST(Campaign, NamesTwoExchangedStrings) {
  const TwoCampaigns two = Exchanged(25, 33);
  const CampaignSummary summary = SummaryOf(two);
  ASSERT_EQ(summary.exchanged.size(), 1u);
  EXPECT_EQ(summary.exchanged[0], std::pair(two.before[25].id, two.before[33].id));
  EXPECT_EQ(TextOf(two, two.before[25].id, "change_partner"), two.before[33].id);
}

TEST(Campaign, CablesAreNotExchangedBetweenCombiners) {
  EXPECT_TRUE(SummaryOf(Exchanged(25, 130)).exchanged.empty());
}

TEST(Campaign, DoesNotDecideBetweenTwoPartners) {
  TwoCampaigns two = MakeCampaigns(10, 20, 10);
  const Factors ill = {1, 57.0 / kDiodes, 1, 1};
  Apply(ill, &two.before[25]);  // it is repaired,
  Apply(ill, &two.after[30]);   // and two others of its combiner fail alike
  Apply(ill, &two.after[36]);
  const CampaignSummary summary = SummaryOf(two);
  EXPECT_TRUE(summary.exchanged.empty());
  EXPECT_EQ(TextOf(two, two.after[30].id, "change_kind"), "substrings");
  EXPECT_THAT(TextOf(two, two.after[25].id, "change_sentence"),
              HasSubstr("or exchanged with elm/comb01"));
  EXPECT_THAT(TextOf(two, two.after[25].id, "change_candidates"), HasSubstr("exchanged"));
}

TEST(Campaign, OfFewStringsUsesTheReportedUncertainty) {
  TwoCampaigns two = MakeCampaigns(1, 3, 11);
  Apply({0.97, 1, 1, 1}, &two.after[0]);  // within the uncertainty of 3 % of each
  Apply({0.8, 1, 1, 1}, &two.after[1]);
  EXPECT_EQ(TextOf(two, two.after[0].id, "change_kind"), "none");
  EXPECT_EQ(TextOf(two, two.after[1].id, "change_kind"), "light");
  EXPECT_EQ(TextOf(two, two.after[1].id, "change_against"), "nothing");
}

TEST(Campaign, OfNoStringsIsNoError) {
  const TwoCampaigns none;
  EXPECT_EQ(SummaryOf(none).compared, 0);
  TwoCampaigns other = MakeCampaigns(1, 8, 12);
  for (CampaignString& one : other.after) one.id += "x";
  EXPECT_EQ(SummaryOf(other).fresh, 8);
  EXPECT_EQ(SummaryOf(other).compared, 0);
}

TEST(Campaign, AgainstItselfHasNoChange) {
  TwoCampaigns two = MakeCampaigns(4, 10, 14);
  two.after = two.before;
  EXPECT_EQ(SummaryOf(two).changed, 0);
  EXPECT_EQ(SummaryOf(two).plant.percent[0].value, 0);
  EXPECT_EQ(NumberOf(two, two.after[3].id, "change_lost_W"), 0);
}

TEST(Campaign, ANewNameWithoutFiguresIsNew) {
  TwoCampaigns two = MakeCampaigns(4, 10, 15);
  two.after[3].id = "elm/comb00/other";
  two.after[3].values.fill(std::nanf(""));
  EXPECT_EQ(TextOf(two, "elm/comb00/other", "change_kind"), "new");
}

TEST(Campaign, StringsWithoutAGroupAreComparedWithThePlant) {
  TwoCampaigns two = MakeCampaigns(10, 4, 13);  // groups of four are too small
  Apply({0.85, 1, 1, 1}, &two.after[5]);
  EXPECT_EQ(TextOf(two, two.after[5].id, "change_against"), "plant");
  EXPECT_EQ(TextOf(two, two.after[5].id, "change_kind"), "light");
  EXPECT_EQ(SummaryOf(two).changed, 1);
}

}  // namespace
}  // namespace lyrefit
