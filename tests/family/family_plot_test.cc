#include "lyrefit/report/plots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sample_family.h"
#include "temp_folder.h"

#include "lyrefit/family/family_documents.h"

namespace lyrefit {
namespace {

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
