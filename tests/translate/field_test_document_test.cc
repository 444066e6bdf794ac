#include <gtest/gtest.h>

#include "golden.h"
#include "lyrefit/translate/translation_parts.h"
#include "sample_field_test.h"

namespace lyrefit {
namespace {

std::string TextOf(std::vector<Section> sections) {
  Document document;
  AddSections(std::move(sections), &document);
  return DrawText(document);
}

TEST(FieldTestText, SaysWhatTheGoldenFileHas) {
  Golden golden("field_test");
  golden.Add("a test against the rating", TextOf(FieldTestSections(SampleFieldTest())));
  golden.Add("its checklist", TextOf({ChecklistSection(SampleChecklist())}));
  golden.Add("a budget", TextOf({BudgetSection("Budget of Pmax", SampleBudget(), 0)}));
  golden.Add("a budget without draws",
             TextOf({BudgetSection("Budget of Pmax", SampleBudget(0), 0)}));
  golden.Check();
}

TEST(BudgetSection, IsEmptyWithoutABudget) {
  EXPECT_TRUE(BudgetSection("Budget", {}, 4).blocks.empty());
}

}  // namespace
}  // namespace lyrefit
