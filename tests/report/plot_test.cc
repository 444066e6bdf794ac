#include "lyrefit/report/plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "../temp_folder.h"
#include "sample_report.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string Content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

int FilesIn(const fs::path& folder) {
  return static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(PlotFit, WritesAnSvgWithItsLabels) {
  const TempFolder folder;
  const std::string path = folder.Path("fit.svg");
  const auto drawn = PlotFit(SampleReport(), path);
  ASSERT_TRUE(drawn) << drawn.error().ToString();
  const std::string svg = Content(path);
  EXPECT_THAT(svg, HasSubstr("<svg"));
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THAT(svg, HasSubstr("sample_cell, single-diode model: RMSE 0.000773 A solved-current"));
  EXPECT_THAT(svg, HasSubstr("Voltage (V)"));
  EXPECT_THAT(svg, HasSubstr("Model - measured (mA)"));
  EXPECT_EQ(FilesIn(folder.Path("")), 1);
}

TEST(PlotFit, WritesAPng) {
  const TempFolder folder;
  const std::string path = folder.Path("fit.PNG");
  const auto drawn = PlotFit(SampleReport(), path);
  ASSERT_TRUE(drawn) << drawn.error().ToString();
  EXPECT_EQ(Content(path).substr(0, 8), "\x89PNG\r\n\x1a\n");
}

TEST(PlotFit, TakesAnyNameAndPath) {
  const TempFolder folder;
  FitReport report = SampleReport();
  report.curve.name = "it's \"50 %\" <cell> & $x `rm` \\n\nset output";
  const std::string path = folder.Path("a 'b' $c.svg");
  const auto drawn = PlotFit(report, path);
  ASSERT_TRUE(drawn) << drawn.error().ToString();
  EXPECT_THAT(Content(path), HasSubstr("&lt;cell> &amp; $x `rm` \\n set output"));
}

TEST(PlotFit, DrawsDarkAndTinyCurves) {
  const TempFolder folder;
  FitReport report = SampleReport();
  report.refined[kIph] = 0;
  report.model_current_A =
      SolveCurrents(report.device, report.refined.data(), report.curve.voltage_V);
  report.curve.current_A = report.model_current_A;
  report.residual_A.assign(report.curve.size(), 0);
  report.rmse.refined = {0, 0};
  const auto drawn = PlotFit(report, folder.Path("dark.svg"));
  EXPECT_TRUE(drawn) << drawn.error().ToString();
}

TEST(PlotFit, RefusesOtherExtensions) {
  const TempFolder folder;
  for (const char* name : {"fit.gif", "fit"}) {
    const auto drawn = PlotFit(SampleReport(), folder.Path(name));
    ASSERT_FALSE(drawn);
    EXPECT_THAT(drawn.error().message, HasSubstr(".svg or .png"));
  }
  EXPECT_EQ(FilesIn(folder.Path("")), 0);
}

TEST(PlotFit, RefusesAFolderThatIsNotThere) {
  const TempFolder folder;
  EXPECT_FALSE(PlotFit(SampleReport(), folder.Path("no/fit.svg")));
  EXPECT_EQ(FilesIn(folder.Path("")), 0);
}

TEST(CheckPlot, SaysWhatToInstallWithoutGnuplot) {
  const TempFolder folder;
  EXPECT_TRUE(CheckPlot("fit.svg"));
  const std::string path = std::getenv("PATH");
  ASSERT_EQ(setenv("PATH", folder.Path("").c_str(), 1), 0);
  const auto checked = CheckPlot("fit.svg");
  const auto drawn = PlotFit(SampleReport(), folder.Path("fit.svg"));
  ASSERT_EQ(setenv("PATH", path.c_str(), 1), 0);
  ASSERT_FALSE(checked);
  EXPECT_THAT(checked.error().message, HasSubstr("gnuplot-nox"));
  EXPECT_FALSE(drawn);
  EXPECT_EQ(FilesIn(folder.Path("")), 0);
}

}  // namespace
}  // namespace lyrefit
