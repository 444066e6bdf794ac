#include "lyrefit/read/rewrite_table.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.h"
#include "lyrefit/read/read_curve.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAreArray;
using ::testing::HasSubstr;

const std::vector<double> kScanVoltages = {2000, 3000, 4000, 5000, 6000, 6500,
                                           6800, 7000, 7200, 7400, 7500, 7600};
const std::vector<double> kScanCurrents = {910, 909, 908, 906, 890, 840,
                                           760, 650, 480, 260, 130, 0};

std::vector<double> Paired(const std::vector<double>& first, const std::vector<double>& second) {
  std::vector<double> pairs;
  for (std::size_t k = 0; k < first.size(); ++k) {
    pairs.push_back(first[k]);
    pairs.push_back(second[k]);
  }
  return pairs;
}

std::string AsLines(const std::vector<double>& registers, const char* format) {
  std::string lines;
  for (std::size_t k = 0; k < registers.size(); ++k) {
    lines += fmt::format(fmt::runtime(format), static_cast<int>(registers[k]));
    lines += k % 12 == 11 ? "\n" : " ";
  }
  return lines + "\n";
}

TEST(RegisterScanTest, PairsAndBlocksAreTakenApart) {
  std::vector<double> registers = Paired(kScanVoltages, kScanCurrents);
  registers.resize(64);  // padded
  auto scan = AsRegisterScan(registers);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->voltages.size(), 32U);
  EXPECT_EQ(scan->currents[0][1], 909);
  scan = AsRegisterScan(Paired(kScanCurrents, kScanVoltages));
  ASSERT_TRUE(scan);
  EXPECT_THAT(scan->voltages, ElementsAreArray(kScanVoltages));
  registers = kScanVoltages;
  for (int string = 0; string < 3; ++string) {
    registers.insert(registers.end(), kScanCurrents.begin(), kScanCurrents.end());
  }
  scan = AsRegisterScan(registers);
  ASSERT_TRUE(scan);
  EXPECT_THAT(scan->voltages, ElementsAreArray(kScanVoltages));
  ASSERT_EQ(scan->currents.size(), 3U);
  EXPECT_THAT(scan->currents[2], ElementsAreArray(kScanCurrents));
}

TEST(RegisterScanTest, OtherListsAreNone) {
  EXPECT_FALSE(AsRegisterScan({}));
  EXPECT_FALSE(AsRegisterScan(kScanVoltages));
  EXPECT_FALSE(AsRegisterScan(std::vector<double>(64, 0)));
  EXPECT_FALSE(AsRegisterScan(Paired(kScanVoltages, kScanVoltages)));
  std::vector<double> broken = Paired(kScanVoltages, kScanCurrents);
  broken[6] = 9000;
  EXPECT_FALSE(AsRegisterScan(broken));
}

TEST(RegisterDumpTest, EveryWayToWriteItGivesTheSameCurve) {
  const std::vector<double> pairs = Paired(kScanVoltages, kScanCurrents);
  std::string addressed = "# voltage 0.1 V, current 0.01 A\nregister;name;value\n";
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    addressed += fmt::format("{};point {};{}\n", 5000 + k, k / 2, pairs[k]);
  }
  for (const std::string& text :
       {addressed, "# voltage gain 10, current gain 100\n" + AsLines(pairs, "{}"),
        "PV1: voltage 0.1V; current 0.01A\n" + AsLines(pairs, "{:04X}"),
        "# voltage scale 0.1, current scale 0.01\n" + AsLines(pairs, "0x{:x}")}) {
    const auto curve = ReadCurveText(text, "dump");
    ASSERT_TRUE(curve) << text << curve.error().ToString();
    ASSERT_EQ(curve->size(), kScanVoltages.size()) << text;
    EXPECT_NEAR(curve->voltage_V[3], 500, 1e-9) << text;
    EXPECT_NEAR(curve->current_A[3], 9.06, 1e-9) << text;
    EXPECT_TRUE(curve->voltage_unit_known && curve->current_unit_known);
  }
}

TEST(RegisterDumpTest, WhatIsNoDumpIsLeft) {
  const std::string gap = "address,value\n1,2000\n2,910\n4,3000\n";
  EXPECT_EQ(RowsOfRegisters(gap), "");
  EXPECT_EQ(RowsOfRegisters("voltage,current\n0,9\n10,8\n20,7\n"), "");
  EXPECT_EQ(RowsOfRegisters(AsLines(Paired(kScanVoltages, kScanCurrents), "{}") + "end\n"), "");
}

}  // namespace
}  // namespace lyrefit
