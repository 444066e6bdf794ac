#include "lyrefit/read/table_layout.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "error_of.h"
#include "lyrefit/read/cells.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/read_curve_set.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(FindTableLayoutTest, ColumnsMayStandInAnyOrder) {
  const auto layout = FindTableLayout(
      "time_s,current_A,sigma_A,voltage_V,sweep,G,temperature_C\n0,1,1,0,0,1,1\n", "");
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->time, 0);
  EXPECT_EQ(layout->current, 1);
  EXPECT_EQ(layout->sigma, 2);
  EXPECT_EQ(layout->voltage, 3);
  EXPECT_EQ(layout->sweep, 4);
  EXPECT_EQ(layout->irradiance, 5);
  EXPECT_EQ(layout->temperature, 6);
  EXPECT_EQ(layout->first_row_line, 1);
  EXPECT_THAT(SentencesOf(layout->assumptions), IsEmpty());
}

TEST(FindTableLayoutTest, UsableColumnGoesBeforeRefusedOne) {
  const auto layout = FindTableLayout("V,J (mA/cm2),I (% of Isc),I_A\n0,1,2,3\n", "");
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->current, 3);
  EXPECT_THAT(SentencesOf(layout->assumptions),
              Contains(HasSubstr("columns not used: 'J (mA/cm2)'")));
}

TEST(FindTableLayoutTest, TimeOfDayIsNotUsed) {
  const auto layout = FindTableLayout("Time,voltage_V,current_A\n12:00:01,0,1\n", "");
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->time, kNoColumn);
  EXPECT_THAT(SentencesOf(layout->assumptions), ElementsAre("column not used: 'Time'"));
}

TEST(FindTableLayoutTest, SkipsThePreambleOfATracer) {
  const auto layout = FindTableLayout(
      "Tracer 5\nDate;2024-05-01\nI measured the voltage and the current myself\nTemperature;25\n"
      "\nU [V];I [A]\n0;1\n",
      "");
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->delimiter, ';');
  EXPECT_EQ(layout->first_row_line, 6);
  EXPECT_THAT(SentencesOf(layout->assumptions),
              ElementsAre("4 lines before the header in line 6 skipped",
                          "cell temperature 25 C taken from line 4 'Temperature;25'",
                          "not understood, and not used: line 1 'Tracer 5'"));
  EXPECT_EQ(layout->head.said.temperature_C, 25);
  EXPECT_EQ(layout->head.said.notes.date, "2024-05-01");
}

TEST(FindTableLayoutTest, LineOfUnitsBelowTheNamesCounts) {
  const auto layout = FindTableLayout("Voltage,Current\n(mV),(mA)\n0,1\n", "");
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->columns[layout->voltage].factor, 1e-3);
  EXPECT_EQ(layout->columns[layout->current].factor, 1e-3);
  EXPECT_EQ(layout->first_row_line, 2);
}

TEST(FindTableLayoutTest, WithoutHeaderTheFirstTwoColumnsCount) {
  const auto layout = FindTableLayout("# remark\n0.0 1.0 7\n", "");
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->voltage, 0);
  EXPECT_EQ(layout->current, 1);
  EXPECT_EQ(layout->first_row_line, 1);
  EXPECT_THAT(SentencesOf(layout->assumptions),
              ElementsAre(HasSubstr("no header line"), "column 2 names no unit: taken as A",
                          HasSubstr("1 further columns not used")));
}

TEST(FindTableLayoutTest, TheUnitsInALabViewHeadAreNoHeader) {
  const std::string head =
      "LabVIEW Measurement\t\n***End_of_Header***\t\nChannels\t2\t\nSamples\t2\t2\n"
      "Y_Unit_Label\tVolts\tAmps\nX0\t0.0\t0.0\nDelta_X\t1.0\t1.0\n***End_of_Header***\t\t\n";
  const auto layout =
      FindTableLayout(head + "X_Value\tVoltage\tCurrent\tComment\n0\t0.1\t2\n1\t0.2\t1\n", "");
  ASSERT_TRUE(layout) << layout.error().ToString();
  EXPECT_EQ(layout->first_row_line, 9);
  EXPECT_FALSE(FindTableLayout(head + "X_Value\tCurrent\tComment\n0\t2\n1\t1\n", ""));
}

TEST(FindTableLayoutTest, HeaderMayHideInAComment) {
  const auto layout = FindTableLayout("# I_mA V_mV\n1 0\n", "");
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->current, 0);
  EXPECT_EQ(layout->voltage, 1);
  EXPECT_EQ(layout->columns[1].factor, 1e-3);
  EXPECT_THAT(SentencesOf(layout->assumptions), Contains(HasSubstr("comment above the numbers")));
}

TEST(FindTableLayoutTest, UnknownNamesAreGuessedByLetterOrUnitWhereUnique) {
  const struct {
    const char* text;
    int voltage;
    int current;
    double factor;
  } kCases[] = {
      {"Vq,Iq\n0,1\n", 0, 1, 1},
      {"Umeas[V],Imeas[V],Ucorr[V],Icorr[mA]\n0,1,2,3\n", 2, 3, 1e-3},
      {"No;Napeti [V];Proud [mA];Vykon [W]\n1;0;1;2\n", 1, 2, 1e-3},
      {"Isc [A],Voc [V],Bias [V],Answer [A]\n1,2,3,4\n", 2, 3, 1},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.text);
    const auto layout = FindTableLayout(c.text, "f");
    ASSERT_TRUE(layout) << layout.error().ToString();
    EXPECT_EQ(layout->voltage, c.voltage);
    EXPECT_EQ(layout->current, c.current);
    EXPECT_EQ(layout->columns[layout->current].factor, c.factor);
  }
  for (const char* text : {"Isc [A];Voc [V]\n8;36\n", "Bias [V],a [A],b [A]\n0,1,2\n",
                           "Index,Intensity,Value\n0,1,2\n", "Vmodel,Imodel\n0,1\n"}) {
    EXPECT_FALSE(FindTableLayout(text, "f")) << text;
  }
}

TEST(FindTableLayoutTest, ColumnsMayBeNamed) {
  const struct {
    const char* text;
    const char* voltage_column;
    const char* current_column;
    int voltage;
    int current;
    double factor;
  } kCases[] = {
      {"Bias;Answer (mA)\n0;1\n", "bias", "answer (ma)", 0, 1, 1e-3},
      {"title\nBias;Answer (mA)\n0;1\n", "2", "1", 1, 0, 1},
      {"V,I,Amps\n0,1,2\n", "", "Amps", 0, 2, 1},
      {"V,voltage,I\n0,1,2\n", "voltage", "", 1, 2, 1},
      {"0,1,2\n", "3", "1", 2, 0, 1},
      {"a title\n0 1\n", "2", "1", 1, 0, 1},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.text);
    ReadOptions options;
    options.voltage_column = c.voltage_column;
    options.current_column = c.current_column;
    const auto layout = FindTableLayout(c.text, "f", options);
    ASSERT_TRUE(layout) << layout.error().ToString();
    EXPECT_EQ(layout->voltage, c.voltage);
    EXPECT_EQ(layout->current, c.current);
    EXPECT_EQ(layout->columns[layout->current].factor, c.factor);
  }
  ReadOptions missing;
  missing.current_column = "Ix";
  EXPECT_THAT(MessageOf(FindTableLayout("V,I\n0,1\n", "f", missing)),
              HasSubstr("expected a column 'Ix' in the header, found 'V'"));
}

TEST(FindTableLayoutTest, PairsSideBySideAreChosenByColumn) {
  const struct {
    const char* header;
    const char* column;
    int voltage;
    int current;
  } kCases[] = {
      {"Voltage (V),Current 1 (A),Current 2 (A)", "2", 0, 2},
      {"Voltage (V),Current 1 (A),Current 2 (A)", "current 1 (a)", 0, 1},
      {"V1,V2,I1,I2", "2", 1, 3},
      {"V7,I7,V3,I3", "3", 2, 3},
      {"V,J,V,J", "2", 2, 3},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.header);
    ReadOptions options;
    options.column = c.column;
    const auto layout = FindTableLayout(c.header + std::string("\n0,1,2,3\n"), "f", options);
    ASSERT_TRUE(layout) << layout.error().ToString();
    EXPECT_EQ(layout->voltage, c.voltage);
    EXPECT_EQ(layout->current, c.current);
  }
}

TEST(FindTableLayoutTest, PercentBeginsACommentToo) {
  const auto layout = FindTableLayout("% I_mA V_mV\n1 0\n", "");
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->current, 0);
  EXPECT_EQ(layout->voltage, 1);
}

TEST(FindTableLayoutTest, RefusalsNameTheColumn) {
  const struct {
    const char* text;
    int line;
    int column;
    const char* phrase;
  } kCases[] = {
      {"V,voltage,I\n0,0,1\n", 1, 3, "found two: 'V' and 'voltage'"},
      {"V,I,Amps\n0,0,1\n", 1, 5, "expected one current column"},
      {",i_sc,v_oc,i_mp,v_mp\n0,8,36,7,29\n", 1, 1, "`lyrefit datasheet` makes parameters of them"},
      {"V,J (%)\n0,1\n", 1, 3, "expected mA/cm2"},
      {"V1,I1,V2,I2\n0,1,0,1\n", 1, 10, "found 2: 1 'I1', 2 'I2'; choose one with --column"},
      {"Bias;Reading one\n0;1\n", 1, 1, "among 'Bias', 'Reading one'; name the columns with"},
      {"U (%),I\n0,1\n", 1, 1, "expected V, mV, uV or kV"},
      {"V,P\n0,1\n", 1, 1, "found no current among 'V', 'P'"},
      {"I,P\n0,1\n", 1, 1, "found no voltage among"},
      {"title\nx,y\n0,1\n", 2, 1, "found neither among 'x', 'y'"},
      {"only words\nand more\n", 1, 1, "found neither among 'only', 'words'"},
      {"voltage\n0\n", 1, 1, "found one field: 'voltage'"},
      {"0.5\n0.6\n", 1, 1, "a table of one column"},
      {"0,5,7,48\n", 1, 1, "decimal comma"},
      {"# only\n\n# comments\n", 0, 0, "no data"},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.text);
    ExpectErrorAt(FindTableLayout(c.text, "f.csv"), "f.csv", c.line, c.column, c.phrase);
  }
}

using ::testing::HasSubstr;

// Rows of devices a and b, one after the other; that of b ends at `part` of the voltages of a.
std::string RowsOfTwo(const std::string& name, double part = 1) {
  std::string rows = name + ",Voltage (V),Current (A)\n";
  for (const auto& [device, most] : {std::pair("a", 1.0), {"b", part}}) {
    for (int k = 0; k <= 20; ++k) {
      const double voltage = 0.03 * k * most;
      rows += fmt::format("{},{},{}\n", device, voltage,
                          0.04 - (device[0] - 'a') * 0.01 - 0.08 * voltage * voltage);
    }
  }
  return rows;
}

TEST(DeviceColumnTest, AValueOfAColumnOfDevicesIsADevice) {
  const TempFolder folder;
  for (const char* const name : {"Channel", "Pixel No.", "DUT ID", "sample", "Cell", "string"}) {
    const auto set = ReadMeasurement(folder.Write("rows.csv", RowsOfTwo(name)));
    ASSERT_TRUE(set) << name;
    ASSERT_EQ(set->curves.size(), 2U) << name;
    EXPECT_TRUE(set->several_devices);
    EXPECT_NEAR(set->curves[0].current_A[0], 0.04, 1e-12);
    EXPECT_NEAR(set->curves[1].current_A[0], 0.03, 1e-12);
    EXPECT_THAT(MessageOf(CheckIsOneCell(*set, "batch")),
                HasSubstr("a, " + set->curves[1].name + "): choose one with --column NAME"));
  }
}

TEST(DeviceColumnTest, OneIsChosenByNameOrPlace) {
  const std::string text = RowsOfTwo("Channel");
  for (const char* const wish : {"b", "2"}) {
    ReadOptions options;
    options.column = wish;
    const auto curve = ReadCurveText(text, "rows", options);
    ASSERT_TRUE(curve) << wish;
    EXPECT_NEAR(curve->current_A[0], 0.03, 1e-12) << wish;
  }
  ReadOptions none;
  none.column = "c";
  EXPECT_THAT(MessageOf(ReadCurveText(text, "rows", none)), HasSubstr("'a', 'b'"));
  EXPECT_THAT(MessageOf(ReadCurveText(text, "rows")), HasSubstr("expected one device, found 2"));
}

TEST(DeviceColumnTest, OtherColumnsAndPartsOfASweepAreNone) {
  const TempFolder folder;
  for (const std::string& rows : {RowsOfTwo("Range"), RowsOfTwo("Channel", 0.2)}) {
    const auto set = ReadMeasurement(folder.Write("rows.csv", rows));
    EXPECT_FALSE(set && set->several_devices);
  }
}

}  // namespace
}  // namespace lyrefit
