#include "lyrefit/report/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "golden.h"
#include "lyrefit/family/family_documents.h"
#include "lyrefit/report/plots.h"
#include "sample_family.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

TEST(FamilyText, SaysWhatTheGoldenFileHas) {
  Golden golden("family");
  const FamilyReport sample = MakeSampleFamily(8).report;
  golden.Add("eight curves", FamilyText(sample));
  FamilyReport report = sample;
  report.interrupted = true;
  report.usable = false;
  golden.AddChanges("interrupted, not usable", FamilyText(report));
  report = sample;
  report.in_sample = report.held_out;
  report.held_out.reset();
  report.against[0].name = "a very long name of a file that nobody would type.json";
  report.in_sample->largest_id = "a very long name of a curve";
  golden.AddChanges("other parameters on the curves fitted", FamilyText(report));
  golden.AddChanges("two hundred curves: the worst ten", FamilyText(MakeSampleFamily(200).report));
  golden.Check();
}

TEST(FamilyText, OfCurvesFittedOneByOneSaysWhatTheGoldenFileHas) {
  Golden golden("individual_fits");
  SampleFamily sample = MakeFreeSample(8);
  golden.Add("eight curves", FamilyText(sample.report));
  sample.report.curves[3].id = "a very long name of a curve that nobody would type";
  golden.AddChanges("a long name", FamilyText(sample.report));
  sample.report.translation.spec.model = Model::kDoubleDiode;
  for (FamilyCurve& curve : sample.report.curves) {
    curve.individual_parameters.insert(curve.individual_parameters.end(), {1.2e-7, 2});
  }
  golden.AddChanges("two diodes", FamilyText(sample.report));
  golden.Check();
}

TEST(BriefFamily, IsOneLine) {
  Golden golden("family_brief");
  golden.AddLong("eight curves", BriefFamily(MakeSampleFamily(8).report));
  golden.Check();
}

using ::testing::HasSubstr;

std::string Svg(const SampleFamily& sample, const std::string& path) {
  const auto drawn = PlotFamily(sample.report, sample.set, path);
  EXPECT_TRUE(drawn) << drawn.error().ToString();
  return FileText(path);
}

TEST(PlotFamily, WritesAnSvgWithItsLabels) {
  const TempFolder folder;
  const std::string svg = Svg(MakeSampleFamily(30), folder.Path("family.svg"));
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THAT(svg, HasSubstr("sample_module: desoto sd, solved-current RMSE 1.432e-03 A over 28 "));
  EXPECT_THAT(svg, HasSubstr("Measured points and model"));
  EXPECT_THAT(svg, HasSubstr("Cell temperature (C)"));
  EXPECT_THAT(svg, HasSubstr("Mean of model - measured (mA; open: held out)"));
}

TEST(PlotFamily, DrawsCurvesFittedOneByOne) {
  const TempFolder folder;
  EXPECT_THAT(Svg(MakeFreeSample(5), folder.Path("free.svg")), HasSubstr("sample_module: free sd"));
}

// Missing curves and unknown values still give a figure.
TEST(PlotFamily, LeavesOutWhatIsNotKnown) {
  const TempFolder folder;
  SampleFamily sample = MakeSampleFamily(5);
  sample.set.curves.clear();
  for (FamilyCurve& curve : sample.report.curves) {
    curve.rmse = {};
    curve.mean_residual_A = kUnknown;
  }
  EXPECT_THAT(Svg(sample, folder.Path("empty.svg")), HasSubstr("</svg>"));
}

TEST(PlotFamily, RefusesOtherExtensions) {
  const TempFolder folder;
  const SampleFamily sample = MakeSampleFamily(5);
  const auto drawn = PlotFamily(sample.report, sample.set, folder.Path("family.gif"));
  ASSERT_FALSE(drawn);
  EXPECT_THAT(drawn.error().ToString(), HasSubstr(".svg, .png or .pdf"));
}

}  // namespace
}  // namespace lyrefit
