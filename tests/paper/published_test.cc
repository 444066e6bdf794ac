#include "paper/published.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "temp_folder.h"

namespace lyrefit {
namespace {

using testing::HasSubstr;

TEST(ReadPublished, ReadsTheShippedFileWhole) {
  const auto values = ReadPublished(LYREFIT_DATA_DIR "/paper/published.csv");
  ASSERT_TRUE(values.has_value()) << values.error().ToString();
  EXPECT_EQ(values->size(), 164U);
  EXPECT_EQ(values->front().table, "Table 3");
  EXPECT_EQ(values->front().text, "4.39308E-03");
  EXPECT_DOUBLE_EQ(values->front().value, 4.39308e-3);
}

TEST(ReadPublished, NamesFileLineAndColumnOfWhatItCannotRead) {
  const TempFolder folder;
  const std::string path = folder.Write("p.csv",
                                        "table,curve,model,algorithm,quantity,value,note\n"
                                        "Table 1,rtc,sd,mlo,min,1e-3,\n"
                                        "Table 1,rtc,sd,mlo,mean,much,\n");
  const auto values = ReadPublished(path);
  ASSERT_FALSE(values.has_value());
  EXPECT_THAT(values.error().ToString(), HasSubstr("p.csv:3:25"));
  EXPECT_THAT(values.error().ToString(), HasSubstr("expected a number, found 'much'"));
}

TEST(ReadPublished, RefusesATableWithoutItsColumns) {
  const TempFolder folder;
  const auto values = ReadPublished(folder.Write("p.csv", "table,curve\nTable 1,rtc\n"));
  ASSERT_FALSE(values.has_value());
  EXPECT_THAT(values.error().ToString(), HasSubstr("expected a column 'model'"));
}

// Runs of one algorithm; the tests split them into two batches of four.
Comparison TwoBatches(const std::vector<double>& searched) {
  Comparison comparison;
  ProblemResult problem;
  problem.curve_name = "rtc";
  problem.model = Model::kTripleDiode;
  AlgorithmResult compared;
  compared.name = "mlo";
  for (const double rmse : searched) {
    RunRecord run;
    run.searched_A = rmse;
    compared.runs.push_back(run);
  }
  problem.algorithms = {compared};
  comparison.problems = {problem};
  return comparison;
}

PublishedValue Printed(const std::string& quantity, const std::string& text) {
  PublishedValue value;
  value.curve = "rtc";
  value.model = Model::kTripleDiode;
  value.algorithm = "mlo";
  value.quantity = quantity;
  value.text = text;
  value.value = std::stod(text);
  return value;
}

TEST(CheckPublished, TakesTheStatisticOfEachBatch) {
  const Comparison comparison = TwoBatches({1e-3, 2e-3, 3e-3, 4e-3, 4e-3, 5e-3, 6e-3, 9e-3});
  const auto checked = CheckPublished({Printed("min", "2.0e-3")}, comparison, 4);
  ASSERT_EQ(checked.size(), 1U);
  EXPECT_EQ(checked[0].batches, 2);
  EXPECT_NEAR(checked[0].ours, std::sqrt(1e-3 * 4e-3), 1e-12);
  // Two logarithms ln 4 apart have the standard deviation ln 4 / sqrt 2; t(0.995, 1) = 63.657.
  const double reach = 63.6567 * std::log(4.0) / std::sqrt(2.0) * std::sqrt(1.5);
  EXPECT_NEAR(std::log(checked[0].high / checked[0].ours), reach, 1e-2 * reach);
  EXPECT_EQ(checked[0].check, Check::kCannotTell) << "two batches a factor of 4 apart";
}

TEST(CheckPublished, ToleratesTheRoundingOfThePrintButNoMore) {
  const Comparison comparison = TwoBatches(std::vector<double>(8, 9.860218779e-4));
  EXPECT_EQ(CheckPublished({Printed("min", "9.86022E-04")}, comparison, 4)[0].check,
            Check::kReproduced);
  EXPECT_EQ(CheckPublished({Printed("min", "9.86023E-04")}, comparison, 4)[0].check,
            Check::kNotReproduced);
}

TEST(CheckPublished, LeavesOutWhatNoRunSpeaksOf) {
  const Comparison comparison = TwoBatches(std::vector<double>(8, 1e-3));
  PublishedValue other = Printed("min", "1e-3");
  other.curve = "msx60";
  EXPECT_TRUE(CheckPublished({other, Printed("seconds", "57.7")}, comparison, 4).empty());
  EXPECT_TRUE(CheckPublished({Printed("min", "1e-3")}, comparison, 8).empty()) << "one batch";
}

}  // namespace
}  // namespace lyrefit
