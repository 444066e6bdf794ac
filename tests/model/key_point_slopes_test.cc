#include "lyrefit/model/model_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lyrefit/base/numbers.h"

namespace lyrefit {
namespace {

KeyPointValues ValuesOf(const KeyPoints& points) {
  return {points.short_circuit_current_A, points.open_circuit_voltage_V, points.max_power_voltage_V,
          points.max_power_W};
}

struct KeyPointCase {
  const char* name;
  Device device;
  std::vector<double> p;
};

std::vector<KeyPointCase> KeyPointCases() {
  Conditions module;
  module.cells_in_series = 60;
  const Device one = MakeDevice(Model::kSingleDiode, module);
  Device film = MakeDevice(Model::kSingleDiode, module);
  AddRecombination(&film);
  return {{"one", one, {8, 1e-10, 1.05, 0.3, 200}},
          {"no_rs", one, {8, 1e-10, 1.05, 0, 200}},
          {"two", MakeDevice(Model::kDoubleDiode, module), {8, 1e-10, 1.0, 0.3, 200, 3e-6, 2.0}},
          {"film", film, {1.5, 1e-9, 1.6, 2, 900, 1.4, 54}}};
}

class KeyPointSlopesOf : public ::testing::TestWithParam<KeyPointCase> {};

TEST_P(KeyPointSlopesOf, ADeviceAreThoseOfItsKeyPoints) {
  const auto& [name, device, p] = GetParam();
  const KeyPointValues exact = ValuesOf(ModelKeyPoints(device, p.data()));
  std::vector<double> slopes(static_cast<std::size_t>(kKeyPointRows * device.size()));
  const KeyPointValues found = KeyPointsNear(device, p.data(), exact, slopes.data());
  for (int row = 0; row < kKeyPointRows; ++row) {
    EXPECT_NEAR(found[row], exact[row], 1e-11 * std::fabs(exact[row])) << row;
    for (int k = 0; k < device.size(); ++k) {
      const double step = 1e-5 * std::max(std::fabs(p[k]), 1e-3);
      std::vector<double> up = p, down = p;
      up[k] += step;
      down[k] -= step;
      if (down[k] < 0) continue;  // of Rs = 0 only
      const double difference = (ValuesOf(ModelKeyPoints(device, up.data()))[row] -
                                 ValuesOf(ModelKeyPoints(device, down.data()))[row]) /
                                (up[k] - down[k]);
      const double slope = slopes[static_cast<std::size_t>(row * device.size() + k)];
      EXPECT_NEAR(slope * p[k], difference * p[k], 1e-5 * std::fabs(exact[row]))
          << row << " by " << device.parameters[k].symbol;
    }
  }
}

TEST_P(KeyPointSlopesOf, ADeviceDoNotDependOnTheStart) {
  const auto& [name, device, p] = GetParam();
  const KeyPointValues exact = ValuesOf(ModelKeyPoints(device, p.data()));
  for (const double factor : {0.2, 0.8, 1.5, 20.0, kUnknown}) {
    KeyPointValues near = exact;
    for (double& one : near) one *= factor;
    const KeyPointValues found = KeyPointsNear(device, p.data(), near, nullptr);
    for (int row = 0; row < kKeyPointRows; ++row) {
      EXPECT_NEAR(found[row], exact[row], 1e-11 * std::fabs(exact[row])) << factor << " " << row;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(KeyPoints, KeyPointSlopesOf, ::testing::ValuesIn(KeyPointCases()),
                         [](const auto& info) { return info.param.name; });

TEST(KeyPointsNear, OfADarkDeviceAreUnknown) {
  const Device device = MakeDevice(Model::kSingleDiode, {});
  const double p[] = {0, 1e-9, 1.2, 0.01, 50};
  const KeyPointValues found = KeyPointsNear(device, p, {1, 0.6, 0.5, 0.4}, nullptr);
  EXPECT_TRUE(std::isnan(found[kVocRow]));
  EXPECT_TRUE(std::isnan(found[kPmpRow]));
}

}  // namespace
}  // namespace lyrefit
