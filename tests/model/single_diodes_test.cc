#include "lyrefit/model/single_diodes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

// Many single diodes, one per row. Columns: Iph, Is, Rs, Rsh, nNsVth.
struct Many {
  std::vector<double> column[5];

  void Add(double iph, double is, double rs, double rsh, double a) {
    const double values[] = {iph, is, rs, rsh, a};
    for (int k = 0; k < 5; ++k) column[k].push_back(values[k]);
  }
  std::size_t size() const { return column[0].size(); }
  SingleDiodes Get() const {
    SingleDiodes devices;
    devices.size = size();
    devices.photocurrent.data = column[0].data();
    devices.saturation_current.data = column[1].data();
    devices.resistance_series.data = column[2].data();
    devices.resistance_shunt.data = column[3].data();
    devices.nNsVth.data = column[4].data();
    return devices;
  }
};

// Devices from dimly lit cells to modules in full sun, logarithmically distributed.
Many Spread(int count) {
  RandomStream random(5);
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, random.Uniform());
  };
  Many many;
  for (int k = 0; k < count; ++k) {
    const double a = between(0.02, 6);
    many.Add(between(1e-6, 15), between(1e-14, 1e-5), between(1e-4, 3), between(3, 1e6), a);
  }
  return many;
}

struct Points {
  std::vector<double> of[7];
  explicit Points(const SingleDiodes& devices) {
    for (std::vector<double>& column : of) column.resize(devices.size);
    KeyPointsOf(devices, {of[0].data(), of[1].data(), of[2].data(), of[3].data(), of[4].data(),
                          of[5].data(), of[6].data()});
  }
};

long double Excess(const Many& many, std::size_t k, long double v, long double i) {
  const long double vd = v + i * many.column[2][k];
  return many.column[0][k] - many.column[1][k] * std::expm1(vd / many.column[4][k]) -
         vd / many.column[3][k] - i;
}

TEST(SingleDiodes, CurrentsSolveTheEquation) {
  if (std::exp(1.0L) == std::exp(1.0)) {  // musl, with a long double of 128 bits
    GTEST_SKIP() << "long double has only the exponential of double here: no truth to compare with";
  }
  const Many many = Spread(3001);
  const SingleDiodes devices = many.Get();
  const Points points(devices);
  std::vector<double> voltage, current(many.size());
  RandomStream random(9);
  for (const double voc : points.of[1]) voltage.push_back(voc * (2.4 * random.Uniform() - 1.2));
  CurrentsAt(devices, {voltage.data()}, current.data());
  for (std::size_t k = 0; k < many.size(); ++k) {
    const long double vd = voltage[k] + static_cast<long double>(current[k]) * many.column[2][k];
    const long double slope =
        1 + many.column[2][k] * (1 / many.column[3][k] + many.column[1][k] / many.column[4][k] *
                                                             std::exp(vd / many.column[4][k]));
    // Distance of the current from the root, by one Newton step in long double.
    const long double off = Excess(many, k, voltage[k], current[k]) / slope;
    // Voltages have rounding errors in the last digits, which the conductance converts to errors of
    // the current.
    const double conductance = static_cast<double>((slope - 1) / many.column[2][k] / slope);
    const double volts = std::fabs(voltage[k]) + std::fabs(static_cast<double>(vd));
    EXPECT_LE(std::fabs(off),
              2e-15 * (std::fabs(current[k]) + many.column[0][k] + many.column[1][k]) +
                  4e-16 * volts * conductance)
        << k;
  }
}

TEST(SingleDiodes, VoltagesAreTheInverseOfCurrents) {
  const Many many = Spread(2000);
  const SingleDiodes devices = many.Get();
  std::vector<double> asked, voltage(many.size()), current(many.size());
  RandomStream random(11);
  for (std::size_t k = 0; k < many.size(); ++k) {
    asked.push_back(many.column[0][k] * (1.5 * random.Uniform() - 0.5));
  }
  VoltagesAt(devices, {asked.data()}, voltage.data());
  CurrentsAt(devices, {voltage.data()}, current.data());
  for (std::size_t k = 0; k < many.size(); ++k) {
    EXPECT_NEAR(current[k], asked[k],
                1e-13 * (many.column[0][k] + std::fabs(voltage[k]) / many.column[3][k]) +
                    3e-16 * std::fabs(voltage[k]) * (many.column[0][k] / many.column[4][k]))
        << k;
  }
}

TEST(SingleDiodes, KeyPointsAreThoseOfTheDevice) {
  const Many many = Spread(500);
  const Points points(many.Get());
  for (std::size_t k = 0; k < many.size(); ++k) {
    Conditions conditions;
    conditions.cells_in_series = 1;
    const Device device = MakeDevice(Model::kSingleDiode, conditions);
    const std::vector<double> p = {many.column[0][k], many.column[1][k],
                                   many.column[4][k] / device.module_thermal_voltage_V,
                                   many.column[2][k], many.column[3][k]};
    const KeyPoints expected = ModelKeyPoints(device, p.data());
    EXPECT_NEAR(points.of[0][k] / expected.short_circuit_current_A, 1, 1e-12) << k;
    EXPECT_NEAR(points.of[1][k] / expected.open_circuit_voltage_V, 1, 1e-11) << k;
    EXPECT_NEAR(points.of[3][k] / expected.max_power_voltage_V, 1, 1e-8) << k;
    EXPECT_NEAR(points.of[4][k] / expected.max_power_W, 1, 1e-11) << k;
  }
}

TEST(SingleDiodes, ThePowerFallsToBothSidesOfItsMaximum) {
  const Many many = Spread(400);
  const SingleDiodes devices = many.Get();
  const Points points(devices);
  for (const double shift : {1 - 1e-6, 1 + 1e-6}) {
    std::vector<double> voltage, current(many.size());
    for (const double v : points.of[3]) voltage.push_back(v * shift);
    CurrentsAt(devices, {voltage.data()}, current.data());
    for (std::size_t k = 0; k < many.size(); ++k) {
      EXPECT_LE(voltage[k] * current[k], points.of[4][k] * (1 + 1e-15)) << k;
    }
  }
}

TEST(SingleDiodes, NightIsZeroAndNoShuntIsNoLeak) {
  Many many;
  many.Add(0, 1e-10, 0.3, kInfinity, 1.5);
  many.Add(8, 1e-10, 0, kInfinity, 1.5);
  const Points points(many.Get());
  for (const std::vector<double>& column : points.of) EXPECT_EQ(column[0], 0);
  EXPECT_EQ(points.of[0][1], 8);
  EXPECT_NEAR(points.of[1][1], 1.5 * std::log1p(8 / 1e-10), 1e-13);
}

TEST(SingleDiodes, WhatIsOutOfRangeIsNaNAndLeavesItsNeighboursAlone) {
  Many good = Spread(16);
  Many mixed = good;
  for (int k = 0; k < 5; ++k) mixed.column[k][static_cast<std::size_t>(3 * k)] = NAN;
  mixed.column[1][1] = 0;
  mixed.column[3][2] = -5;
  mixed.column[4][4] = kInfinity;
  const Points expected(good.Get()), points(mixed.Get());
  for (std::size_t k = 0; k < 16; ++k) {
    const bool bad = k % 3 == 0 ? k <= 12 : k == 1 || k == 2 || k == 4;
    for (int c = 0; c < 7; ++c) {
      if (bad) {
        EXPECT_TRUE(std::isnan(points.of[c][k])) << k << " " << c;
      } else {
        EXPECT_EQ(points.of[c][k], expected.of[c][k]) << k << " " << c;
      }
    }
  }
}

TEST(SingleDiodes, NoVoltageGivesMoreThanAllOfTheCurrentWithoutAShunt) {
  Many many;
  many.Add(5, 1e-9, 0.2, kInfinity, 1.4);
  many.Add(5, 1e-9, 0.2, 100, 1.4);
  const std::vector<double> asked = {5.1, 5.1};
  std::vector<double> voltage(2);
  VoltagesAt(many.Get(), {asked.data()}, voltage.data());
  EXPECT_TRUE(std::isnan(voltage[0]));
  EXPECT_NEAR(voltage[1], -100 * 0.1 - 5.1 * 0.2, 1e-6);
}

TEST(SingleDiodes, ThinFilmsLoseByRecombination) {
  Many many;
  many.Add(1.3, 1e-9, 2, 700, 2.4);
  SingleDiodes devices = many.Get();
  const double d2mutau = 1.4, built_in = 45;
  devices.recombination.data = &d2mutau;
  devices.built_in_voltage.data = &built_in;
  const Points points(devices);
  const auto excess = [&](double v, double i) {
    const double vd = v + 2 * i;
    return 1.3 - 1e-9 * std::expm1(vd / 2.4) - vd / 700 - 1.3 * d2mutau / (built_in - vd) - i;
  };
  EXPECT_NEAR(excess(0, points.of[0][0]), 0, 1e-14);
  EXPECT_NEAR(excess(points.of[1][0], 0), 0, 1e-13);
  EXPECT_NEAR(excess(points.of[3][0], points.of[2][0]), 0, 1e-13);
  EXPECT_LT(points.of[1][0], Points(many.Get()).of[1][0]);
}

}  // namespace
}  // namespace lyrefit
