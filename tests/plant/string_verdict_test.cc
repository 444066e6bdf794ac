#include "plant/string_verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// A row of these cells, judged.
StringVerdict Judged(const std::map<std::string, ResultCell>& cells) {
  std::vector<ResultColumn> columns;
  ResultRow row;
  for (const auto& [name, cell] : cells) {
    columns.push_back({name, "", CellType::kText, name});
    row.cells.push_back(cell);
  }
  return StringJudge(columns).Judge(row);
}

std::map<std::string, ResultCell> With(std::map<std::string, ResultCell> cells,
                                       const std::map<std::string, ResultCell>& others) {
  for (const auto& [name, cell] : others) cells[name] = cell;
  return cells;
}

std::map<std::string, ResultCell> Curve(const char* zone, const char* cause, const char* about) {
  return {{"status", "fine"},         {"zone", zone},
          {"cause", cause},           {"cause_about", about},
          {"cause_title", "a title"}, {"cause_sentence", "a sentence"},
          {"action", "an action"},    {"recoverable_power_W", 50.0}};
}

std::map<std::string, ResultCell> Plan(const char* cause, const char* about, double lost_W) {
  return {{"plan_cause", cause},
          {"plan_cause_about", about},
          {"plan_cause_title", "Module missing"},
          {"plan_sentence", "The string has the voltage of 1 module of 20 too few"},
          {"plan_action", "count the modules"},
          {"plan_probability", 0.92},
          {"plan_lost_W", lost_W},
          {"plan_modules_in_series", std::int64_t{20}}};
}

TEST(StringJudge, DoesWhatRatingAndCauseCallFor) {
  const auto to_do = [](const char* zone, const char* cause, const char* about) {
    return Judged(Curve(zone, cause, about)).to_do;
  };
  EXPECT_EQ(to_do("fail", "shading", "device"), ToDo::kWork);
  EXPECT_EQ(to_do("undecided", "shading", "device"), ToDo::kWork);
  EXPECT_EQ(to_do("pass within uncertainty", "weak_cell", "device"), ToDo::kInspect);
  EXPECT_EQ(to_do("fail", "irr_step", "sweep"), ToDo::kMeasureAgain);
  EXPECT_EQ(to_do("pass", "low_ideality", "conditions"), ToDo::kMeasureAgain);
  // Wrong readings are left out: nothing more is to be done about them.
  EXPECT_EQ(to_do("pass", "outliers", "instrument"), ToDo::kNothing);
  EXPECT_EQ(to_do("undecided", "outliers", "instrument"), ToDo::kNothing);
  EXPECT_EQ(to_do("fail", "outliers", "instrument"), ToDo::kWork);
  const StringVerdict failed = Judged({{"status", "fine"}, {"zone", "fail"}});
  EXPECT_EQ(failed.to_do, ToDo::kWork);
  EXPECT_THAT(failed.cause.action, HasSubstr("count the modules"));
  EXPECT_EQ(Judged({{"status", "fine"}, {"zone", "pass"}}).to_do, ToDo::kNothing);
}

// What neither curve nor plan names, a loss since the last campaign does.
TEST(StringJudge, NamesWhatChangedSinceTheLastCampaign) {
  const std::map<std::string, ResultCell> change = {
      {"status", "fine"},
      {"zone", "undecided"},
      {"change_kind", "substrings"},
      {"change_candidates", "bypass_short missing_module"},
      {"change_sentence", "the voltage of whole groups of cells is missing"},
      {"change_action", "Count the modules."},
      {"change_probability", 0.9},
      {"change_lost_W", 90.0}};
  const StringVerdict verdict = Judged(change);
  EXPECT_EQ(verdict.cause.id, "bypass_short");
  EXPECT_THAT(verdict.cause.equivalents, ElementsAre("missing_module"));
  EXPECT_EQ(verdict.from, "campaign");
  EXPECT_EQ(verdict.to_do, ToDo::kWork);
  EXPECT_EQ(verdict.cause.recoverable_power_W.value, 90);
  EXPECT_THAT(SentencesOf(verdict)[0], HasSubstr("by its change since the last campaign"));
  EXPECT_EQ(Judged(With(change, {{"change_lost_W", -90.0}})).to_do, ToDo::kNothing) << "a gain";
  EXPECT_EQ(Judged(With(change, {{"change_kind", "exchanged"}})).cause.id, "");
  EXPECT_EQ(Judged(With(change, {{"change_kind", "temperature"}, {"change_lost_W", 0.0}})).to_do,
            ToDo::kMeasureAgain);
  EXPECT_EQ(Judged(With(change, Plan("missing_module", "device", 230))).from, "plan");
}

TEST(StringJudge, PutsThePlanInThePlaceOfWhatTheCurveDoesNotShow) {
  const auto missing = Plan("missing_module", "device", 230);
  const StringVerdict none = Judged(With({{"status", "fine"}, {"zone", "undecided"}}, missing));
  EXPECT_EQ(none.cause.id, "missing_module");
  EXPECT_EQ(none.from, "plan");
  EXPECT_EQ(none.to_do, ToDo::kWork);
  EXPECT_EQ(none.cause.recoverable_power_W.value, 230);
  const StringVerdict disturbed =
      Judged(With(Curve("undecided", "outliers", "instrument"), missing));
  EXPECT_EQ(disturbed.cause.id, "missing_module");
  // A resistance of the curve is that of a cable, unless the curve loses more by it.
  const auto resistive = Curve("fail", "series_resistance", "device");
  EXPECT_EQ(Judged(With(resistive, Plan("cable_resistance", "device", 60))).cause.id,
            "cable_resistance");
  EXPECT_EQ(Judged(With(resistive, Plan("cable_resistance", "device", 20))).cause.id,
            "series_resistance");
  // Another fault of the device stays.
  EXPECT_EQ(Judged(With(Curve("fail", "shading", "device"), missing)).cause.id, "shading");
  EXPECT_EQ(
      Judged(With({{"status", "fine"}, {"zone", "pass"}}, Plan("extra_module", "plan", 0))).to_do,
      ToDo::kCorrectPlan);
}

TEST(StringJudge, NamesNothingOfAStringThatOnlyDiffers) {
  const StringVerdict differs =
      Judged({{"status", "fine"}, {"cause", {}}, {"group_outlier", "FF -1.13 %"}});
  EXPECT_EQ(differs.cause.id, "");
  EXPECT_EQ(differs.to_do, ToDo::kInspect);
  EXPECT_EQ(Judged({{"status", "fine"}, {"zone", "pass"}, {"group_outlier", "FF -1.13 %"}}).to_do,
            ToDo::kNothing);
  const StringVerdict not_compared = Judged(
      With(Curve("pass", "shading", "device"),
           {{"plan_sentence", "not judged by its scale, since the curve itself shows shading"}}));
  EXPECT_EQ(not_compared.cause.sentence, "a sentence");
  EXPECT_EQ(Judged(With(Curve("fail", "shading", "device"), {{"status", "broken"}})).cause.id, "");
}

TEST(StringJudge, JudgesNoRowsOfATaskWithoutCauses) {
  EXPECT_FALSE(StringJudge({{"id", "", CellType::kText, ""}}).judges());
  EXPECT_TRUE(StringJudge({{"plan_cause", "", CellType::kText, ""}}).judges());
}

TEST(StringVerdict, IsSaidInSentences) {
  auto cells = With({{"status", "fine"}, {"zone", "undecided"}, {"group_outlier", "Voc -5.16 %"}},
                    Plan("missing_module", "device", 230));
  cells["plan_equivalents"] = "wrong_module_type";
  cells["plan_separate_by"] = "count the modules in the string";
  EXPECT_THAT(
      SentencesOf(Judged(cells)),
      ElementsAre("Undecided against the rating. Module missing (92 %, by its plan and its "
                  "neighbours): The string has the voltage of 1 module of 20 too few.",
                  "Against the others of its combiner: Voc -5.16 %.",
                  "To do: work: count the modules.",
                  "It may also be wrong module type; to tell: count the modules in the string."));
  EXPECT_THAT(SentencesOf(Judged({{"status", "fine"}, {"zone", "pass"}})),
              ElementsAre("Pass against the rating. No cause is named, by the curve or by its "
                          "neighbours.",
                          "To do: nothing."));
}

TEST(StringCells, StandUnderTheirColumns) {
  const StringVerdict verdict =
      Judged(With({{"status", "fine"}}, Plan("missing_module", "device", 230)));
  const auto cells = StringCells(verdict);
  const auto columns = StringColumns();
  ASSERT_EQ(cells.size(), columns.size());
  EXPECT_EQ(columns[1].name, "string_cause");
  EXPECT_EQ(std::get<std::string>(cells[1]), "missing_module");
  EXPECT_EQ(columns.back().name, "string_lost_W");
  EXPECT_EQ(std::get<double>(cells.back()), 230);
}

}  // namespace
}  // namespace lyrefit
