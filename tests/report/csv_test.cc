#include "lyrefit/report/csv.h"
#include "lyrefit/certify/certificate_documents.h"
#include "lyrefit/read/spreadsheet_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "certify/sample_certificate.h"
#include "golden.h"

namespace lyrefit {
namespace {

using ::testing::StartsWith;

TEST(CsvField, PutsAnApostropheBeforeWhatASpreadsheetWouldRun) {
  for (const char* text :
       {"=1+1", "+1+1", "-1-1", "@SUM(1)", "=cmd|' /C calc'!A0", "\t=1", " =1", "\tx", "\r1", "--1",
        "-x", "'=1", "''=1", "-1e", "-.", "-1.2.3", "-inf", "+nan",
        "\xef\xbc\x9d"
        "1"}) {
    const std::string field = CsvField(std::string(text));
    const std::string bare = field.front() == '"' ? field.substr(1, field.size() - 2) : field;
    EXPECT_EQ(bare, std::string("'") + text);
    EXPECT_EQ(WithoutApostrophe(bare), text);
  }
  EXPECT_EQ(CsvField(std::string("=a,b")), "\"'=a,b\"");
  EXPECT_EQ(CsvField(std::string("=1"), CsvTexts::kRaw), "=1");
}

TEST(CsvField, LeavesEverythingElse) {
  for (const char* text : {"", "str 1", "-0.5", "+49", "-1e-5", "-.5", "-5.", " -3 ", "1-1", "a=b",
                           "-", "+", "it's", "'quoted'", "'-0.5", "5 %"}) {
    EXPECT_EQ(CsvField(std::string(text)), text);
    EXPECT_EQ(WithoutApostrophe(text), text);
  }
  EXPECT_EQ(CsvField(-0.5), "-0.5");
  EXPECT_EQ(CsvField(std::string("a\xff")), "a\xef\xbf\xbd");
}

TEST(CertificateCsv, HasTheFloorAndEveryModel) {
  const auto lines = LinesOf(CertificateCsv(RtcCertificate()));
  ASSERT_EQ(lines.size(), 2 + RtcCertificate().models.size());
  for (const std::string& line : lines) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','),
              std::count(lines[0].begin(), lines[0].end(), ','));
  }
  EXPECT_THAT(lines[1], StartsWith("floor,yes,0.00098248"));
  EXPECT_THAT(lines[2], StartsWith("sd,yes,"));
}

TEST(CsvField, IsQuotedWhereItHasTo) {
  EXPECT_EQ(CsvField("plain"), "plain");
  EXPECT_EQ(CsvField("a, \"b\""), "\"a, \"\"b\"\"\"");
  EXPECT_EQ(CsvField(0.1), "0.1");
  EXPECT_EQ(CsvField(kUnknown), "");
}

}  // namespace
}  // namespace lyrefit
