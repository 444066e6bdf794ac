#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lyrefit/report/documents.h"
#include "sample_fits.h"

namespace lyrefit {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(FitsDocument, HasARowAFitAndSaysWhyOthersHaveNone) {
  const auto lines = LinesOf(DrawText(FitsDocument(SampleFits())));
  ASSERT_EQ(lines.size(), 14U);
  EXPECT_THAT(lines[0], EndsWith(": fits of 3 curves"));
  EXPECT_EQ(lines[2], "Parameters");
  EXPECT_THAT(lines[3], HasSubstr("Iph"));
  EXPECT_THAT(lines[5], StartsWith("  a.csv  sd         26         9.891e-04       7.730e-04"));
  EXPECT_THAT(lines[5], EndsWith("0.036547  52.890  NOT USABLE"));
  EXPECT_THAT(lines[6], EndsWith("0.036300  53.700  not polished"));
  EXPECT_EQ(lines[8], "Not fitted");
  EXPECT_EQ(lines[9], "  - b, c.csv: b, c.csv:2:3: expected a number, found 'x'");
  EXPECT_EQ(lines[11], "Warnings");
  EXPECT_EQ(lines[13], "  - a.csv: second");
}

TEST(FitsDocument, OfBrokenFilesAloneHasNoTable) {
  const Document document = FitsDocument({{"a.csv", Fail("empty")}});
  ASSERT_EQ(document.sections.size(), 1U);
  EXPECT_EQ(document.sections[0].heading, "Not fitted");
}

}  // namespace
}  // namespace lyrefit
