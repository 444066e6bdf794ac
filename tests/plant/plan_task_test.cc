#include "plant/plan_task.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lyrefit/batch/count_rows.h"
#include "plant/plant_page.h"
#include "plant/plant_runs.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

constexpr char kPlanSheet[] =
    R"({"name": "Oak", "cells_in_series": 60, "short_circuit_current_A": 9,
 "open_circuit_voltage_V": 42, "max_power_current_A": 8.2, "max_power_voltage_V": 34})";

// Rows of eight strings a combiner, one of which has lost an eighth of its voltage.
std::string RowsWithFault(int count) {
  std::string rows;
  for (int i = 0; i < count; ++i) {
    SyntheticString string{fmt::format("site/comb{}/str{}", i / 8, i)};
    string.isc_A = 9 + 0.01 * (i % 7);
    string.voc_V = (i == 13 ? 35 : 40) + 0.02 * (i % 5);
    rows += RowOf(string);
  }
  return rows;
}

std::shared_ptr<const PlantPlan> PlanOfEight(const TempFolder& folder) {
  folder.Write("oak.json", kPlanSheet);
  const auto plan = ReadPlantPlan(
      folder.Write("plan.csv", "id,modules_in_series,module\nsite,8,oak.json\nsite/comb2,8,\n"));
  return plan ? *plan : nullptr;
}

TEST(PlanTask, SlopeIsThatOfTheDiodeAtOpenCircuit) {
  const double iph = 9, a = 20, rs = 3;  // V = a ln(1 + (Iph - I) / Is) - I Rs
  std::vector<double> voltage, current;
  for (int k = 0; k <= 40; ++k) {
    const double i = iph * k / 41.0;
    current.push_back(i);
    voltage.push_back(a * std::log((iph - i) / 1e-9) - i * rs);
  }
  EXPECT_NEAR(SlopeAtOpenCircuit(voltage, current, iph), rs + a / iph, 1e-6);
  voltage.resize(4);
  current.resize(4);
  EXPECT_TRUE(std::isnan(SlopeAtOpenCircuit(voltage, current, iph))) << "too few readings";
  EXPECT_TRUE(std::isnan(SlopeAtOpenCircuit(voltage, current, kUnknown)));
}

TEST(PlanTask, SameBytesOnThreadsShardsAndResumedRuns) {
  const TempFolder folder;
  const std::string input = folder.Write("in.jsonl", RowsWithFault(400));
  for (const bool planned : {true, false}) {
    const auto plan = planned ? PlanOfEight(folder) : nullptr;
    ASSERT_EQ(plan != nullptr, planned);
    const BatchTaskType task = WithPlan(CountTask(), plan);
    const std::string name = planned ? "plan" : "alone";
    const std::string one = folder.Path(name + "1"), two = folder.Path(name + "2");
    ASSERT_TRUE(RunOn(input, task, IntoPlant(one, 1)));
    const auto stopped = RunOn(input, task, IntoPlant(two, 3), StopAfter(20));
    ASSERT_TRUE(stopped);
    EXPECT_TRUE(stopped->interrupted);
    BatchOptions again = IntoPlant(two, 3);
    again.start = BatchStart::kResume;
    ASSERT_TRUE(RunOn(input, task, again));
    for (int k = 1; k <= 3; ++k) {
      BatchOptions shard = IntoPlant(folder.Path(name + "shards"));
      shard.shard = {k, 3};
      ASSERT_TRUE(RunOn(input, task, shard));
    }
    const std::string merged = folder.Path(name + "merged");
    PlantResults found;
    const auto summary = MergeShards({folder.Path(name + "shards")}, MergedInto(merged, &found));
    ASSERT_TRUE(summary) << summary.error().ToString();
    EXPECT_EQ(ResultsIn(two), ResultsIn(one));
    EXPECT_EQ(ResultsIn(merged), ResultsIn(one));
    EXPECT_THAT(FileText(one + "/results.csv"), HasSubstr(",plan_cause,plan_cause_title,"));
    // An eighth of 60 cells is neither a module nor a substring, where no plan says what a module is.
    const std::string cause = planned ? "missing_module" : "wrong_module_type";
    EXPECT_EQ(found.plan_causes, (std::map<std::string, std::int64_t>{{cause, 1}}));
  }
}

TEST(PlanTask, AnotherPlanIsAnotherRun) {
  const TempFolder folder;
  const std::string input = folder.Write("in.jsonl", RowsWithFault(400));
  const auto plan = PlanOfEight(folder);
  ASSERT_TRUE(plan);
  const auto stopped =
      RunOn(input, WithPlan(CountTask(), plan), IntoPlant(folder.Path("out"), 1), StopAfter(5));
  ASSERT_TRUE(stopped);
  BatchOptions again = IntoPlant(folder.Path("out"));
  again.start = BatchStart::kResume;
  const auto other = RunOn(input, WithPlan(CountTask(), nullptr), again);
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message, HasSubstr("plan"));
}

TEST(PlanTask, NamesTheFaultsOfTheScaleInTheMadePlantAndNoOthers) {
  const std::string data = std::string(LYREFIT_DATA_DIR) + "/plant/";
  const auto plan = ReadPlantPlan(data + "plan.csv");
  ASSERT_TRUE(plan) << plan.error().ToString();
  const TempFolder folder;
  std::map<std::string, std::string> named;
  const auto source = OpenBatch({data + "strings.csv"});
  ASSERT_TRUE(source);
  const auto summary =
      RunBatch(source->get(), WithPlan(CountTask(), *plan), IntoPlant(folder.Path("out")), {},
               [&](const std::vector<ResultColumn>& columns, const ResultRow& row) {
                 const auto& cause = row.cells[ColumnPlace(columns, "plan_cause")];
                 if (!std::holds_alternative<std::string>(cause)) return;
                 named[std::get<std::string>(row.cells[0])] = std::get<std::string>(cause);
               });
  ASSERT_TRUE(summary);
  // truth.csv: soiled_string, shorted_diodes, missing_module, bad_connector.
  const std::map<std::string, std::string> hidden = {
      {"elm/inv01/comb05/str19", "uniform_soiling"},
      {"elm/inv01/comb07/str10", "bypassed_substring"},
      {"elm/inv01/comb09/str05", "missing_module"},
      {"elm/inv02/comb05/str09", "cable_resistance"}};
  EXPECT_EQ(named, hidden);
}

TEST(PlanTask, PageListsTheFaultWithWattsAndWhatToDo) {
  const TempFolder folder;
  const std::string input = folder.Write("in.jsonl", RowsWithFault(24));
  const auto plan = PlanOfEight(folder);
  ASSERT_TRUE(RunOn(input, WithPlan(CountTask(), plan), IntoPlant(folder.Path("out"))));
  ASSERT_TRUE(WritePlantPage(folder.Path("out"), folder.Path("page.html"), "Oak"));
  const std::string page = FileText(folder.Path("page.html"));
  EXPECT_THAT(page, HasSubstr("Which strings to visit first"));
  EXPECT_THAT(page, HasSubstr("1 need"));
  EXPECT_THAT(page, HasSubstr("module missing or shorted"));
  EXPECT_THAT(page, HasSubstr("has the voltage of 1 module of 8 too few"));
  EXPECT_THAT(page, HasSubstr("count the modules of the string"));
}

}  // namespace
}  // namespace lyrefit
