#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lyrefit/report/record_parts.h"
#include "sample_field_test.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string TextOf(std::vector<Section> sections) {
  Document document;
  AddSections(std::move(sections), &document);
  return DrawText(document);
}

TEST(BudgetSection, ShowsTheLargestShareFirstAndCountsTheSmall) {
  const std::string text = TextOf({BudgetSection("Budget of Pmax", SampleBudget(), 0)});
  EXPECT_THAT(text,
              HasSubstr("light sensor          12 W/m2    1.50 %  93.4 %  certificate of the"));
  EXPECT_LT(text.find("light sensor"), text.find("temperature sensor"));
  EXPECT_THAT(text, Not(HasSubstr("balance")));
  EXPECT_THAT(text, HasSubstr("1 line of less than 0.05 % each"));
  EXPECT_THAT(text, HasSubstr("Together 1.55 % of Pmax, expanded (k = 2) 3.10 %"));
  EXPECT_THAT(text, HasSubstr("20000 draws (seed 0)"));
  EXPECT_THAT(text, HasSubstr("W: agree.\n"));
}

TEST(BudgetSection, SaysNothingOfDrawsThatWereNotDone) {
  const std::string text = TextOf({BudgetSection("Budget of Pmax", SampleBudget(0), 0)});
  EXPECT_THAT(text, Not(HasSubstr("draws")));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

TEST(BudgetSection, IsEmptyWithoutABudget) {
  EXPECT_TRUE(BudgetSection("Budget", {}, 4).blocks.empty());
}

TEST(FieldTestSections, SayTheVerdictFirstThenItsFigures) {
  const FieldTest test = SampleFieldTest();
  const std::string text = TextOf(FieldTestSections(test));
  EXPECT_THAT(text, HasSubstr("fail within uncertainty: 400.0 W at standard conditions"));
  EXPECT_LT(text.find("fail within"), text.find("rating of the string"));
  EXPECT_THAT(text, HasSubstr("405.0 .. 425.2 W"));
  EXPECT_THAT(text, HasSubstr("performance factor         0.996"));
  EXPECT_THAT(text, HasSubstr("flat prior"));
  EXPECT_THAT(text, HasSubstr("uniform soiling"));
  EXPECT_THAT(text, HasSubstr("Budget of the performance factor"));
}

TEST(ChecklistSection, ShowsEveryConditionAndWhatWouldMakeItKnown) {
  const Checklist list = SampleChecklist();
  const std::string text = TextOf({ChecklistSection(list)});
  for (const CheckedCondition& each : list.conditions) {
    EXPECT_THAT(text, HasSubstr(each.title.substr(0, 14))) << each.id;
  }
  EXPECT_THAT(text, HasSubstr("640 W/m2"));
  EXPECT_THAT(text, HasSubstr("not known"));
  EXPECT_THAT(text, HasSubstr("record the time of the readings"));
}

}  // namespace
}  // namespace lyrefit
