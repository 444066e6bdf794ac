#include "plant/synthetic_scale.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "temp_folder.h"

namespace made {
namespace {

using lyrefit::FileText;
using lyrefit::TempFolder;
using testing::HasSubstr;

TEST(SyntheticScale, SameSeedSameBytesOnAnyThreads) {
  const TempFolder folder;
  ASSERT_EQ(WriteScalePlants({folder.Path("one"), 1, 5, 1}), "");
  ASSERT_EQ(WriteScalePlants({folder.Path("two"), 2, 5, 2}), "");
  for (const char* file :
       {"plant000/strings.csv", "plant000/plan.csv", "plant000/truth.csv", "type2.json"}) {
    const std::string text = FileText(folder.Path(std::string("one/") + file));
    EXPECT_FALSE(text.empty()) << file;
    EXPECT_EQ(text, FileText(folder.Path(std::string("two/") + file))) << file;
  }
}

TEST(SyntheticScale, ScoreTakesDirtAndASensorThatReadsHighForOneName) {
  const TempFolder folder;
  folder.Write("plant000/truth.csv",
               "id,fault,power_W\n"
               "p/c/1,light_sensor,1\np/c/2,light_sensor,1\np/c/3,missing_module,1\n"
               "p/c/4,reversed_module,1\np/c/5,,1\np/c/6,shape,1\np/c/7,shared light_sensor,1\n"
               "p/c/8,shared light_sensor,1\n");
  folder.Write("plant000/plan/results.csv",
               "id,plan_cause,plan_equivalents,plan_Isc_percent\n"
               "p/c/1,uniform_soiling,light_sensor,-9\n"  // right
               "p/c/2,uniform_soiling,,9\n"               // a sensor that reads low is no dirt
               "p/c/3,bypassed_substring,missing_module temperature_sensor,0\n"  // in the set
               "p/c/4,,,\n"                                                      // silent
               "p/c/5,cable_resistance,,0\n"                                     // healthy
               "p/c/6,,,\n"
               "p/c/7,light_sensor,,-15\n"  // counts once
               "p/c/8,light_sensor,,-15\n");
  std::string text;
  ASSERT_EQ(ScoreScalePlants({folder.Path(""), "plan", true}, &text), "");
  EXPECT_THAT(text, HasSubstr("first name right                 2 of     5"));
  EXPECT_THAT(text, HasSubstr("wrong claims of all claims       2 of     5"));
  EXPECT_THAT(text, HasSubstr("claims of healthy strings        1 of     1"));
  EXPECT_THAT(text, HasSubstr("in the set 1, wrong 0, silent 0  bypassed_substring 1"));
}

}  // namespace
}  // namespace made
