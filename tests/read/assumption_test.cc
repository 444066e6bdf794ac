#include "lyrefit/curve/assumption.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lyrefit/read/settle_conditions.h"
#include "lyrefit/read/table_head.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(AssumptionTest, IsTakenBackWithAllOthersOfItsKind) {
  std::vector<Assumption> assumptions = {"first",
                                         {"irradiance not given", About::kIrradiance},
                                         "irradiance: a word that stands in a sentence only",
                                         {"another sentence", About::kIrradiance}};
  Forget(About::kCells, &assumptions);
  EXPECT_EQ(assumptions.size(), 4U);
  Forget(About::kIrradiance, &assumptions);
  EXPECT_THAT(SentencesOf(assumptions),
              ElementsAre("first", "irradiance: a word that stands in a sentence only"));
}

TEST(AssumptionTest, EveryWayToTakeAConditionSaysWhatItIsAbout) {
  IvCurve curve;
  curve.temperature_C = {30, 50};
  curve.irradiance_W_m2 = {700, 900};
  TableHead head;
  ReadHeadLine("Irradiance: 500 W/m2", 1, HeadLine::kText, &head);
  ReadHeadLine("Cell temperature: 25 C", 2, HeadLine::kText, &head);
  Sidecar beside;
  beside.irradiance_W_m2 = 1000;
  beside.temperature_C = 20;
  Sidecar stated = MergeHead(beside, head.said);
  const std::vector<Assumption> said = HeadSentences(head);
  stated.assumptions.insert(stated.assumptions.end(), said.begin(), said.end());
  SettleConditions(stated, &curve);
  for (const char* sentence : {"taken from", "in the head", "in the table", "the column of"}) {
    EXPECT_THAT(SentencesOf(curve.assumptions), Contains(HasSubstr(sentence)));
  }
  EXPECT_EQ(curve.assumptions.size(), 9U);  // four from each source, and the cells
  Forget(About::kIrradiance, &curve.assumptions);
  EXPECT_THAT(SentencesOf(curve.assumptions), Not(Contains(HasSubstr("rradiance"))));
  Forget(About::kTemperature, &curve.assumptions);
  EXPECT_THAT(SentencesOf(curve.assumptions), ElementsAre(kCellsAssumed));
  Forget(About::kCells, &curve.assumptions);
  EXPECT_THAT(SentencesOf(curve.assumptions), IsEmpty());
}

}  // namespace
}  // namespace lyrefit
