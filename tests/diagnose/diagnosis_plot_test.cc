#include "lyrefit/report/plots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sample_diagnosis.h"
#include "temp_folder.h"

#include "lyrefit/diagnose/diagnosis_documents.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string Svg(const Diagnosis& diagnosis, const std::string& path) {
  const auto drawn = PlotDiagnosis(diagnosis, path);
  EXPECT_TRUE(drawn) << drawn.error().ToString();
  return FileText(path);
}

TEST(PlotDiagnosis, WritesAnSvgWithItsLabels) {
  const TempFolder folder;
  const std::string svg = Svg(SampleDiagnosis(), folder.Path("diagnosis.svg"));
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THAT(svg, HasSubstr("sample_module: misfit 0.46 % of Isc, with the causes 0.04 %"));
  EXPECT_THAT(svg, HasSubstr("Residuals of the sd model"));
  EXPECT_THAT(svg, HasSubstr("Residuals with the causes"));
  EXPECT_THAT(svg, HasSubstr(">step of the irradiance<"));
  EXPECT_THAT(svg, Not(HasSubstr(">down<")));
}

TEST(PlotDiagnosis, TellsUpFromDown) {
  const TempFolder folder;
  const std::string svg = Svg(SampleUpDown(), folder.Path("diagnosis.svg"));
  EXPECT_THAT(svg, HasSubstr(">up<"));
  EXPECT_THAT(svg, HasSubstr(">down<"));
  EXPECT_THAT(svg, HasSubstr(">capacitance of the junction<"));
  EXPECT_THAT(svg, HasSubstr(">non-ohmic shunt<"));
}

TEST(PlotDiagnosis, NamesTheCurvesOfAFamily) {
  const TempFolder folder;
  Diagnosis diagnosis = SampleDiagnosisOfFamily(5);
  EXPECT_THAT(Svg(diagnosis, folder.Path("family.svg")), HasSubstr(">sweep-4<"));
  AddSampleSweep(
      {"both", 500, 25, false, true}, [](int, double, bool) { return 0.0; }, &diagnosis);
  EXPECT_THAT(Svg(diagnosis, folder.Path("both.svg")), HasSubstr("(triangles: down)"));
}

TEST(PlotDiagnosis, DrawsNoModelWithCausesWhereNoneWasFound) {
  const TempFolder folder;
  const std::string svg = Svg(SampleLitAndDark(), folder.Path("diagnosis.svg"));
  EXPECT_THAT(svg, HasSubstr(">dark<"));
  EXPECT_THAT(svg, Not(HasSubstr("with the causes")));
}

// A diagnosis without a model or without points still gives a figure.
TEST(PlotDiagnosis, LeavesOutWhatIsNotKnown) {
  const TempFolder folder;
  Diagnosis diagnosis = SampleDiagnosis();
  EXPECT_THAT(Svg(diagnosis, folder.Path("percent.svg")), HasSubstr("measured (% of Isc)"));
  for (DiagnosedPoint& point : diagnosis.points) point.before_A = point.after_A = kUnknown;
  EXPECT_THAT(Svg(diagnosis, folder.Path("no_model.svg")), HasSubstr("</svg>"));
  diagnosis.points.clear();
  EXPECT_THAT(Svg(diagnosis, folder.Path("empty.svg")), HasSubstr("</svg>"));
}

TEST(PlotDiagnosis, RefusesOtherExtensions) {
  const TempFolder folder;
  const auto drawn = PlotDiagnosis(SampleDiagnosis(), folder.Path("diagnosis.gif"));
  ASSERT_FALSE(drawn);
  EXPECT_THAT(drawn.error().ToString(), HasSubstr(".svg, .png or .pdf"));
}

}  // namespace
}  // namespace lyrefit
