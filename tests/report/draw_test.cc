#include <gtest/gtest.h>

#include "certify/sample_certificate.h"
#include "devices/sample_data_sheet.h"
#include "diagnose/sample_diagnosis.h"
#include "diagnose/sample_reference.h"
#include "family/sample_family.h"
#include "golden.h"
#include "lyrefit/certify/certificate_documents.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/family/family_documents.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "sample_document.h"
#include "sample_fits.h"
#include "sample_report.h"
#include "well_formed.h"

namespace lyrefit {
namespace {

Document PlainDocument() {
  Document document;
  document.banners = {"INTERRUPTED: early."};
  document.head.heading = "title";
  AddField("curve", "a.csv", &document.head);
  AddField("", "b.csv", &document.head);
  Section section = {"Parameters"};
  AddTable({"lr", {{"", "value"}, {"name", "A"}}, {{"Rs", "1"}, {"n"}}}, &section);
  block::Table linked = {"lr", {{"string", "value"}}, {{"a", "1"}, {"b", "2"}, {"c"}}};
  linked.links = {"./pages/a.html?\"", ""};
  AddTable(linked, &section);
  AddSentence("A sentence.", &section);
  AddList({"one", "two"}, &section);
  section.blocks.push_back(block::Preformatted{"a   b\n"});
  section.blocks.push_back(block::Figure{"seen elsewhere"});
  AddSections({section, {"", {block::Conclusion{"The end."}}}}, &document);
  return document;
}

Document Of(block::Any block) { return {{}, {"", {std::move(block)}}}; }

// Words of 60 and 80 letters, of which two do not fit on a line.
std::string Long(int letters) {
  const std::string word(letters, 'x');
  return word + " " + word;
}

FamilyReport TwoCurves() {
  FamilyReport report;
  report.cells_in_series = 60;
  report.curves.resize(2);
  report.curves[0].id = "1";
  report.curves[0].parameters = {1, 2, 3, 4, 5};
  report.curves[0].individual_parameters = {6.1, 1.25e-10, 1.1, 0.3, 400};
  report.curves[1].id = "2,b";
  report.curves[1].parameters = {6, 1e-9, 1, 0.25, 500};
  return report;
}

FitReport OfTwoDiodes() {
  FitReport larger = SampleReport();
  larger.model = Model::kDoubleDiode;
  larger.device = MakeDevice(larger.model, larger.curve.conditions);
  larger.estimates.clear();
  for (const ParameterInfo& info : larger.device.parameters) {
    Estimate estimate;
    estimate.info = info;
    estimate.refined = 2;
    larger.estimates.push_back(estimate);
  }
  return larger;
}

Diagnosis OfTwoCauses() {
  Diagnosis some;
  Cause cause;
  cause.id = "shading";
  cause.title = "partial shading";
  cause.power_effect = {0.02, 0.01, 0.03};
  cause.equivalents = {"weak_cell", "substrings"};
  some.verdict.causes = {cause};
  cause.id = "clip";
  some.verdict.below_floor = {cause};
  return some;
}

Diagnosis WithoutCause() {
  Diagnosis none;
  none.verdict.sentence = "nothing";
  return none;
}

TEST(Document, IsDrawnAsTheGoldenFileHasIt) {
  Golden golden("drawn");
  const auto add = [&](const std::string& title, std::string text) {
    for (char& c : text) c = c == '\x01' ? '?' : c;
    golden.AddLong(title, text);
  };
  add("plain, text", DrawText(PlainDocument()));
  add("plain, HTML", DrawHtml(PlainDocument()));
  add("markup, HTML", DrawHtml(HostileDocument()));
  add("markup, Markdown", DrawMarkdown(HostileDocument()));
  Document numbers;
  AddSections({{"", {block::Sentence{"2.5 A"}, block::Sentence{"-3 V"}}}}, &numbers);
  add("numbers, Markdown", DrawMarkdown(numbers));
  Document written;
  written.head = {"`a`", {block::Sentence{"**b** " + Long(60)}}};
  AddTable({"lr", {{"name", "A"}}, {{"a|b", "**1**"}, {"short"}}}, &written.head);
  add("of Markdown, Markdown", DrawMarkdown(written, Texts::kMarkdown));
  add("columns as wide as their widest cells, text",
      DrawText(Of(block::Table{"lr", {{"name", "value"}}, {{"\u00b5", "1"}, {"alone"}}})));
  add("long texts in the last column, text",
      DrawText(Of(block::Table{"rw", {{"RMSE", "what"}}, {{"1", Long(80)}, {"2"}}})));
  add("a caption, text", DrawText(Of(block::Table{"lr", {{"", "A"}}, {{"x", "1"}}, "Currents"})));
  add("lines across the table, text", DrawText(Of(block::Table{"lr",
                                                               {{"name", "A"}},
                                                               {{"x", "1"}, {"y", "2"}, {"z", "3"}},
                                                               "",
                                                               {{0, "first"}, {2, Long(60)}}})));
  add("a title and what belongs to it, text",
      DrawText(Of(block::Entry{"Ranks", {"a 1, b 2", "c 3"}})));
  add("a title alone, text", DrawText(Of(block::Entry{"Ranks"})));
  add("a legend, text", DrawText(Of(block::Legend{"Columns are budgets."})));
  add("a warning, text", DrawText(Of(block::Warning{"Look twice."})));
  Document headed;
  AddSections({{"RMSE   (all)", {block::Sentence{"a"}}},
               {std::string(60, 'x') + "  " + std::string(60, 'x'), {block::Sentence{"b"}}}},
              &headed);
  add("headings, text", DrawText(headed));
  add("fits, CSV", FitsCsv(SampleFits()));
  add("fits of two models, CSV", FitsCsv({{"a.csv", SampleReport()}, {"b.csv", OfTwoDiodes()}}));
  add("broken files alone, CSV", FitsCsv({{"a.csv", Fail("empty")}}));
  FamilyReport family = TwoCurves();
  add("individual fits, CSV", IndividualFitsCsv(family));
  family.translation.spec.model = Model::kDoubleDiode;
  family.curves[0].individual_parameters.insert(family.curves[0].individual_parameters.end(),
                                                {1e-7, 2});
  family.curves[1].parameters.clear();
  add("individual fits of two diodes, one without parameters, CSV", IndividualFitsCsv(family));
  add("causes, CSV", CausesCsv({"a", "b"}, {OfTwoCauses(), WithoutCause()}));
  add("outlier sweeps, CSV", OutlierSweepsCsv(SampleOutlierSweeps()));
  add("data sheet, CSV", DataSheetCsv(SampleDataSheetFit()));
  golden.Check();
  EXPECT_EQ(DrawText({}), "");
  EXPECT_EQ(DrawMarkdown({}), "");
}

TEST(DrawHtml, ReplacesWhatIsNoText) {
  Document document;
  AddField("latin", "\xe9t\xc3\xa9 \x1b[1m \xff", &document.head);
  EXPECT_NE(DrawHtml(document).find("<dd>\xef\xbf\xbdt\xc3\xa9 \xef\xbf\xbd[1m \xef\xbf\xbd</dd>"),
            std::string::npos);
  EXPECT_EQ(DrawHtml(HostileDocument()).find('\x01'), std::string::npos);
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

TEST(AddSections, LeavesOutWhatHasNothingToSay) {
  Document document;
  AddSections({{"full", {block::Sentence{"a"}}},
               {"empty"},
               ListSection("no list", {}),
               ListSection("list", {"b"})},
              &document);
  ASSERT_EQ(document.sections.size(), 2U);
  EXPECT_EQ(document.sections[0].heading, "full");
  EXPECT_EQ(document.sections[1].heading, "list");
}

TEST(AddField, KeepsTheOrderInWhichThingsAreSaid) {
  Section section;
  AddField("name", "text", &section);
  AddSentence("sentence", &section);
  AddTable({"l", {{"head"}}}, &section);
  AddList({}, &section);
  ASSERT_EQ(section.blocks.size(), 3U);
  EXPECT_EQ(std::get<block::Field>(section.blocks[0]).text, "text");
  EXPECT_EQ(std::get<block::Sentence>(section.blocks[1]).text, "sentence");
  EXPECT_EQ(std::get<block::Table>(section.blocks[2]).heads.size(), 1U);
}

}  // namespace
}  // namespace lyrefit
