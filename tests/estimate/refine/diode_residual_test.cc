#include "lyrefit/model/diode_residual.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lyrefit/base/option.h"
#include "lyrefit/estimate/refine/model_current.h"

namespace lyrefit {
namespace {

struct Drawn {
  Device device;
  std::vector<double> p;
  std::vector<double> voltage_V;
  std::vector<double> current_A;
};

// A device of a cell or a module, of one to three diodes, from soft to steep: n from 0.6, Is down to
// 1e-14 of Iph, Rs from none to one that takes half the voltage; points from reverse voltages to far
// beyond open circuit, whose currents are off by up to a tenth of Iph.
Drawn Draw(std::mt19937_64* random) {
  const auto uniform = [random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(*random);
  };
  const auto log_uniform = [&](double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  };
  Drawn drawn;
  Conditions conditions;
  conditions.cells_in_series = uniform(0, 1) < 0.5 ? 1 : 60;
  conditions.cell_temperature_K = uniform(260, 350);
  const auto model = static_cast<Model>(std::uniform_int_distribution<int>(1, 3)(*random));
  drawn.device = MakeDevice(model, conditions);
  const double iph = log_uniform(1e-3, 20);
  const double vt = drawn.device.module_thermal_voltage_V;
  drawn.p.resize(static_cast<std::size_t>(drawn.device.size()));
  drawn.p[kIph] = iph;
  double voc = HUGE_VAL;
  for (int d = 0; d < static_cast<int>(model); ++d) {
    const double n = uniform(0.6, 3), is = iph * log_uniform(1e-14, 1e-4);
    drawn.p[static_cast<std::size_t>(SaturationCurrentIndex(d))] = is;
    drawn.p[static_cast<std::size_t>(IdealityIndex(d))] = n;
    voc = std::fmin(voc, n * vt * std::log(iph / is));
  }
  drawn.p[kRs] = uniform(0, 1) < 0.2 ? 0 : log_uniform(1e-5, 0.5) * voc / iph;
  drawn.p[kRsh] = log_uniform(1, 1e6) * voc / iph;
  for (int k = 0; k < 8; ++k) {
    drawn.voltage_V.push_back(uniform(-0.5, 1.3) * voc);
    const double current =
        SolvePoint(drawn.device, drawn.p.data(), drawn.voltage_V.back()).current_A;
    drawn.current_A.push_back(current + 0.1 * iph * uniform(-1, 1));
  }
  return drawn;
}

// Largest differences from the vector kernels, relative to the size of what is compared.
struct Largest {
  double value = 0;
  double slope = 0;
};

template <int kSize>
void Compare(const Drawn& drawn, Objective objective, Largest* largest) {
  const PointSet points = MakePointSet(drawn.voltage_V, drawn.current_A);
  const std::size_t size = drawn.voltage_V.size();
  std::vector<double> current(size), slopes(size * kSize);
  ModelCurrents(drawn.device, objective, drawn.p.data(), points, FastestKernel(), current.data(),
                slopes.data());
  for (std::size_t k = 0; k < size; ++k) {
    const DiodeResidual residual(drawn.device, objective, drawn.voltage_V[k], drawn.current_A[k]);
    ceres::Jet<double, kSize> p[kSize], found;
    double plain = 0;
    for (int i = 0; i < kSize; ++i) p[i] = {drawn.p[static_cast<std::size_t>(i)], i};
    ASSERT_TRUE(residual(p, &found));
    ASSERT_TRUE(residual(drawn.p.data(), &plain));
    EXPECT_EQ(found.a, plain);
    // The terms cancel in a current: its error is that of the largest.
    const double scale = std::fabs(current[k]) + std::fabs(drawn.current_A[k]) + drawn.p[kIph];
    largest->value =
        std::fmax(largest->value, std::fabs(found.a - (current[k] - drawn.current_A[k])) / scale);
    for (int i = 0; i < kSize; ++i) {
      const double expected = slopes[k * kSize + static_cast<std::size_t>(i)];
      if (expected == 0) continue;
      const double off = std::fabs(found.v[i] - expected) / std::fabs(expected);
      largest->slope = std::fmax(largest->slope, off);
    }
  }
}

TEST(DiodeResidual, HasTheValuesAndSlopesOfTheVectorKernels) {
  std::mt19937_64 random(7);
  for (const Objective objective : {Objective::kMeasuredCurrent, Objective::kSolvedCurrent}) {
    Largest largest;
    for (int draw = 0; draw < 1000; ++draw) {
      const Drawn drawn = Draw(&random);
      if (drawn.device.size() == 5) Compare<5>(drawn, objective, &largest);
      if (drawn.device.size() == 7) Compare<7>(drawn, objective, &largest);
      if (drawn.device.size() == 9) Compare<9>(drawn, objective, &largest);
    }
    EXPECT_LT(largest.value, 1e-12) << ToText(objective);
    EXPECT_LT(largest.slope, 1e-12) << ToText(objective);
    RecordProperty("largest difference of a value",
                   ToText(objective) + " " + NumberText(largest.value));
    RecordProperty("largest difference of a slope",
                   ToText(objective) + " " + NumberText(largest.slope));
  }
}

TEST(DiodeResidual, IsWeighed) {
  const Device device = MakeDevice(Model::kSingleDiode, {});
  const double p[] = {2, 1e-9, 1.2, 0.05, 30};
  for (const Objective objective : {Objective::kMeasuredCurrent, Objective::kSolvedCurrent}) {
    double plain = 0, weighed = 0;
    DiodeResidual(device, objective, 0.5, 1.7)(p, &plain);
    DiodeResidual(device, objective, 0.5, 1.7, 100)(p, &weighed);
    EXPECT_NE(plain, 0);
    EXPECT_DOUBLE_EQ(weighed, 100 * plain);
  }
}

TEST(DiodeResidualDeathTest, RefusesEffects) {
  Device device = MakeDevice(Model::kSingleDiode, {});
  device.effects = std::shared_ptr<const DeviceEffects>(
      std::shared_ptr<int>(), reinterpret_cast<const DeviceEffects*>(&device));
  EXPECT_DEATH(DiodeResidual(device, Objective::kSolvedCurrent, 0.5, 1), "whole measurement");
}

}  // namespace
}  // namespace lyrefit
