#include "lyrefit/study/read_audit_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr char kRowsHeader[] =
    "source,device,model,algorithm,rmse_A,Iph_A,Rs_ohm,Rsh_ohm,Is1_A,Is1_uA,n1,Is2_A,n2,"
    "temperature_C,cells,constants,bounds,note\n";

class ReadAuditRowsTest : public ::testing::Test {
 protected:
  Expected<AuditRows> Read(const std::string& text) {
    return ReadAuditRows(folder_.Write("rows.csv", text));
  }

  // The error of the only row below the usual header.
  Error BadRow(const std::string& row) {
    const auto rows = Read(kRowsHeader + row + "\n");
    if (!rows) return rows.error();
    EXPECT_THAT(rows->rows, SizeIs(0)) << row;
    EXPECT_THAT(rows->bad_rows, SizeIs(1)) << row;
    return rows->bad_rows.empty() ? Error{} : rows->bad_rows[0];
  }

  TempFolder folder_;
};

TEST_F(ReadAuditRowsTest, KeepsDigitsAndUnits) {
  const auto rows =
      Read(std::string("# a comment\n") + kRowsHeader +
           "Table 10,rtc_france,sd,LO,9.89674E-04,0.760827451,0.0363,53.96,,3.31823E-01,1.4839,,,"
           "33,1,paper,literature,\"a, note\"\n");
  ASSERT_TRUE(rows) << rows.error().ToString();
  ASSERT_THAT(rows->rows, SizeIs(1));
  EXPECT_THAT(rows->bad_rows, SizeIs(0));
  const AuditRow& row = rows->rows[0];
  EXPECT_EQ(row.source, "Table 10");
  EXPECT_EQ(row.device, "rtc_france");
  EXPECT_EQ(row.algorithm, "LO");
  EXPECT_EQ(row.model, Model::kSingleDiode);
  EXPECT_EQ(row.line, 3);
  EXPECT_EQ(row.rmse.text, "9.89674E-04");
  EXPECT_DOUBLE_EQ(row.rmse.value, 9.89674e-4);
  EXPECT_DOUBLE_EQ(row.rmse.half_unit, 0.5e-9);
  ASSERT_THAT(row.parameters, SizeIs(5));
  EXPECT_EQ(row.parameters[1].text, "3.31823E-01");
  EXPECT_DOUBLE_EQ(row.parameters[1].value, 3.31823e-7);
  EXPECT_DOUBLE_EQ(row.parameters[1].half_unit, 0.5e-12);
  EXPECT_DOUBLE_EQ(row.parameters[1].factor, 1e-6);
  EXPECT_DOUBLE_EQ(row.parameters[kRs].value, 0.0363);
  EXPECT_DOUBLE_EQ(row.parameters[kRs].half_unit, 0.00005);
  EXPECT_EQ(row.temperature_C, 33);
  EXPECT_EQ(row.cells, 1);
  EXPECT_EQ(row.constants, ConstantSet::kPaper);
  EXPECT_EQ(row.bounds, "literature");
  EXPECT_EQ(row.note, "a, note");
}

TEST_F(ReadAuditRowsTest, TakesColumnsInAnyOrderAndCase) {
  const auto rows = Read(
      "N1;IS1_MA;rsh_OHM;RS_mOhm;IPH_ma;RMSE_mA;Algorithm;MODEL;Device;Source\n"
      "1.5;1e-3;50;36.5;760;0.986;x;SD;cell;T\n");
  ASSERT_TRUE(rows) << rows.error().ToString();
  ASSERT_THAT(rows->rows, SizeIs(1));
  const AuditRow& row = rows->rows[0];
  EXPECT_DOUBLE_EQ(row.rmse.value, 0.986e-3);
  EXPECT_DOUBLE_EQ(row.parameters[kIph].value, 0.76);
  EXPECT_DOUBLE_EQ(row.parameters[1].value, 1e-6);
  EXPECT_DOUBLE_EQ(row.parameters[kRs].value, 0.0365);
  EXPECT_FALSE(row.temperature_C);
  EXPECT_FALSE(row.cells);
  EXPECT_FALSE(row.constants);
}

TEST_F(ReadAuditRowsTest, TakesZerosAndWholeIdealitiesAsExact) {
  const auto rows =
      Read(std::string(kRowsHeader) + "T,cell,dd,x,1e-3,0.76,0,53,0,,2,1e-7,1.5,,,,,\n");
  ASSERT_TRUE(rows) << rows.error().ToString();
  ASSERT_THAT(rows->rows, SizeIs(1));
  std::vector<double> half_units;
  for (const PrintedNumber& number : rows->rows[0].parameters) {
    half_units.push_back(number.half_unit);
  }
  //                                    Iph    Is1 n1 Rs Rsh  Is2     n2
  EXPECT_THAT(half_units, ElementsAre(0.005, 0, 0, 0, 0.5, 0.5e-7, 0.05));
}

TEST_F(ReadAuditRowsTest, RefusesAHeaderWithoutANeededColumn) {
  const auto rows = Read("\nsource,device,model,rmse_A,Iph_A,Rs_ohm,Is1_A,n1\nT,c,sd,1,1,1,1,1\n");
  ASSERT_FALSE(rows);
  EXPECT_THAT(rows.error().message, HasSubstr("missing columns: algorithm, rsh"));
  EXPECT_THAT(rows.error().file, HasSubstr("rows.csv"));
  EXPECT_EQ(rows.error().line, 2);
  EXPECT_EQ(rows.error().column, 1);
}

TEST_F(ReadAuditRowsTest, RefusesUnknownAndRepeatedColumns) {
  const auto unknown = Read("source,device,Temprature_C\n");
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message, HasSubstr("unknown column 'Temprature_C'"));
  EXPECT_EQ(unknown.error().column, 15);
  EXPECT_THAT(MessageOf(Read("Iph_V\n")), HasSubstr("unknown column 'Iph_V'"));
  const auto twice = Read("n1,device,N1\n");
  ASSERT_FALSE(twice);
  EXPECT_THAT(twice.error().message, HasSubstr("'N1' stands twice"));
  EXPECT_EQ(twice.error().column, 11);
  EXPECT_THAT(MessageOf(Read("note,note\n")), HasSubstr("'note' stands twice"));
}

TEST_F(ReadAuditRowsTest, TakesAClaimWithoutParameters) {
  const auto rows = Read(std::string(kRowsHeader) + "T,cell,dd,x,1e-3,,,,,,,,,,,,,\n");
  ASSERT_TRUE(rows) << rows.error().ToString();
  ASSERT_THAT(rows->rows, SizeIs(1)) << rows->bad_rows[0].ToString();
  EXPECT_THAT(rows->rows[0].parameters, SizeIs(0));
  EXPECT_FALSE(rows->rows[0].sum_of_squares);
  EXPECT_THAT(BadRow("T,cell,dd,x,1e-3,,,,,,,1e-7,,,,,,").message, HasSubstr("expected Iph"));
  EXPECT_THAT(BadRow("T,cell,sd,x,1e-3,,,,,,,1e-7,,,,,,").message, HasSubstr("has no Is2"));
}

TEST_F(ReadAuditRowsTest, TakesSumsOfSquares) {
  const std::string header =
      "source,device,model,algorithm,rmse_A,sse_A2,Iph_A,Rs_ohm,Rsh_100ohm,Is1_A,n1,objective\n";
  const auto rows = Read(header + "T,cell,sd,x,,2.5278e-05,0.76,0.036,0.537,3e-7,1.48,\n" +
                         "T,cell,sd,x,1e-3,2.5278e-05,0.76,0.036,0.537,3e-7,1.48,\n" +
                         "T,cell,sd,x,,,0.76,0.036,0.537,3e-7,1.48,solved-current\n" +
                         "T,cell,sd,x,1e-3,,0.76,0.036,0.537,3e-7,1.48,Solved-Current\n");
  ASSERT_TRUE(rows) << rows.error().ToString();
  ASSERT_THAT(rows->rows, SizeIs(2));
  EXPECT_TRUE(rows->rows[0].sum_of_squares);
  EXPECT_DOUBLE_EQ(rows->rows[0].rmse.value, 2.5278e-5);
  EXPECT_DOUBLE_EQ(rows->rows[0].parameters[kRsh].value, 53.7);
  EXPECT_DOUBLE_EQ(rows->rows[0].parameters[kRsh].half_unit, 0.05);
  EXPECT_FALSE(rows->rows[0].objective);
  EXPECT_EQ(rows->rows[1].objective, Objective::kSolvedCurrent);
  ASSERT_THAT(rows->bad_rows, SizeIs(2));
  EXPECT_THAT(rows->bad_rows[0].message, HasSubstr("found both"));
  EXPECT_EQ(rows->bad_rows[0].column, 18);
  EXPECT_THAT(rows->bad_rows[1].message, HasSubstr("expected RMSE"));
}

TEST_F(ReadAuditRowsTest, RefusesFilesWithoutRows) {
  EXPECT_FALSE(ReadAuditRows(folder_.Path("missing.csv")));
  EXPECT_FALSE(Read("# nothing\n"));
  EXPECT_THAT(MessageOf(Read(kRowsHeader)), HasSubstr("expected rows"));
}

TEST_F(ReadAuditRowsTest, SaysWhereARowIsWrong) {
  const struct {
    const char* row;
    const char* message;
    int column;
  } cases[] = {
      {"T,cell,sd,x,1e-3,O.76,0.1,53,1e-7,,1.5,,,,,,,", "expected Iph, a number", 18},
      {"T,cell,sd,x,1e-3,0.76,0.1,53,,,1.5,,,,,,,", "expected Is1 of model sd", 30},
      {"T,cell,dd,x,1e-3,0.76,0.1,53,1e-7,,1.5,,2,,,,,", "expected Is2 of model dd", 40},
      {"T,cell,td,x,1e-3,0.76,0.1,53,1e-7,,1.5,1e-7,2,,,,,", "the header has no column", 1},
      {"T,cell,sd,x,1e-3,0.76,0.1,53,1e-7,1,1.5,,,,,,,", "Is1 is given twice", 35},
      {"T,cell,sd,x,1e-3,0.76,0.1,53,1e-7,,1.5,1e-7,,,,,,", "model sd has no Is2", 40},
      {"T,cell,xd,x,1e-3,0.76,0.1,53,1e-7,,1.5,,,,,,,", "expected a model (sd, dd, td)", 8},
      {"T,,sd,x,1e-3,0.76,0.1,53,1e-7,,1.5,,,,,,,", "name of a curve's folder", 3},
      {"T,cell,sd,x,1e-3,0.76,0.1,53,1e-7,,0,,,,,,,", "expected n1, a number above 0", 36},
      {"T,cell,sd,x,1e-3,0.76,0.1,53,1e-7,,-1.5,,,,,,,", "expected n1, a number above 0", 36},
      {"T,cell,sd,x,1e-3,0.76,0.1,nan,1e-7,,1.5,,,,,,,", "expected Rsh", 27},
      {"T,cell,sd,x,1e-3,0.76,0.1,inf,1e-7,,1.5,,,,,,,", "expected Rsh", 27},
      {"T,cell,sd,x,1e-3,0.76,-0.1,53,1e-7,,1.5,,,,,,,", "expected Rs, a number from 0", 23},
      {"T,cell,sd,x,0,0.76,0.1,53,1e-7,,1.5,,,,,,,", "expected RMSE, a number above 0", 13},
      {"T,cell,sd,x,1e-3,0.76,0.1,53,1e-7,,1.5,,,306,,,,", "degrees Celsius", 42},
      {"T,cell,sd,x,1e-3,0.76,0.1,53,1e-7,,1.5,,,,1.5,,,", "cells in series", 43},
      {"T,cell,sd,x,1e-3,0.76,0.1,53,1e-7,,1.5,,,,,nist,,", "a set of constants", 44},
      {"T,cell,sd,x,1e-3,0.76,0.1,53,1e-7,,1.5,,,,,,", "expected 18 fields", 45},
      {"T,\"cell,sd,x,1e-3,0.76,0.1,53,1e-7,,1.5,,,,,,,", "quotes do not close", 1},
  };
  for (const auto& c : cases) {
    const Error error = BadRow(c.row);
    EXPECT_THAT(error.message, HasSubstr(c.message)) << c.row;
    EXPECT_THAT(error.file, HasSubstr("rows.csv")) << c.row;
    EXPECT_EQ(error.line, 2) << c.row;
    EXPECT_EQ(error.column, c.column) << c.row << "\n" << error.ToString();
  }
}

TEST_F(ReadAuditRowsTest, ReadsOnBehindABadRow) {
  const auto rows = Read(std::string(kRowsHeader) +
                         "T,cell,sd,a,1e-3,0.76,0.1,53,1e-7,,1.5,,,,,,,\n"
                         "T,cell,sd,b,1e-3,text,0.1,53,1e-7,,1.5,,,,,,,\n"
                         "\n"
                         "T,cell,sd,c,1e-3,0.76,0.1,53,1e-7,,1.5,,,,,,,\n");
  ASSERT_TRUE(rows) << rows.error().ToString();
  ASSERT_THAT(rows->rows, SizeIs(2));
  EXPECT_EQ(rows->rows[1].algorithm, "c");
  EXPECT_EQ(rows->rows[1].line, 5);
  ASSERT_THAT(rows->bad_rows, SizeIs(1));
  EXPECT_EQ(rows->bad_rows[0].line, 3);
}

}  // namespace
}  // namespace lyrefit
