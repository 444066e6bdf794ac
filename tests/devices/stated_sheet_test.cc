#include "lyrefit/devices/stated_sheet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "error_of.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

const std::string kPanFile = std::string(LYREFIT_DATA_DIR) + "/datasheet/invented.PAN";

StatedSheet PrintedSheet() {
  StatedSheet stated;
  stated.isc = "9.05";
  stated.voc = "37.8";
  stated.imp = "8.58";
  stated.vmp = "30.3";
  stated.alpha = "0.06%";
  stated.beta = "-0.31%";
  stated.cells = 60;
  return stated;
}

TEST(StatedSheet, TakesTextsAsTheyArePrinted) {
  StatedSheet stated = PrintedSheet();
  stated.gamma = "-0.41";
  const auto rounded = FitStatedSheet(stated);
  ASSERT_TRUE(rounded) << rounded.error().ToString();
  const DataSheet& sheet = rounded->module.sheet;
  EXPECT_DOUBLE_EQ(sheet.values.beta_oc_V_K, -0.0031 * 37.8);
  EXPECT_DOUBLE_EQ(sheet.half_unit.open_circuit_voltage_V, 0.05);
  EXPECT_EQ(sheet.gamma_pmp_percent_K, -0.41);
  EXPECT_EQ(rounded->module.name, "module");
  EXPECT_FALSE(rounded->fit.ranges.empty());
  stated.exact = true;
  EXPECT_TRUE(FitStatedSheet(stated)->fit.ranges.empty());
}

TEST(StatedSheet, CountsBeforeTheFile) {
  StatedSheet stated;
  stated.file = kPanFile;
  const double of_file = FitStatedSheet(stated)->module.sheet.values.open_circuit_voltage_V;
  stated.voc = "39.8";
  const auto said = FitStatedSheet(stated);
  ASSERT_TRUE(said);
  EXPECT_NE(of_file, 39.8);
  EXPECT_EQ(said->module.sheet.values.open_circuit_voltage_V, 39.8);
  EXPECT_EQ(said->module.sheet.cells_in_series, 60);
  EXPECT_EQ(said->module.name, "Invented I-304 M60");
}

TEST(StatedSheet, NamesTheOptionThatIsMissingOrNoNumber) {
  EXPECT_EQ(MessageOf(FitStatedSheet({})), "--isc is required: no file states it");
  StatedSheet stated = PrintedSheet();
  stated.cells.reset();
  EXPECT_THAT(MessageOf(FitStatedSheet(stated)), HasSubstr("--cells is required"));
  stated = PrintedSheet();
  stated.alpha = "much";
  EXPECT_THAT(MessageOf(FitStatedSheet(stated)), HasSubstr("--alpha: expected"));
}

TEST(StatedSheet, BecomesParametersForPvlib) {
  const auto sheet = FitStatedSheet(PrintedSheet());
  ASSERT_TRUE(sheet);
  const auto text = PvlibText(*sheet);
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("calcparams_desoto"));
}

}  // namespace
}  // namespace lyrefit
