#include "lyrefit/report/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

#include "lyrefit/devices/device_documents.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/report/text_layout.h"
#include "sample_data_sheet.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(DataSheetText, TellsParametersChecksAndWarnings) {
  const std::string text = DataSheetText(SampleDataSheetFit());
  EXPECT_THAT(text, HasSubstr("single-diode device by the law of De Soto behind a data sheet"));
  EXPECT_THAT(text, HasSubstr("36 cells in series"));
  EXPECT_THAT(text, HasSubstr("infinite"));
  EXPECT_THAT(text, HasSubstr("0.3700 .. 0.4100"));
  EXPECT_THAT(text, HasSubstr("+0.1316 %  V/K"));
  EXPECT_THAT(text, HasSubstr("no shunt is needed"));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), static_cast<std::size_t>(kTextWidth)) << line;
  }
}

TEST(DataSheetText, LeavesOutRangesOfExactValues) {
  DataSheetFit fit = SampleDataSheetFit();
  fit.ranges.clear();
  fit.warnings.clear();
  EXPECT_THAT(DataSheetText(fit), Not(HasSubstr("rounding")));
  EXPECT_THAT(DataSheetText(fit), Not(HasSubstr("Warnings")));
}

TEST(DataSheetText, ShowsTheFamily) {
  const std::string text = DataSheetText(*FitDataSheet(SampleSheet()));
  EXPECT_THAT(text, HasSubstr("All devices through the sheet's three points"));
  EXPECT_THAT(text, HasSubstr("where 1/Rsh = 0. beta_oc, by De Soto's law, picks one"));
  for (const char* row : {"0  picked", "rounding, low", "rounding, high", "  last"}) {
    EXPECT_THAT(text, HasSubstr(row));
  }
  EXPECT_THAT(text, HasSubstr("those whose n the rounding"));
  EXPECT_THAT(text, HasSubstr("200 W/m2   50 C   75 C"));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(Columns(line), static_cast<std::size_t>(kTextWidth)) << line;
  }
}

using ::testing::HasSubstr;

TEST(DataSheetFigure, MarksWhatIsPickedAndTheRounding) {
  const DataSheetFit fit = *FitDataSheet(SampleSheet());
  const Figure figure = DataSheetFigure(fit);
  ASSERT_EQ(figure.panels.size(), 6U);
  for (std::size_t p = 2; p < 6; ++p) {
    const Panel& panel = figure.panels[p];
    ASSERT_EQ(panel.bands.size(), 1U) << panel.title;
    EXPECT_EQ(panel.bands[0].low, fit.family.rounding_low->n);
    EXPECT_EQ(panel.bands[0].high, fit.family.rounding_high->n);
    const bool marked =
        std::any_of(panel.series.begin(), panel.series.end(), [&](const Series& series) {
          return series.rows.size() == 1 && series.rows[0][0] == fit.family.picked->n;
        });
    EXPECT_TRUE(marked) << panel.title;
    EXPECT_GE(panel.x.high, fit.family.members.back().n);
  }
  // The last member of the family has no shunt (conductance 0). The resistances of the sharp knee
  // are drawn at n = 0.
  const Panel& ohms = figure.panels.back();
  const auto shunt = std::find_if(ohms.series.begin(), ohms.series.end(),
                                  [](const Series& series) { return series.right_axis; });
  ASSERT_NE(shunt, ohms.series.end());
  EXPECT_EQ(shunt->rows.back()[1], 0);
  EXPECT_EQ(ohms.series.back().rows[0][0], 0);
  EXPECT_EQ(ohms.series.back().rows[0][1], 1e3 / fit.family.sharp_knee.resistance_shunt_ohm);
}

// The panel shows differences from the picked curve. All curves of the family pass through the
// three points of the data sheet, so that the differences vanish there.
TEST(DataSheetFigure, DrawsCurvesThatMeetAtThreePoints) {
  const DataSheetFit fit = *FitDataSheet(SampleSheet());
  const Figure figure = DataSheetFigure(fit);
  int met = 0;
  double largest = 0;
  for (const Series& series : figure.panels[1].series) {
    if (series.kind != SeriesKind::kLine) continue;
    for (const auto& row : series.rows) {
      for (const double voltage : {0.0, 26.3, 32.9}) {
        if (std::fabs(row[0] - voltage) > 1e-5) continue;
        EXPECT_NEAR(row[1], 0, 1e-3) << voltage;
        ++met;
      }
      largest = std::max(largest, std::fabs(row[1]));
    }
  }
  EXPECT_GE(met, 12);
  EXPECT_GT(largest, 3);
}

TEST(DataSheetFigure, IsEmptyWithoutAFamily) {
  EXPECT_TRUE(DataSheetFigure(SampleDataSheetFit()).panels.empty());
}

TEST(PlotDataSheet, WritesAnSvgWithItsLabels) {
  const TempFolder folder;
  const std::string path = folder.Path("sheet.svg");
  const auto drawn = PlotDataSheet(*FitDataSheet(SampleSheet()), path);
  ASSERT_TRUE(drawn) << drawn.error().ToString();
  std::ifstream file(path, std::ios::binary);
  const std::string svg{std::istreambuf_iterator<char>(file), {}};
  for (const char* label : {"</svg>", "beta_oc picks n = 1.003", "n = 1.41: 1/Rsh = 0",
                            "Pmax at 200 W/m2", "n of the rounding", "Ideality factor n"}) {
    EXPECT_THAT(svg, HasSubstr(label));
  }
  EXPECT_FALSE(PlotDataSheet(*FitDataSheet(SampleSheet()), folder.Path("sheet.gif")).has_value());
}

}  // namespace
}  // namespace lyrefit
