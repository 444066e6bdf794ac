#include <gtest/gtest.h>

#include "golden.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/report/documents.h"
#include "sample_reference.h"

namespace lyrefit {
namespace {

TEST(ReferenceText, SaysWhatTheGoldenFileHas) {
  Golden golden("reference");
  ReferenceComparison comparison = SampleReference();
  golden.Add("one cause", ReferenceText(comparison));
  comparison.causes.push_back(comparison.causes.front());
  golden.AddChanges("two causes", ReferenceText(comparison));
  golden.Add("a folder of sweeps: the outliers", OutlierSweepsText(SampleOutlierSweeps()));
  golden.AddLong("one cause in brief", BriefReference(SampleReference()));
  golden.AddLong("the outliers in brief", BriefOutlierSweeps(SampleOutlierSweeps()));
  golden.Check();
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
