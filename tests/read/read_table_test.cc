#include "lyrefit/read/read_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "error_of.h"

namespace lyrefit {
namespace {

using ::testing::AllOf;

using ::testing::Contains;

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(ReadTableTest, ResultsBelowNumbersWithoutAHeadAreLeftAside) {
  const auto table = ReadTable("0\t3.0\n0.2\t2.9\n0.4\t2.1\nJsc:\t3.0\n\t0.5\nFF:\t0.6\n", "f", {});
  ASSERT_TRUE(table) << table.error().ToString();
  EXPECT_EQ(table->curve.size(), 3U);
}

TEST(ReadTableTest, ReadsEveryWayToWriteTheSameTable) {
  for (const char* text : {
           "voltage_V,current_A\n-0.5,2\n0,1.5\n",
           "voltage_V,current_A\r\n-0.5,2\r\n0,1.5\r\n",
           "voltage_V,current_A\r-0.5,2\r0,1.5",
           "# remark\n\nvoltage_V,current_A\n# remark\n-0.5,2\n\n0,1.5\n# end",
           "voltage_V,current_A,\n-0.5,2,\n0,1.5,\n",
           "voltage_V,current_A\n-0.5,2,,\n0,1.5\n",
           "\"voltage_V\",\"current_A\"\n\"-0.5\",\"2\"\n\"0\",\"1.5\"\n",
           "V I\n-0.5 2\n 0   1.5 \n",
           "V\tI\n-0.5\t2\n0\t1.5\n",
           "V;I\n-0,5;2\n0;1,5\n",
           "V\tI\n-0,5\t2\n0\t1,5\n",
           "V,I\n-5e-1,+2.0E0\n0,1.5\n",
           "V,I\n\u22120.5,2\n0,1.5\n",
           "Voltage (mV),Current (mA)\n-500,2000\n0,1500\n",
           "Volts, Amps, Watts, Ohms\n-0.5, 2, -1, -0.25\n0, 1.5, 0, 0\n",
           "I,V\n2,-0.5\n1.5,0\n",
           "-0.5,2.0\n0,1.5\n",
           "-0.5 2\n0 1.5\n",
           "-0,5;2\n0;1,5\n",
           "Tracer X\nModule: 7\n\nVoltage [V];Current [A]\n-0.5;2\n0;1.5\n",
       }) {
    SCOPED_TRACE(text);
    const auto table = ReadTable(text, "f.csv");
    ASSERT_TRUE(table) << table.error().ToString();
    EXPECT_THAT(table->curve.voltage_V, ElementsAre(-0.5, 0));
    EXPECT_THAT(table->curve.current_A, ElementsAre(2, 1.5));
  }
}

TEST(ReadTableTest, ReadsTheOptionalColumns) {
  const auto table = ReadTable(
      "V,I,sigma_mA,time_ms,sweep,irradiance_kW/m2,temperature_K\n0,1,2,500,3,0.8,298.15\n", "");
  ASSERT_TRUE(table);
  EXPECT_THAT(table->curve.sigma_A, ElementsAre(2e-3));
  EXPECT_THAT(table->curve.time_s, ElementsAre(0.5));
  EXPECT_THAT(table->curve.sweep, ElementsAre(3));
  EXPECT_THAT(table->curve.irradiance_W_m2, ElementsAre(800));
  EXPECT_THAT(table->curve.temperature_C, ElementsAre(25));
  EXPECT_FALSE(table->holds_curves);
  EXPECT_THAT(SentencesOf(table->curve.assumptions),
              ::testing::Contains(HasSubstr("converted from kelvin")));
}

TEST(ReadTableTest, ColumnNamedCurveTellsCurvesApart) {
  const auto table = ReadTable("curve,V,I\n4,0,1\n", "");
  ASSERT_TRUE(table);
  EXPECT_TRUE(table->holds_curves);
  EXPECT_THAT(table->curve.sweep, ElementsAre(4));
}

TEST(ReadTableTest, KeepsOrderAndDuplicates) {
  const auto table = ReadTable("V,I\n0.5,1\n0,2\n0.5,1\n0.3,1.5\n", "");
  ASSERT_TRUE(table);
  EXPECT_THAT(table->curve.voltage_V, ElementsAre(0.5, 0, 0.5, 0.3));
}

struct BadTable {
  const char* text;
  int line;
  int column;
  const char* phrase;
};

TEST(ReadTableTest, ErrorsNameLineColumnAndWhatWasExpected) {
  const BadTable kCases[] = {
      {"voltage_V,current_A\n0,1\n0.1,abc\n", 3, 5,
       "expected a number in column current_A, found 'abc'"},
      {"V,I\nabc,1\n0.1,2\n", 2, 1, "expected a number in column V, found 'abc'"},
      {"id,V,I\nA,0;1;2,2;1;0\n", 2, 3, "found a list of 3: write one reading a line"},
      {"V,I\n0,1\n0.1,\n", 3, 5, "expected a number in column I, found an empty field"},
      {"V,I\n0,1\n,1\n", 3, 1, "found an empty field"},
      {"V,I\n0,1\n0.1\n", 3, 1, "expected 2 fields as in the first line of the table, found 1"},
      {"V,I\n0,1\n0.1,2,3\n", 3, 7, "expected 2 fields as in the first line of the table, found 3"},
      {"V,I\n0,5,3,2\n", 2, 5, "with a decimal comma"},
      {"V,I\n0,nan\n", 2, 3, "expected a finite number in column I, found 'nan'"},
      {"V,I\n0,1\ninf,1\n", 3, 1, "expected a finite number in column V"},
      {"V,I\n0,1e999\n", 2, 3, "expected a number"},
      {"V,I (kA)\n0,1e308\n", 2, 3, "expected a finite number"},
      {"V,I\n0,\"1\n", 2, 1, "expected closed quotes"},
      {"V,I\n", 1, 0, "expected rows of numbers below the header"},
      {"V,I,sigma\n0,1,0\n", 2, 5, "expected a positive number in column sigma, found '0'"},
      {"V,I,sigma\n0,1,-0.1\n", 2, 5, "expected a positive number"},
      {"V,I,sweep\n0,1,left\n", 2, 5, "expected a number in column sweep, found 'left'"},
      {"V,I,sweep\n0,1,1.5\n", 2, 5, "expected a whole number in column sweep"},
      {"V,I,temperature_C\n0,1,298.15\n", 2, 5, "looks like kelvin"},
      {"V,I,temperature_C\n0,1,-101\n", 2, 5, "too cold for a cell"},
      {"V,I,temperature_K\n0,1,25\n", 2, 5, "too cold for a cell"},
      {"0.0,1\n0.1,x\n", 2, 5, "expected a number in column 2, found 'x'"},
      {"V;I\n0.5;1\n0,6;1\n", 3, 1, "a number with decimal '.' as above"},
      {"V;I\n0,5;1\n0.6;1\n", 3, 1, "a number with decimal ',' as above"},
      {"V,I\n0,1\n0.1,\xb5\n", 3, 5, "UTF-8"},
      {"# r\r\nV,I\r\n0,1\r\n0.1,x\r\n", 4, 5, "found 'x'"},
  };
  for (const auto& c : kCases) {
    SCOPED_TRACE(c.text);
    ExpectErrorAt(ReadTable(c.text, "f.csv"), "f.csv", c.line, c.column, c.phrase);
  }
}

TEST(ReadTableTest, ASecondTableBelowIsASecondSweep) {
  const auto table = ReadTable(
      "Irradiance (W/m2),1000\nV,I\n0,2\n0.5,1\n\nIrradiance (W/m2),500\nsecond\nV,I\n0,1\n0.4,0\n",
      "f");
  ASSERT_TRUE(table) << table.error().ToString();
  EXPECT_THAT(table->curve.sweep, ElementsAre(1, 1, 2, 2));
  EXPECT_THAT(table->curve.current_A, ElementsAre(2, 1, 1, 0));
  EXPECT_THAT(table->curve.irradiance_W_m2, ElementsAre(1000, 1000, 500, 500));
  EXPECT_THAT(SentencesOf(table->curve.assumptions), Contains(HasSubstr("read as sweeps 1 to 2")));
  EXPECT_FALSE(ReadTable("V,I\n0,2\n0.5,1\nV,I,t\n0,1,0\n", "f"));
}

TEST(ReadTableTest, TextBelowTheTableIsLeftAndSaid) {
  for (const char* text :
       {"V,I\n0,2\n0.5,1\n,,\nIsc,8.9\nVoc,36\n", "V,I\n0,2\n0.5,1\nIsc,8.9\nend\n"}) {
    const auto table = ReadTable(text, "f");
    ASSERT_TRUE(table) << table.error().ToString();
    EXPECT_EQ(table->curve.size(), 2U);
    EXPECT_THAT(
        SentencesOf(table->curve.assumptions),
        Contains(AllOf(HasSubstr("2 lines of text below the table"), HasSubstr("'Isc,8.9'"))));
  }
}

TEST(ReadTableTest, NoPointIsTakenForText) {
  for (const char* text :
       {"V,I\n0,2\n0.5,1\n0.6\n", "V,I\n0,2\n0.5,1\nNA,0.5\n", "V,I\n0,2\nend\n0.5,1\n",
        "V,I\n0,2\n0.5,1\n1.2.3,0.5\n", "V,I\n0,2\n0.5,1\nnan,0.5\n",
        "V,I\n0,2\n0.5,1\n0.6,x\nV,I\n0,1\n", "V,I\n0,2\n0.5,1\n,0.5\n"}) {
    EXPECT_FALSE(ReadTable(text, "f")) << text;
  }
}

TEST(ReadTableTest, PairsSideBySideMayEndEarly) {
  ReadOptions options;
  options.column = "2";
  const auto table = ReadTable("V1,I1,V2,I2\n0,2,0,1\n0.5,1,0.4,0.5\n0.6,0,,\n", "f", options);
  ASSERT_TRUE(table) << table.error().ToString();
  EXPECT_THAT(table->curve.voltage_V, ElementsAre(0, 0.4));
  EXPECT_EQ(table->name, "I2");
  EXPECT_FALSE(ReadTable("V1,I1,V2,I2\n0,2,0,1\n0.5,1,0.4,\n", "f", options));
}

constexpr char kFlashTester[] =
    "Vload_(V),ILoad_(A),SunsVoc_Voltage_(V),SunsVoc_Suns_(suns),Intensity_(suns),"
    "Dark_IV_Voltage_(V),Dark_IV_Current_(A)\n"
    "0,5,40,1,1.1,0,0\n20,4.9,39,0.5,1.0,20,0.1\n30,4,38,0.2,0.9,30,1\n"
    "0,0,37,0.1,0.8,0,0\n0,0,36,0.05,0.7,0,0\n";

TEST(ReadTableTest, TheCurveUnderLoadCountsBesideASunsVocTrace) {
  const auto load = ReadTable(kFlashTester, "f");
  ASSERT_TRUE(load) << load.error().ToString();
  EXPECT_THAT(load->curve.voltage_V, ElementsAre(0, 20, 30));
  EXPECT_THAT(load->curve.current_A, ElementsAre(5, 4.9, 4));
  EXPECT_THAT(load->curve.irradiance_W_m2, IsEmpty());  // the light is that of the trace
  EXPECT_FALSE(load->curve.suns_voc_A);
  const auto says = [&](const char* text) {
    return std::any_of(
        load->curve.assumptions.begin(), load->curve.assumptions.end(),
        [&](const Assumption& one) { return one.sentence.find(text) != std::string::npos; });
  };
  EXPECT_TRUE(says("2 of 5 rows left out: they hold 0 V and 0 A"));
  EXPECT_TRUE(says("'Intensity_(suns)' is the light of the Suns-Voc trace"));
}

TEST(ReadTableTest, ASunsVocTraceHasTheShortCircuitCurrentOfTheCurveBesideIt) {
  ReadOptions options;
  options.column = "2";
  const auto trace = ReadTable(kFlashTester, "f", options);
  ASSERT_TRUE(trace) << trace.error().ToString();
  EXPECT_THAT(trace->curve.voltage_V, ElementsAre(40, 39, 38, 37, 36));
  ASSERT_TRUE(trace->curve.suns_voc_A);
  EXPECT_NEAR(*trace->curve.suns_voc_A, 5, 1e-12);
  EXPECT_NEAR(trace->curve.current_A[1], 2.5, 1e-12);
}

TEST(ReadTableTest, APseudoCurrentIsThatOfASunsVocTrace) {
  const auto trace = ReadTable("Voltage (V),Pseudo current (A)\n0.1,5.2\n30,5\n40,0\n", "f");
  ASSERT_TRUE(trace) << trace.error().ToString();
  ASSERT_TRUE(trace->curve.suns_voc_A);
  EXPECT_EQ(*trace->curve.suns_voc_A, 5.2);
  EXPECT_THAT(trace->curve.current_A, ElementsAre(5.2, 5, 0));
}

TEST(ReadTables, AMeasurementOfZerosOnlyIsNoCurve) {
  const char* text =
      "Vload_(V),ILoad_(A),SunsVoc_Voltage_(V),SunsVoc_Current_(A),Dark_IV_Voltage_(V),"
      "Dark_IV_Current_(A)\n0,5,40,0,0,0\n20,4.9,39,2,0,0\n30,4,38,4,0,0\n";
  const auto tables = ReadTables(text, "f", {}, BrokenRows::kRefuse);
  ASSERT_TRUE(tables) << tables.error().ToString();
  ASSERT_EQ(tables->size(), 2U);
  EXPECT_FALSE((*tables)[0].error);
  ASSERT_TRUE((*tables)[1].curve.suns_voc_A);
  EXPECT_EQ(*(*tables)[1].curve.suns_voc_A, 4);
  EXPECT_THAT((*tables)[0].curve.assumptions.back().sentence,
              HasSubstr("'Dark_IV_Current_(A)' left aside: every row holds 0 V and 0 A"));
}

TEST(ReadTableTest, DensitiesAreInAmperePerSquareCentimetre) {
  const auto table = ReadTable("V,J (mA/cm2)\n0,40\n0.5,20\n", "f");
  ASSERT_TRUE(table);
  EXPECT_TRUE(table->per_area);
  EXPECT_THAT(table->curve.current_A, ElementsAre(0.04, 0.02));
}

TEST(ReadTableTest, TheHeadTellsTheUnitOfAColumnThatNamesNone) {
  const auto table = ReadTable("Jsc (mA/cm2),38\nVoltage,Current1\n0,-38.1\n0.5,-20\n", "f");
  ASSERT_TRUE(table);
  EXPECT_TRUE(table->per_area);
  EXPECT_NEAR(table->curve.current_A[0], -0.0381, 1e-12);
  const auto other = ReadTable("Jsc (mA/cm2),20\nVoltage,Current1\n0,-38.1\n0.5,-20\n", "f");
  ASSERT_TRUE(other);
  EXPECT_EQ(other->curve.current_A[0], -38.1);
}

TEST(ReadTableTest, DirectionsOfOneDeviceAreSweepsInTheirOrder) {
  const auto table = ReadTable("V (V),a_for [A],a_rev [A]\n0,3,4\n1,2,3\n2,0,1\n", "f");
  ASSERT_TRUE(table) << table.error().ToString();
  EXPECT_THAT(table->curve.voltage_V, ElementsAre(0, 1, 2, 2, 1, 0));
  EXPECT_THAT(table->curve.current_A, ElementsAre(3, 2, 0, 1, 3, 4));
  EXPECT_THAT(table->curve.sweep, ElementsAre(1, 1, 1, 2, 2, 2));
  EXPECT_THAT(table->lines, ElementsAre(2, 3, 4, 4, 3, 2));
}

TEST(ReadTableTest, ASweepStoredInTheOrderOfItsScanIsTurned) {
  // The reverse currents begin at the highest voltage, although the voltages rise.
  const auto table = ReadTable("V (V),a_for [A],a_rev [A]\n0,3,1\n1,2,3\n2,0,4\n", "f");
  ASSERT_TRUE(table) << table.error().ToString();
  EXPECT_THAT(table->curve.voltage_V, ElementsAre(0, 1, 2, 2, 1, 0));
  EXPECT_THAT(table->curve.current_A, ElementsAre(3, 2, 0, 1, 3, 4));
}

TEST(ReadTableTest, AnAverageIsNotUsedAndItsPartsAreSweeps) {
  const auto table =
      ReadTable("V (V),I [1] (A),I [2] (A),Average I (A)\n2,0,1,0.5\n1,2,3,2.5\n0,3,4,3.5\n", "f");
  ASSERT_TRUE(table) << table.error().ToString();
  EXPECT_THAT(table->curve.voltage_V, ElementsAre(2, 1, 0, 0, 1, 2));
  EXPECT_THAT(table->curve.current_A, ElementsAre(0, 2, 3, 4, 3, 1));
}

TEST(ReadTableTest, ADarkMeasurementHasNoLight) {
  ReadOptions options;
  options.column = "1";
  const auto table = ReadTable(
      "Irradiance (W/m2): 1000\nVdark,Jdark,Vlight,Jlight\n0,0,0,9\n1,1,1,3\n", "f", options);
  ASSERT_TRUE(table) << table.error().ToString();
  EXPECT_EQ(table->head.irradiance_W_m2, 0);
  options.column = "2";
  EXPECT_EQ(ReadTable("Vdark,Jdark,Vlight,Jlight\n0,0,0,9\n1,1,1,3\n", "f", options)
                ->head.irradiance_W_m2,
            std::nullopt);
}

TEST(ReadTableTest, TheLightOfARoomInTheHeadOfAPairHasNoIrradiance) {
  const char* const text =
      "Run\tA\tRun\tB\nLight\t1 sun\tLight\tRoom light\nIrradiance [W/m2]\t1000\tIrradiance "
      "[W/m2]\t1000\nV [V]\tI [A]\tV [V]\tI [A]\n0\t2\t0\t1\n1\t0\t1\t0\n";
  ReadOptions options;
  options.column = "1";
  const auto sun = ReadTable(text, "f", options);
  ASSERT_TRUE(sun) << sun.error().ToString();
  EXPECT_EQ(sun->head.irradiance_W_m2, 1000);
  options.column = "2";
  const auto room = ReadTable(text, "f", options);
  ASSERT_TRUE(room) << room.error().ToString();
  EXPECT_EQ(room->head.irradiance_W_m2, std::nullopt);
  EXPECT_EQ(room->head.light, "line 2 'Room light'");
}

TEST(ReadTableTest, AStatedJscBelowGivesTheUnitOfACurrentWithoutHeader) {
  const auto table = ReadTable("0 21.3\n0.5 20\n0.8 0.1\n\nJsc: 21.3\nFF: 0.6\n", "f", {});
  ASSERT_TRUE(table) << table.error().ToString();
  EXPECT_TRUE(table->per_area);
  EXPECT_THAT(table->curve.current_A, ElementsAre(21.3e-3, 20e-3, 0.1e-3));
  EXPECT_THAT(SentencesOf(table->curve.assumptions),
              Contains(HasSubstr("in the unit of line 5 'Jsc: 21.3', with which it agrees")));
  const auto amperes = ReadTable("V,J\n0,0.0213\n0.8,0\n\nJsc: 21.3 mA/cm2\n", "f", {});
  ASSERT_TRUE(amperes) << amperes.error().ToString();
  EXPECT_NEAR(amperes->curve.current_A[0], 21.3e-3, 1e-12);
  EXPECT_TRUE(amperes->curve.current_unit_known);
  EXPECT_THAT(SentencesOf(amperes->curve.assumptions),
              Contains(HasSubstr("taken in A/cm2 by line 5 'Jsc: 21.3 mA/cm2'")));
  const auto current = ReadTable("V,I\n0,0.0213\n0.8,0\n\nJsc: 21.3 mA/cm2\n", "f", {});
  ASSERT_TRUE(current);
  EXPECT_FALSE(current->per_area) << "a current, of 1 cm2";
  const auto other = ReadTable("0 21.3\n0.5 20\n0.8 0.1\n\nJsc: 35\n", "f", {});
  ASSERT_TRUE(other);
  EXPECT_FALSE(other->per_area);
}

TEST(ReadTables, ReadsMeasurementsSideBySideInOnePass) {
  const char* const text =
      "V1,I1,V2,I2,V3,I3\n0,2,0,1,,\n0.4,1.5,0.3,x,,\n0.5,1,0.4,0.5,,\n0.6,0,,,,\nend: ok\n";
  const auto tables = ReadTables(text, "f", {}, BrokenRows::kRefuse);
  ASSERT_TRUE(tables) << MessageOf(tables);
  ASSERT_EQ(tables->size(), 3U);
  EXPECT_FALSE((*tables)[0].error);
  EXPECT_EQ((*tables)[0].name, "I1");
  EXPECT_THAT((*tables)[0].curve.current_A, ElementsAre(2, 1.5, 1, 0));
  EXPECT_THAT((*tables)[0].curve.assumptions.back().sentence, HasSubstr("1 line of text below"));
  ASSERT_TRUE((*tables)[1].error);
  EXPECT_EQ((*tables)[1].error->line, 3);
  EXPECT_EQ((*tables)[1].error->column, 13);
  ASSERT_TRUE((*tables)[2].error);
  EXPECT_THAT((*tables)[2].error->message, HasSubstr("expected rows of numbers"));
  // A row that no measurement can read is an error of the file.
  EXPECT_FALSE(
      ReadTables("V1,I1,V2,I2\n0,2,0,1\n0.4,x,0.4,y\n0.5,1,0.5,1\n", "f", {}, BrokenRows::kRefuse));
  ReadOptions second;
  second.column = "2";
  const auto one = ReadTables("V1,I1,V2,I2\n0,2,0,1\n0.4,x,0.4,0.5\n0.5,1,0.5,0\n", "f", second,
                              BrokenRows::kRefuse);
  ASSERT_TRUE(one) << MessageOf(one);
  EXPECT_THAT(one->front().curve.current_A, ElementsAre(1, 0.5, 0));
}

TEST(ReadTables, ReadsFurtherTablesOfEachMeasurement) {
  const auto tables =
      ReadTables("V1,I1,V2,I2\n0,2,0,1\n0.5,1,0.4,0.5\nV1,I1,V2,I2\n0,4,0,3\n0.5,2,0.4,1\n", "f",
                 {}, BrokenRows::kRefuse);
  ASSERT_TRUE(tables) << MessageOf(tables);
  ASSERT_EQ(tables->size(), 2U);
  EXPECT_THAT((*tables)[1].curve.current_A, ElementsAre(1, 0.5, 3, 1));
  EXPECT_THAT((*tables)[1].curve.sweep, ElementsAre(1, 1, 2, 2));
}

}  // namespace
}  // namespace lyrefit
