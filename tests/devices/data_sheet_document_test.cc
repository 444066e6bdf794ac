#include "lyrefit/report/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "lyrefit/devices/device_documents.h"
#include "lyrefit/report/text_layout.h"
#include "sample_data_sheet.h"

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

}  // namespace
}  // namespace lyrefit
