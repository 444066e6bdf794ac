#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/translate/translation_documents.h"
#include "sample_translation.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(TranslationText, SaysTheAnswerThenAllProceduresThenTheBudget) {
  const std::string text = TranslationText(SampleTranslation());
  const std::size_t answer = text.find("here, k = 2"), table = text.find("Procedures");
  const std::size_t budget = text.find("Budget of Pmax");
  ASSERT_NE(answer, std::string::npos) << text;
  EXPECT_LT(answer, table);
  EXPECT_LT(table, budget);
  EXPECT_THAT(text, HasSubstr("Recommended is De Soto"));
  EXPECT_THAT(text, HasSubstr("needs a second curve"));
  EXPECT_THAT(text, HasSubstr("300 draws (seed 7)"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

TEST(TranslationText, IsShortWithoutWhatIsFurther) {
  const std::string text = TranslationText(SampleTranslation(), Length::kShort);
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 24) << text;
  EXPECT_LT(text.find("Pmax "), text.find("here, k = 2"));
  EXPECT_THAT(text, HasSubstr("% of the variance of Pmax comes of: "));
  for (const char* part : {"Procedures", "Budget of", "Coefficients", "How it was made"}) {
    EXPECT_THAT(text, Not(HasSubstr(part)));
  }
}

TEST(TranslationText, SaysSoWhereNothingIsRecommended) {
  TranslationReport report = SampleTranslation(0);
  for (TranslatedResult& result : report.results) result.why_not = "forbidden for a test";
  report.recommended = -1;
  report.reason = "no procedure could be computed";
  EXPECT_THAT(TranslationText(report), HasSubstr("no procedure could be computed"));
  EXPECT_THAT(BriefTranslation(report), HasSubstr("no procedure could be computed"));
}

TEST(TranslationText, HasItsWarnings) {
  TranslationReport report = SampleTranslation(0);
  report.warnings.push_back("a warning of this test");
  EXPECT_THAT(TranslationText(report), HasSubstr("a warning of this test"));
}

TEST(BriefTranslation, IsOneLine) {
  const std::string line = BriefTranslation(SampleTranslation(0));
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1);
  EXPECT_THAT(line, HasSubstr("W at 1000 W/m2, 25 C (k = 2, De Soto)"));
}

TEST(TranslationCsv, HasARowAProcedureAndAsManyFieldsAsItsHeader) {
  const TranslationReport report = SampleTranslation(0);
  const std::string csv = TranslationCsv(report);
  std::istringstream lines(csv);
  std::string line;
  std::vector<std::ptrdiff_t> commas;
  while (std::getline(lines, line)) commas.push_back(std::count(line.begin(), line.end(), ','));
  ASSERT_EQ(commas.size(), 1 + report.results.size());
  EXPECT_EQ(commas[1], commas[0]);
  EXPECT_EQ(commas.back(), commas[0]);
  EXPECT_THAT(csv, HasSubstr("made,1000,25,desoto,yes,"));
  EXPECT_THAT(csv, HasSubstr("made,1000,25,iec3,no,,,,,,,,,,,,,"));
  EXPECT_THAT(csv, Not(HasSubstr("nan")));
}

TEST(TranslationJson, HoldsWhatTheReportHolds) {
  const TranslationReport report = SampleTranslation();
  const std::string json = TranslationJson(report);
  EXPECT_THAT(json, HasSubstr("\"recommended\""));
  EXPECT_THAT(json, Not(HasSubstr("nan")));
  EXPECT_EQ(json, TranslationJson(report));
}

TEST(TranslationFigure, HasTheReadingsAndEveryComputedProcedure) {
  const TranslationReport report = SampleTranslation(0);
  const Figure with = TranslationFigure(report);
  TranslationReport fewer = report;
  fewer.results.front().why_not = "forbidden for a test";
  const auto layers = [](const Figure& figure) {
    std::size_t count = 0;
    for (const auto& panel : figure.panels) count += panel.series.size();
    return count;
  };
  EXPECT_GT(layers(with), report.results.size());
  EXPECT_LT(layers(TranslationFigure(fewer)), layers(with));
}

}  // namespace
}  // namespace lyrefit
