#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "certify/sample_certificate.h"
#include "devices/sample_data_sheet.h"
#include "diagnose/sample_diagnosis.h"
#include "diagnose/sample_reference.h"
#include "family/sample_family.h"
#include "lyrefit/certify/certificate_documents.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/family/family_documents.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "sample_document.h"
#include "sample_report.h"
#include "well_formed.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(DrawHtml, LinksRowsOfATable) {
  Document document;
  Section section = {"Strings"};
  block::Table table = {"lr", {{"string", "value"}}, {{"a", "1"}, {"b", "2"}, {"c"}}};
  table.links = {"./pages/a.html?\"", ""};
  AddTable(table, &section);
  AddSections({section}, &document);
  const std::string html = DrawHtml(document);
  EXPECT_THAT(html, HasSubstr("<a href=\"./pages/a.html?&quot;\">a</a></th>"));
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">b</th>"));
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">c</th>"));
}

TEST(DrawHtml, IsAPageOfPlainElements) {
  Document document;
  document.banners = {"INTERRUPTED: early."};
  document.head.heading = "title";
  AddField("curve", "a.csv", &document.head);
  AddField("", "b.csv", &document.head);
  Section section = {"Parameters"};
  AddTable({"lr", {{"", "value"}}, {{"Rs", "1"}, {"n"}}}, &section);
  AddSentence("A sentence.", &section);
  AddList({"one", "two"}, &section);
  AddSections({section, {"", {block::Conclusion{"The end."}}}}, &document);
  EXPECT_EQ(DrawHtml(document), R"(<!DOCTYPE html>
<html xmlns="http://www.w3.org/1999/xhtml" lang="en">
<head>
<meta charset="utf-8"/>
<title>title</title>
<style>th { text-align: left } .number { text-align: right }</style>
</head>
<body>
<p role="alert"><strong>INTERRUPTED: early.</strong></p>
<header>
<h1>title</h1>
<dl>
<dt>curve</dt><dd>a.csv</dd>
<dd>b.csv</dd>
</dl>
</header>
<section>
<h2>Parameters</h2>
<table>
<thead>
<tr><td></td><th scope="col" class="number">value</th></tr>
</thead>
<tbody>
<tr><th scope="row">Rs</th><td class="number">1</td></tr>
<tr><th scope="row">n</th><td class="number"></td></tr>
</tbody>
</table>
<p>A sentence.</p>
<ul>
<li>one</li>
<li>two</li>
</ul>
</section>
<section>
<p><strong>The end.</strong></p>
</section>
</body>
</html>
)");
}

TEST(DrawHtml, EscapesNames) {
  const std::string html = DrawHtml(HostileDocument());
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("<b>")));
  EXPECT_THAT(html, Not(HasSubstr("\x01")));
  EXPECT_THAT(html,
              HasSubstr("<title>report of &lt;/title&gt;&lt;script&gt;alert(&quot;1 &amp; 2"));
  EXPECT_THAT(html, HasSubstr("<dd>a_b_c.csv &amp; &#39;others&#39;</dd>"));
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">&lt;td&gt;|&lt;/td&gt;</th>"));
  EXPECT_THAT(html, HasSubstr("<pre>a   &lt;b&gt;\n```\n</pre>"));
  EXPECT_THAT(html, HasSubstr("<caption>of &lt;a&gt;</caption>"));
  EXPECT_THAT(html, HasSubstr("<tr><th scope=\"colgroup\" colspan=\"2\">&amp; last</th></tr>"));
  EXPECT_THAT(html, HasSubstr("<p>* &lt;star&gt;</p>"));
  EXPECT_THAT(html, HasSubstr("<p role=\"note\"><strong>&lt;!</strong></p>"));
  EXPECT_THAT(html, HasSubstr("<dl>\n<dt>a_b &amp; c</dt><dd>x &lt; y</dd><dd>- z</dd>\n"
                              "<dt>alone</dt><dd></dd>\n</dl>"));
  EXPECT_THAT(html, HasSubstr("<img src=\"a.svg\" alt=\"seen &quot;there&quot;\"/>"));
  EXPECT_THAT(html, HasSubstr("<h3>below</h3>"));
}

TEST(DrawHtml, ReplacesWhatIsNoText) {
  Document document;
  AddField("latin", "\xe9t\xc3\xa9 \x1b[1m \xff", &document.head);
  EXPECT_THAT(DrawHtml(document), HasSubstr("<dd>\xef\xbf\xbdt\xc3\xa9 \xef\xbf\xbd[1m \xef\xbf\xbd"
                                            "</dd>"));
}

TEST(DrawHtml, IsWellFormedForEveryRecord) {
  if (!HasXmlLint()) GTEST_SKIP() << "xmllint is not there (Debian's libxml2-utils)";
  FitReport fit = SampleReport();
  fit.curve.name = "<!-- & ]]> \"curve\" \x07 \xe9";
  fit.warnings = {"a < b"};
  fit.usable = false;
  const std::vector<Document> documents = {HostileDocument(),
                                           FitDocument(fit),
                                           FitsDocument({{"<a>", fit}, {"b", Fail("x < y")}}),
                                           FamilyDocument(MakeSampleFamily(8).report),
                                           DiagnosisDocument(SampleDiagnosis()),
                                           ReferenceDocument(SampleReference()),
                                           OutlierSweepsDocument(SampleOutlierSweeps()),
                                           CertificateDocument(RtcCertificate()),
                                           DataSheetDocument(SampleDataSheetFit())};
  for (const Document& document : documents) {
    EXPECT_EQ(Complaints(DrawHtml(document)), "") << document.head.heading;
  }
}

}  // namespace
}  // namespace lyrefit
