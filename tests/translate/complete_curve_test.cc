#include "lyrefit/translate/procedure_steps.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "synthetic_string.h"

namespace lyrefit {
namespace {

TEST(Completed, ContinuesReadingsByTheirDiode) {
  const SyntheticModule module;
  const CurvePoints whole = module.Readings(800, 45);
  CurvePoints cut;
  const double voc = module.Truth(800, 45).open_circuit_voltage_V;
  for (std::size_t i = 0; i < whole.voltage_V.size(); ++i) {
    if (whole.voltage_V[i] < 0.05 * voc || whole.voltage_V[i] > 0.95 * voc) continue;
    cut.voltage_V.push_back(whole.voltage_V[i]);
    cut.current_A.push_back(whole.current_A[i]);
  }
  const CurvePoints full = Completed(cut, module.Diode(800, 45), -1, -2);
  EXPECT_TRUE(std::is_sorted(full.voltage_V.begin(), full.voltage_V.end()));
  EXPECT_LE(full.voltage_V.front(), -1);
  EXPECT_LE(full.current_A.back(), -2);
  const KeyPoints key = FindKeyPoints(full.voltage_V, full.current_A);
  const KeyPoints truth = module.Truth(800, 45);
  EXPECT_NEAR(key.short_circuit_current_A, truth.short_circuit_current_A,
              1e-4 * truth.short_circuit_current_A);
  EXPECT_NEAR(key.open_circuit_voltage_V, voc, 1e-3 * voc);
}

TEST(Completed, LeavesTheReadingsThemselvesAlone) {
  const SyntheticModule module;
  const CurvePoints whole = module.Readings(800, 45);
  const CurvePoints full = Completed(whole, module.Diode(800, 45), -5, -4);
  ASSERT_GT(full.voltage_V.size(), whole.voltage_V.size());
  const auto at = std::search(full.voltage_V.begin(), full.voltage_V.end(), whole.voltage_V.begin(),
                              whole.voltage_V.end());
  ASSERT_NE(at, full.voltage_V.end());
  const std::size_t shift = at - full.voltage_V.begin();
  for (std::size_t i = 0; i < whole.current_A.size(); ++i) {
    EXPECT_EQ(full.current_A[shift + i], whole.current_A[i]);
  }
}

TEST(ByVoltage, SortsAndKeepsTheOrderOfEquals) {
  const CurvePoints sorted = ByVoltage({{2, 0, 1, 1}, {5, 8, 7, 6}});
  EXPECT_EQ(sorted.voltage_V, (std::vector<double>{0, 1, 1, 2}));
  EXPECT_EQ(sorted.current_A, (std::vector<double>{8, 7, 6, 5}));
}

}  // namespace
}  // namespace lyrefit
