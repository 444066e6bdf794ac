#include "lyrefit/read/table_header.h"

#include <gtest/gtest.h>

namespace lyrefit {
namespace {

TableLine AsHeader(std::string_view line, std::string_view next_line) {
  return lyrefit::AsHeader(line, next_line, {ReadOptions(), false});
}

TableLine HeaderInComment(std::string_view comment, std::string_view row) {
  return lyrefit::HeaderInComment(comment, row, {ReadOptions(), false});
}

TEST(AsHeaderTest, FindsTheDelimiterOfEveryKind) {
  const struct {
    const char* header;
    const char* row;
    char delimiter;
    std::size_t columns;
  } kCases[] = {
      {"V,I", "0,1", ',', 2},
      {"V;I", "0,5;1,5", ';', 2},
      {"V\tI", "0\t1", '\t', 2},
      {"V I", "0   1", ' ', 2},
      {"Voltage (V) Current (A)", "0 1", ' ', 2},
      {"Voltage, V\tCurrent, A", "0\t1", '\t', 2},
      {"Voltage (V),\tCurrent (A)", "0.1,\t3.2", ',', 2},
      {"\"Voltage, V\",\"Current, A\"", "0,1", ',', 2},
      {"V,I,", "0,1,", ',', 2},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.header);
    const TableLine header = AsHeader(c.header, c.row);
    EXPECT_EQ(header.delimiter, c.delimiter);
    EXPECT_EQ(header.columns.size(), c.columns);
    EXPECT_TRUE(header.fits);
  }
}

TEST(AsHeaderTest, NeedsVoltageAndCurrent) {
  for (const char* line : {"a,b", "V,P", "I,P", "0,1", "Device: module 7", ""}) {
    EXPECT_EQ(AsHeader(line, "0,1").delimiter, 0) << line;
  }
}

TEST(AsHeaderTest, SaysWhenTheNextLineHasNoNumbers) {
  const TableLine header = AsHeader("I measured the voltage", "Second line of a remark");
  EXPECT_FALSE(header.fits);
}

TEST(AsHeaderTest, UnitsMayStandInColumnsOfTheirOwn) {
  const TableLine header =
      AsHeader("Index,Reading,Unit,Value,Source Unit", "1,-1.5e-1,Amp DC,-100,mVolt DC");
  EXPECT_FALSE(header.fits);
  const TableLine units =
      AsHeader("Index,Reading,Unit,Value,Source Unit", "1,-1.5,Amp DC,0.1,Volt");
  ASSERT_TRUE(units.fits);
  EXPECT_EQ(units.columns[1].kind, ColumnKind::kCurrent);
  EXPECT_EQ(units.columns[3].kind, ColumnKind::kVoltage);
  EXPECT_EQ(units.columns[3].label, "Value");
}

TEST(WithUnitsTest, PutsEveryUnitBehindItsName) {
  EXPECT_EQ(WithUnits("Voltage;Current", "mV;A"), "\"Voltage [mV]\";\"Current [A]\"");
  EXPECT_EQ(WithUnits("V,T", "(mV),#"), "\"V (mV)\",\"T [#]\"");
  EXPECT_EQ(WithUnits("V,I", "0,1"), "");
  EXPECT_EQ(WithUnits("V,I", "first,second"), "");
  EXPECT_EQ(WithUnits("V,I", "V"), "");
}

TEST(AsRowTest, NeedsTwoNumbersInFront) {
  EXPECT_EQ(AsRow("0.5,1").delimiter, ',');
  EXPECT_EQ(AsRow("0,5;1,5").delimiter, ';');
  EXPECT_EQ(AsRow("0.5 1.5 text").delimiter, ' ');
  EXPECT_EQ(AsRow("0.5").delimiter, 0);
  EXPECT_EQ(AsRow("text,1").delimiter, 0);
}

TEST(HeaderInCommentTest, MustHaveAsManyNamesAsTheRowHasNumbers) {
  EXPECT_EQ(HeaderInComment("# V (mV) I (mA)", "0 1").delimiter, ' ');
  EXPECT_EQ(HeaderInComment("# voltage, current", "0 1").delimiter, ' ');
  EXPECT_EQ(HeaderInComment("# voltage, current", "0 1 2").delimiter, 0);
  EXPECT_EQ(HeaderInComment("# just a remark", "0 1").delimiter, 0);
  EXPECT_EQ(HeaderInComment("#", "0 1").delimiter, 0);
}

}  // namespace
}  // namespace lyrefit
