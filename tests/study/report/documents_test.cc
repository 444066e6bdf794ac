#include "lyrefit/study/report/documents.h"

#include <gtest/gtest.h>

#include "report/well_formed.h"
#include "sample_audit.h"
#include "sample_comparison.h"

namespace lyrefit {
namespace {

TEST(StudyDocuments, AreWellFormedPages) {
  if (!HasXmlLint()) GTEST_SKIP() << "xmllint is not there (Debian's libxml2-utils)";
  Comparison outlier = SampleComparison();
  outlier.problems[0].curve_name = "<!-- & ]]> \"curve\"";
  outlier.interrupted = true;
  const std::vector<Document> documents = {AuditDocument(SampleAudit()), CompareDocument(outlier)};
  for (const Document& document : documents) {
    EXPECT_EQ(Complaints(DrawHtml(document)), "") << document.head.heading;
  }
}

}  // namespace
}  // namespace lyrefit
