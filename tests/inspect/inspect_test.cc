#include "lyrefit/inspect/inspect.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "error_of.h"
#include "lyrefit/read/read_curve_set.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

const fs::path kData = LYREFIT_DATA_DIR;

Inspection Inspected(const std::string& path, const ReadOptions& options = {}) {
  auto found = Inspect(path, options);
  EXPECT_TRUE(found) << path;
  return found ? std::move(*found) : Inspection();
}

std::vector<std::string> UsesOf(const Inspection& found) {
  std::vector<std::string> uses;
  for (const ColumnNote& column : found.columns) uses.push_back(column.use);
  return uses;
}

// Readings of a module of 60 cells; `format` has a place for the voltage and one for the current.
std::string ModuleRows(const char* format, double forward_A = 0) {
  std::string rows;
  for (int k = 0; k <= 24; ++k) {
    const double voltage = 1.5 * k;
    const double current = 8.5 - 3e-9 * std::exp(voltage / 1.62) - forward_A;
    rows += fmt::format(fmt::runtime(format), voltage, current) + "\n";
  }
  return rows;
}

TEST(InspectTest, FindsInEveryLayoutTheCurvesThatAreRead) {
  int layouts = 0;
  for (const auto& entry : fs::directory_iterator(kData / "formats")) {
    const std::string path = entry.path().string();
    if (entry.path().extension() == ".md" || entry.path().filename() == "batch") continue;
    const Inspection found = Inspected(path);
    EXPECT_FALSE(found.form.empty()) << path;
    EXPECT_FALSE(found.curve_count == 0 && found.refusal.empty()) << path;
    EXPECT_TRUE(found.refusal.empty() == !found.next.empty()) << path << ": " << found.refusal;
    const auto set = ReadMeasurement(path);
    if (set && found.refusal.empty()) {
      EXPECT_EQ(found.curve_count, set->curves.size()) << path;
    }
    ++layouts;
  }
  EXPECT_GT(layouts, 60);
}

TEST(InspectTest, AColumnHasItsNameUnitRangeAndFirstValues) {
  const Inspection found = Inspected((kData / "formats" / "german_comma.csv").string());
  EXPECT_EQ(found.form, "table");
  EXPECT_EQ(found.separator, "semicolon");
  EXPECT_EQ(found.decimal, "comma");
  EXPECT_EQ(found.header_line, 1);
  EXPECT_EQ(found.rows, 24);
  ASSERT_EQ(found.columns.size(), 2U);
  const ColumnNote& current = found.columns[1];
  EXPECT_EQ(current.name, "Strom [mA]");
  EXPECT_EQ(current.use, "current");
  EXPECT_EQ(current.unit, "mA");
  EXPECT_NEAR(current.least, -2237.3, 0.1);
  EXPECT_NEAR(current.largest, 8493.6, 0.1);
  EXPECT_THAT(current.first, ElementsAre("8.493,6", "8.489,5", "8.485,5"));
  EXPECT_THAT(found.missing, Contains(Field(&WayOut::flag, "--cells N")));
  EXPECT_THAT(found.next, Contains(StartsWith("lyrefit diagnose")));
}

TEST(InspectTest, LinesAboveATableAreUnderstoodOrNot) {
  const TempFolder folder;
  const Inspection found = Inspected(
      folder.Write("head.csv",
                   "Tester 12\nIrradiance [W/m2];912\nOperator code;44\nCell temperature [C];47\n"
                   "U [V];I [A]\n" +
                       ModuleRows("{};{}")));
  ASSERT_EQ(found.head.size(), 4U);
  EXPECT_EQ(found.head[1].taken, "irradiance 912 W/m2");
  EXPECT_EQ(found.head[1].line, 2);
  EXPECT_EQ(found.head[2].taken, "");
  EXPECT_EQ(found.head[3].taken, "cell temperature 47 C");
  ASSERT_EQ(found.curves.size(), 1U);
  EXPECT_EQ(found.curves[0].irradiance_W_m2, 912);
  EXPECT_NEAR(*found.curves[0].temperature_C, 47, 1e-9);
}

TEST(InspectTest, WhereNoNameIsUnderstoodItTriesThePairsOfColumns) {
  const TempFolder folder;
  std::string rows = "Bod;Napeti;Proud\n";
  std::istringstream lines(ModuleRows("{};{}"));
  int place = 0;  // a counter, which falls in a straight line beside the voltage
  for (std::string line; std::getline(lines, line);) rows += fmt::format("{};{}\n", place++, line);
  const std::string file = folder.Write("names.csv", rows);
  const Inspection found = Inspected(file);
  EXPECT_THAT(UsesOf(found), Each("not understood"));
  EXPECT_THAT(found.refusal, HasSubstr("found neither among 'Bod', 'Napeti', 'Proud'"));
  ASSERT_EQ(found.missing.size(), 1U);
  EXPECT_EQ(found.missing[0].flag, "--voltage-column 2 --current-column 3");
  EXPECT_THAT(found.missing[0].what, HasSubstr("1 curve of 25 points, Isc 8.5"));
  ReadOptions said;
  said.voltage_column = "2";
  said.current_column = "3";
  EXPECT_EQ(Inspected(file, said).refusal, "");
}

TEST(InspectTest, ExchangedColumnsAreRefusedWithTheFlagsThatTurnThem) {
  const Inspection found = Inspected((kData / "formats" / "current_first.txt").string());
  EXPECT_THAT(found.refusal, HasSubstr("columns are exchanged"));
  ASSERT_EQ(found.missing.size(), 1U);
  EXPECT_EQ(found.missing[0].flag, "--voltage-column 2 --current-column 1");
  EXPECT_THAT(found.next, IsEmpty());
}

TEST(InspectTest, AKindIsSaidOfEveryCurve) {
  const TempFolder folder;
  const auto kind_of = [&](const std::string& text) {
    const Inspection found = Inspected(folder.Write("curve.csv", text));
    return found.curves.empty() ? CurveKind::kOperatingPoints : found.curves[0].kind.kind;
  };
  const std::string head = "voltage_V,current_A\n";
  EXPECT_EQ(kind_of(head + ModuleRows("{},{}")), CurveKind::kLit);
  EXPECT_EQ(kind_of(head + ModuleRows("{},{}", 8.5)), CurveKind::kDark);
  std::string far = head, early = head, late = head;
  for (int k = 0; k <= 30; ++k) {
    const double voltage = 0.03 * k, current = 0.03 - 1e-11 * std::exp(voltage / 0.0257);
    if (voltage < 0.65) far += fmt::format("{},{}\n", voltage, current);
    if (voltage < 0.45) early += fmt::format("{},{}\n", voltage, current);
    if (voltage > 0.2 && voltage < 0.6) late += fmt::format("{},{}\n", voltage, current);
  }
  EXPECT_EQ(kind_of(far), CurveKind::kFarBeyondVoc);
  EXPECT_EQ(kind_of(early), CurveKind::kEndsEarly);
  EXPECT_EQ(kind_of(late), CurveKind::kBeginsAtVoltage);
  const Inspection dark = Inspected(folder.Write("dark.csv", head + ModuleRows("{},{}", 8.5)));
  EXPECT_TRUE(std::isnan(dark.curves[0].key_points.short_circuit_current_A));
}

TEST(InspectTest, ADeviceColumnMakesAsManyCurves) {
  const TempFolder folder;
  std::string rows = "Pixel,Voltage (V),Current (A)\n";
  for (const char* pixel : {"a", "b", "c"}) {
    rows += ModuleRows((std::string(pixel) + ",{},{}").c_str());
  }
  const Inspection found = Inspected(folder.Write("pixels.csv", rows));
  EXPECT_EQ(found.curve_count, 3U);
  EXPECT_EQ(found.columns[0].use, "device, one of 3");
  EXPECT_EQ(found.curves[1].name, "Pixel b");
  EXPECT_THAT(found.next, Contains(HasSubstr("--column NAME|N")));
}

TEST(InspectTest, OperatingPointsOfADayAreNoSweep) {
  const TempFolder folder;
  std::string log = "Serial,Time,Vpv1(V),Ipv1(A)\n";
  for (int k = 0; k < 60; ++k) {
    log += fmt::format("A7,2025-05-03 {:02}:{:02}:00,{},{}\n", 6 + k / 6, 10 * (k % 6),
                       600 + 20 * ((k * 7) % 5), 0.1 * k);
  }
  const std::string file = folder.Write("day.csv", log);
  const Inspection found = Inspected(file);
  EXPECT_EQ(found.form, "operating points of a day");
  EXPECT_THAT(found.refusal, HasSubstr("60 readings over 9.8 hours"));
  EXPECT_THAT(found.next, ElementsAre("lyrefit trend --operating " + file + " --module MODEL"));
  EXPECT_EQ(found.columns.size(), 4U);
}

TEST(InspectTest, ManyCurvesOfARowEachAreCountedAndTheFirstDescribed) {
  const TempFolder folder;
  std::string rows = "string,Voltage (V),Current (A)\n";
  for (int k = 0; k < 30; ++k) {
    rows += fmt::format("s{},0;0.2;0.4;0.5;0.55;0.6,0.035;0.035;0.034;0.03;0.02;-0.01\n", k);
  }
  const Inspection found = Inspected(folder.Write("rows.csv", rows));
  EXPECT_EQ(found.form, "table of one curve a row");
  EXPECT_EQ(found.curve_count, 30U);
  EXPECT_EQ(found.curves.size(), kMostCurveNotes);
  EXPECT_THAT(found.next, Contains(StartsWith("lyrefit batch")));
  EXPECT_THAT(InspectionText(found), HasSubstr("10 more curves."));
}

TEST(InspectTest, MatricesModulesReportsAndFoldersAreTold) {
  const Inspection matrix = Inspected((kData / "formats" / "matrix_sam.csv").string());
  EXPECT_THAT(matrix.form, StartsWith("matrix of key points"));
  EXPECT_EQ(matrix.curves[0].kind.kind, CurveKind::kKeyPoints);
  EXPECT_THAT(matrix.next, ElementsAre(HasSubstr("--family desoto|pvsyst --cells N")));
  const Inspection folder = Inspected((kData / "formats").string());
  EXPECT_THAT(folder.form, StartsWith("folder with "));
  EXPECT_THAT(folder.next, Contains(StartsWith("lyrefit batch")));
  const TempFolder own;
  const Inspection report =
      Inspected(own.Write("fit.json", R"({"lyrefit_version":"1.0.0","record":{"estimate":{}}})"));
  EXPECT_EQ(report.form, "report of this program");
  EXPECT_THAT(Inspected(own.Write("broken.json", "{\"v\": [1, 2")).form, HasSubstr("broken"));
}

TEST(InspectTest, WhatHoldsNoTableIsSaidAndWhatIsNoTextRefused) {
  const TempFolder folder;
  const Inspection words = Inspected(folder.Write("words.txt", "no curve here\nnor there\n"));
  EXPECT_EQ(words.form, "text without a table");
  EXPECT_THAT(words.refusal, Not(IsEmpty()));
  EXPECT_THAT(MessageOf(Inspect(folder.Write("empty.csv", ""))), HasSubstr("the file is empty"));
  EXPECT_THAT(MessageOf(Inspect(folder.Write("binary", std::string("\0\1\2", 3)))),
              HasSubstr("binary"));
  EXPECT_THAT(MessageOf(Inspect(folder.Path("none.csv"))), HasSubstr("does not exist"));
}

}  // namespace
}  // namespace lyrefit
