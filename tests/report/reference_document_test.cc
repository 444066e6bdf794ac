#include "lyrefit/report/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sample_reference.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(ReferenceText, SaysWhatDiffersThenShowsTheTable) {
  const std::string text = ReferenceText(SampleReference());
  EXPECT_THAT(text, HasSubstr("today against reference sweeps\n"));
  EXPECT_THAT(text, HasSubstr("12 reference sweeps, brought to this sweep's Isc and Voc"));
  EXPECT_THAT(text, HasSubstr("misses 0.11 % of Isc"));
  EXPECT_THAT(text, HasSubstr("73.20     73.70  73.500 .. 73.900  -6.1  -0.68 %  differs"));
  EXPECT_THAT(text, HasSubstr("series_resistance  8.00 %  6.90 .. 9.10   -0.62 %      97 %"));
  EXPECT_THAT(text, HasSubstr("wet: unlike the other reference sweeps"));
  EXPECT_THAT(text, HasSubstr("a warning"));
  EXPECT_LT(text.find("Unlike its 12"), text.find("fill factor"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

TEST(ReferenceText, SaysThatSeveralCausesCannotBeTold) {
  ReferenceComparison c = SampleReference();
  EXPECT_THAT(ReferenceText(c), Not(HasSubstr("cannot tell")));
  c.causes.push_back(c.causes.front());
  EXPECT_THAT(ReferenceText(c), HasSubstr("these sweeps cannot tell one from the other"));
}

TEST(ReferenceText, BriefIsOneLine) {
  EXPECT_EQ(BriefReference(SampleReference()),
            "today: Unlike its 12 reference sweeps (p = 3e-06): series resistance +8 %: -0.62 % of "
            "Pmax.\n");
}

TEST(OutlierSweepsText, ShowsTheOutlierOnesOnly) {
  const std::string text = OutlierSweepsText(SampleOutlierSweeps());
  EXPECT_THAT(text, HasSubstr("2 sweeps, each with the nearest"));
  EXPECT_THAT(text, HasSubstr("outliers      1\n"));
  EXPECT_THAT(text, HasSubstr("\ntoday\n"));
  EXPECT_THAT(text, Not(HasSubstr("yesterday")));
  EXPECT_THAT(text, HasSubstr("night: the curve is dark"));
  EXPECT_THAT(BriefOutlierSweeps(SampleOutlierSweeps()), HasSubstr("outliers: 1 of 2 sweeps\n"));
}

TEST(OutlierSweepsDocument, HasWhatIsSaidOfASweepBelowIt) {
  const Document document = OutlierSweepsDocument(SampleOutlierSweeps());
  ASSERT_GE(document.sections.size(), 2U);
  EXPECT_EQ(document.sections[0].heading, "today");
  EXPECT_EQ(document.sections[0].depth, 0);
  EXPECT_EQ(document.sections[1].depth, 1);
  EXPECT_EQ(document.sections.back().heading, "Not compared");
  EXPECT_EQ(document.sections.back().depth, 0);
}

}  // namespace
}  // namespace lyrefit
