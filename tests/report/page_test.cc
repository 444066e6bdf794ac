#include "lyrefit/report/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "certify/sample_certificate.h"
#include "diagnose/sample_diagnosis.h"
#include "diagnose/sample_reference.h"
#include "family/sample_family.h"
#include "lyrefit/certify/certificate_documents.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/family/family_documents.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/page_shell.h"
#include "sample_document.h"
#include "sample_report.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Text of the script element with this id.
std::string ScriptOf(const std::string& html, const std::string& id) {
  const std::size_t at = html.find("id=\"" + id + "\">");
  EXPECT_NE(at, std::string::npos) << id;
  const std::size_t begin = html.find('>', at) + 1;
  return html.substr(begin, html.find("</script>", begin) - begin);
}

int Count(const std::string& html, const std::string& what) {
  int count = 0;
  for (std::size_t at = html.find(what); at != std::string::npos; at = html.find(what, at + 1)) {
    ++count;
  }
  return count;
}

void ExpectInOrder(const std::string& html, const std::vector<std::string>& parts) {
  std::size_t at = html.find("<body>");
  for (const std::string& part : parts) {
    const std::size_t next = html.find(part, at);
    ASSERT_NE(next, std::string::npos) << part;
    at = next;
  }
}

TEST(DrawPage, SaysVerdictAndWarningsFirstThenThePictureThenTheRest) {
  FitReport report = SampleReport();
  report.warnings = {"a warning"};
  const std::string html = DrawPage(FitDocument(report), JsonReport(report));
  ExpectInOrder(
      html, {"<h1>", "<h2>Verdict</h2>", "<h2>Warnings</h2>", "a warning", "<main",
             "<figure id=\"figure-1\"", "<figcaption", "<dt>curve</dt>", "<nav class=\"contents\"",
             "<h2>Parameters</h2>", "measured-current", ">difference<"});
  EXPECT_EQ(Count(html, "<h2>Warnings</h2>"), 1);
}

TEST(WithVerdictAhead, StandsBeforeTheLinesOfThePageAndReplacesItself) {
  const std::string html = DrawPage(FitDocument(SampleReport()), JsonReport(SampleReport()));
  const std::string once = WithVerdictAhead(html, {"Module <missing>.", "To do: count."}, "Alone:");
  ExpectInOrder(once, {"<h2>Verdict</h2>", "<strong>Module &lt;missing&gt;.</strong>",
                       "<strong>To do: count.</strong>", "<p>Alone:</p>", "<p>", "<main"});
  EXPECT_EQ(WithVerdictAhead(WithVerdictAhead(html, {"Another."}, "Alone:"),
                             {"Module <missing>.", "To do: count."}, "Alone:"),
            once);
  EXPECT_EQ(WithVerdictAhead("<p>no verdict</p>", {"A line."}, "Alone:"), "<p>no verdict</p>");
}

TEST(DrawPage, SaysTheVerdictOfADiagnosisOnce) {
  const Diagnosis diagnosis = SampleDiagnosis();
  const Document document = DiagnosisDocument(diagnosis);
  const std::string html = DrawPage(document, DiagnosisJson(diagnosis));
  EXPECT_EQ(Count(html, "<h2>Verdict</h2>"), 1);
  EXPECT_EQ(Count(html, "<p>" + document.verdict), 1);
  ExpectInOrder(html, {"<h2>Verdict</h2>", "<figure id=\"figure-1\"", "Cause 1 of"});
}

TEST(DrawPage, FoldsTheEvidenceOfADiagnosis) {
  const Diagnosis diagnosis = SampleDiagnosis();
  const std::string html = DrawPage(DiagnosisDocument(diagnosis), DiagnosisJson(diagnosis));
  ExpectInOrder(html, {"Cause 1 of 1", "<dt>to do</dt>", "<details class=\"fold\">",
                       "<summary><h2>Parameters of", "<summary><h2>What the readings show</h2>",
                       "Effects tried", "</details>"});
  EXPECT_EQ(Count(html, "<details class=\"fold\">"), 8);
  EXPECT_THAT(DrawHtml(DiagnosisDocument(diagnosis)), HasSubstr("<details class=\"fold\">"));
}

TEST(DrawPage, HoldsTheRecord) {
  const FitReport report = SampleReport();
  const std::string json = JsonReport(report);
  const std::string html = DrawPage(FitDocument(report), json);
  EXPECT_EQ(nlohmann::json::parse(ScriptOf(html, "record")), nlohmann::json::parse(json));
}

TEST(DrawPage, PacksALargeRecord) {
  const std::string json = "[\"" + std::string(300000, 'x') + "\"]";
  const std::string html = DrawPage(FitDocument(SampleReport()), json);
  EXPECT_EQ(ScriptOf(html, "record"), Packed(json));
}

TEST(DrawPage, HasAChartForEveryPictureUnlessItIsToStandStill) {
  if (!PlotlyIsEmbedded()) GTEST_SKIP() << "this build has no Plotly";
  const Document document = DiagnosisDocument(SampleDiagnosis());
  const auto chart = nlohmann::json::parse(ScriptOf(DrawPage(document, "{}"), "figure-1-chart"));
  EXPECT_FALSE(chart.at("data").empty());
  PageOptions still;
  still.interactive = false;
  const std::string html = DrawPage(document, "{}", still);
  EXPECT_THAT(html, Not(HasSubstr("figure-1-chart")));
  EXPECT_THAT(html, Not(HasSubstr("id=\"plotly\"")));
  EXPECT_THAT(html, HasSubstr("<svg "));
}

TEST(DrawPage, HasAPlaceForTheRowsOfALongTable) {
  Document document;
  document.head.heading = "rows";
  block::LongTable table;
  table.links = "results/";
  table.columns = {{"<b>", "what it is", true, false}};
  document.sections = {{"All rows", {table}}};
  const std::string html = DrawPage(document, "");
  EXPECT_EQ(Count(html, kRowsElement), 1);
  EXPECT_THAT(html, HasSubstr("<div id=\"rows-table\">"));
  const auto known = nlohmann::json::parse(ScriptOf(html, "rows-columns"));
  EXPECT_EQ(known.at("links"), "results/");
  EXPECT_EQ(
      known.at("columns")[0],
      (nlohmann::json{{"name", "<b>"}, {"doc", "what it is"}, {"number", true}, {"shown", false}}));
  EXPECT_EQ(DrawText(document).find("All rows"), std::string::npos);
  EXPECT_THAT(DrawHtml(document), Not(HasSubstr("rows-table")));
  EXPECT_THAT(DrawMarkdown(document), HasSubstr("All rows"));
  if (TabulatorIsEmbedded()) {
    EXPECT_THAT(html, HasSubstr("Permission is hereby granted"));
  }
  EXPECT_EQ(Count(html, "id=\"tabulator\">H4sI"), TabulatorIsEmbedded() ? 1 : 0);
}

TEST(DrawPage, ShowsThePictureInNumbers) {
  const FitReport report = SampleReport();
  const std::string html = DrawPage(FitDocument(report), "{}");
  const std::size_t at = html.find("<details class=\"readings\">");
  ASSERT_NE(at, std::string::npos);
  const std::string readings = html.substr(at, html.find("</details>", at) - at);
  EXPECT_EQ(Count(readings, "<tr>"), 1 + static_cast<int>(report.curve.size()));
}

TEST(DrawPage, ThinsManyReadingsAndSaysSo) {
  FitReport report = SampleReport();
  const std::size_t count = 20000;
  report.curve.voltage_V.clear();
  report.curve.current_A.clear();
  for (std::size_t i = 0; i < count; ++i) {
    report.curve.voltage_V.push_back(0.5 * static_cast<double>(i) / count);
    report.curve.current_A.push_back(0.7 - report.curve.voltage_V.back());
  }
  report.residual_A.assign(count, 1e-3);
  const std::string html = DrawPage(FitDocument(report), "{}");
  EXPECT_THAT(html, HasSubstr("of 20000 readings; the others are in the data of the page."));
  EXPECT_LT(html.size(), 2000000);
}

TEST(DrawPage, LetsNoNameOutOfItsPlace) {
  FitReport report = SampleReport();
  report.curve.name = "</script><script>alert(1)</script>\"'<!--%{x}\x01\xe9";
  report.warnings = {"<img src=x onerror=alert(1)>"};
  report.rmse.refined.solved_current_A = kUnknown;
  const std::string html = DrawPage(FitDocument(report), JsonReport(report));
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(html, Not(HasSubstr("<img")));
  EXPECT_THAT(html, Not(HasSubstr("\x01")));
  EXPECT_THAT(html, Not(HasSubstr("\xe9")));
  EXPECT_TRUE(nlohmann::json::accept(ScriptOf(html, "record")));
  if (PlotlyIsEmbedded()) {
    EXPECT_TRUE(nlohmann::json::accept(ScriptOf(html, "figure-1-chart")));
  }
  EXPECT_THAT(DrawPage(HostileDocument(), "{}"), Not(HasSubstr("<b>")));
}

TEST(DrawPage, HasNoPictureOfAReportWithoutReadings) {
  FitReport report = SampleReport();
  report.curve.voltage_V.clear();
  report.curve.current_A.clear();
  EXPECT_THAT(DrawPage(FitDocument(report), "{}"), Not(HasSubstr("<figure")));
}

TEST(DrawPage, SaysWhereThereIsNoGnuplotAndKeepsTheNumbers) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  const std::string html = DrawPage(FitDocument(SampleReport()), "{}");
  setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(html, HasSubstr("The picture could not be drawn: plots need gnuplot"));
  EXPECT_THAT(html, HasSubstr("<details class=\"readings\">"));
}

TEST(DrawPage, DrawsEveryRecord) {
  const SampleFamily family = MakeSampleFamily(8);
  const std::vector<Document> documents = {
      FamilyDocument(family.report, family.set), DiagnosisDocument(SampleUpDown()),
      DiagnosisDocument(SampleLitAndDark()), CertificateDocument(RtcCertificate()),
      ReferenceDocument(SampleReference(), SampleDiagnosis())};
  for (const Document& document : documents) {
    const std::string html = DrawPage(document, "{}");
    EXPECT_EQ(Count(html, "<figure id="), 1) << document.head.heading;
    EXPECT_EQ(Count(html, "<svg "), 1) << document.head.heading;
    EXPECT_THAT(html, HasSubstr("<h2>Verdict</h2>"));
  }
}

TEST(DrawPage, ChangesNoText) {
  const std::string text = DiagnosisText(SampleDiagnosis());
  EXPECT_THAT(text, Not(HasSubstr("band of what one diode misses")));
  EXPECT_EQ(Count(text, "voltage (V)"), 0);
}

}  // namespace
}  // namespace lyrefit
