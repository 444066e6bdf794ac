#include "plant/synthetic_score.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "temp_folder.h"

namespace made {
namespace {

using lyrefit::TempFolder;

using testing::HasSubstr;

std::string ScoreOf(const std::string& results) {
  const TempFolder folder;
  folder.Write("results.csv", results);
  folder.Write("truth.csv",
               "id,fault,accepted,shows_in,loss_percent,words\n"
               "a/1,pole_shadow,shading|substrings,curve,5,shade\n"
               "a/2,missing_module,temp_offset|Voc-,neighbours,5,missing\n");
  std::string text;
  EXPECT_EQ(Score({folder.Path("results.csv"), folder.Path("truth.csv")}, &text), "");
  return text;
}

TEST(SyntheticScore, CountsWhatIsFoundAndUnderWhichName) {
  const std::string text = ScoreOf(
      "id,cause,equivalents,group_flag,group_outlier\n"
      "a/1,weak_cell,\"shading, transient\",false,\n"
      "a/2,,,true,\"FF -1.00 % (usual: within 0.5 %), Voc +5.00 % (usual: within 0.5 %)\"\n"
      "a/3,,,false,\n");
  EXPECT_THAT(text, HasSubstr("2 of 2 hidden faults found, 1 under a right name\n0 false alarms "
                              "among 1 healthy strings"));
  EXPECT_THAT(text, HasSubstr("(5 %): beside its neighbours FF -1.00 %"));
  EXPECT_THAT(text, HasSubstr("[another name]"));
}

TEST(SyntheticScore, NamesTheSideOnWhichAStringDiffers) {
  const std::string text = ScoreOf(
      "id,cause,equivalents,group_flag,group_outlier\na/1,,,false,\n"
      "a/2,,,true,Voc -5.00 % (usual: within 0.5 %)\n");
  EXPECT_THAT(text, HasSubstr("1 of 2 hidden faults found, 1 under a right name"));
  EXPECT_THAT(text, HasSubstr("not found"));
}

TEST(SyntheticScore, AWrongCauseIsNotMadeRightByTheNeighbours) {
  const std::string text = ScoreOf(
      "id,cause,group_flag,group_outlier\na/1,,false,\n"
      "a/2,transient,true,Voc -5.00 % (usual: within 0.5 %)\n");
  EXPECT_THAT(text, HasSubstr("1 of 2 hidden faults found, 0 under a right name"));
}

TEST(SyntheticScore, CountsFalseAlarms) {
  const std::string text =
      ScoreOf("id,cause,zone\na/1,,\na/2,,\na/3,drift,fail\na/4,outliers,pass\na/5,,pass\n");
  EXPECT_THAT(text, HasSubstr("2 false alarms among 3 healthy strings (cause 2, neighbours 0, zone "
                              "1); 1 of them of the instrument alone"));
  EXPECT_THAT(text, HasSubstr("  a/3: drift; fail"));
}

TEST(SyntheticScore, RefusesATableWithoutIds) {
  const TempFolder folder;
  folder.Write("results.csv", "name\na\n");
  folder.Write("truth.csv", "id\n");
  std::string text;
  EXPECT_THAT(Score({folder.Path("results.csv"), folder.Path("truth.csv")}, &text),
              testing::EndsWith("results.csv has no column id"));
}

TEST(SyntheticScore, CountsTheChangesOfALaterCampaign) {
  const TempFolder folder;
  folder.Write("results.csv",
               "id,change_rank,change_kind,change_candidates,change_lost_W,change_lost_W_low_95,"
               "change_lost_W_high_95\n"
               "a/1,1,light,soiling shading,100,90,110\n"
               "a/2,,none,,3,-50,50\n"
               "a/3,2,voltage,bypass_short,40,30,50\n"
               "a/5,,none,,1,-50,50\n");
  folder.Write("truth.csv",
               "id,change,accepted,partner,lost_W,words\n"
               "a/1,dirt,soiling,,95.0,dirt\n"
               "a/2,hot_connector,series_resistance,,30.0,ohm\n"
               "a/4,gone,gone,,0.0,not there\n");
  folder.Write("campaign.json", "{\"gone_ids\": [\n\"a/4\"\n]}");
  std::string text;
  ASSERT_EQ(ScoreChanges({folder.Path("results.csv"), folder.Path("campaign.json"),
                          folder.Path("truth.csv")},
                         &text),
            "");
  EXPECT_THAT(text, HasSubstr("found 2 of 3 (20.8 to 93.9 %), under a right name 2 of 2"));
  EXPECT_THAT(text, HasSubstr("false 1 of 2"));
  EXPECT_THAT(text, HasSubstr("100 stated of 95, median error 5 W, in the 95 % interval 1 of 1"));
  EXPECT_THAT(text, HasSubstr("a/2  hot_connector (30.0 W): not found"));
  EXPECT_THAT(text, HasSubstr("a/3  not changed: voltage"));
}

}  // namespace
}  // namespace made
