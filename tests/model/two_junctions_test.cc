#include "lyrefit/model/two_junctions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lyrefit/base/constants.h"

namespace lyrefit {
namespace {

const double kTandemVt = ThermalVoltage(298.15);

const std::vector<std::vector<double>> kTandems = {
    {0.0195, 1e-14, 1.4, 3000, 0.0202, 3e-10, 1.2, 1500, 2.0},
    {0.0140, 2e-23, 1.15, 2e4, 0.0128, 1e-17, 1.1, 5e4, 0.8},
    {4.4, 1e-16, 1.9, 5, 7.8, 1e-9, 1.05, 0.6, 0.03},
    {0.0195, 1e-14, 1.4, 80, 0.002, 3e-10, 1.2, 1500, 2.0},
};

struct TandemPoint {
  int device;
  double voltage_V;
  double current_A;
};

// Currents of two_junctions_reference.py.
constexpr TandemPoint kTandemPoints[] = {
    {0, -0.5, 1.9787867485662036e-02}, {0, 0.0, 1.9628490047163098e-02},
    {0, 0.6, 1.9433705306720124e-02},  {0, 1.1, 1.9268020674280090e-02},
    {0, 1.4, 1.7026355740121926e-02},  {0, 1.7, -3.1588035055475742e-02},
    {0, 2.4, -3.1845919670011819e-01}, {1, -0.5, 1.2836652591403231e-02},
    {1, 0.0, 1.2826658107470653e-02},  {1, 0.6, 1.2814664663437390e-02},
    {1, 1.1, 1.2804670074979055e-02},  {1, 1.4, 1.2798673299687471e-02},
    {1, 1.7, 1.2792676503714176e-02},  {1, 2.4, 2.0756310265985598e-04},
    {2, -0.5, 4.5886385165287376e+00}, {2, 0.0, 4.4894625863470008e+00},
    {2, 0.6, 4.3704395426261504e+00},  {2, 1.1, 4.2712445340125971e+00},
    {2, 1.4, 4.2117237914548369e+00},  {2, 1.7, 4.1521900007467929e+00},
    {2, 2.4, 1.5512431379909160e+00},  {3, -0.5, 2.9726266553824609e-03},
    {3, 0.0, 2.6413036264102915e-03},  {3, 0.6, 2.2436006619291123e-03},
    {3, 1.1, 1.9120742831536827e-03},  {3, 1.4, 1.3962728269710358e-03},
    {3, 1.7, -3.7999432014568964e-02}, {3, 2.4, -3.1990286295136466e-01},
};

TEST(TwoJunctions, CurrentsAreThoseOfNestedBracketing) {
  for (const TandemPoint& point : kTandemPoints) {
    const std::vector<double>& p = kTandems[point.device];
    const double size = std::max(p[JunctionPhotocurrent(0)], p[JunctionPhotocurrent(1)]);
    const double current = TwoJunctionCurrent(kTandemVt, p.data(), point.voltage_V);
    EXPECT_NEAR(current, point.current_A, 1e-10 * size) << point.device << " " << point.voltage_V;
    EXPECT_NEAR(TwoJunctionVoltage(kTandemVt, p.data(), point.current_A), point.voltage_V, 1e-6);
  }
}

TEST(TwoJunctions, AStartChangesNoCurrent) {
  for (const TandemPoint& point : kTandemPoints) {
    const std::vector<double>& p = kTandems[point.device];
    const double size = std::max(p[JunctionPhotocurrent(0)], p[JunctionPhotocurrent(1)]);
    for (const double start : {-10 * size, 0.0, 0.9 * size, 50 * size}) {
      EXPECT_NEAR(TwoJunctionCurrent(kTandemVt, p.data(), point.voltage_V, nullptr, start),
                  point.current_A, 1e-10 * size);
    }
  }
}

TEST(TwoJunctions, SlopesAreCentralDifferences) {
  for (const TandemPoint& point : kTandemPoints) {
    std::vector<double> p = kTandems[point.device];
    double slopes[kTwoJunctionParameters];
    TwoJunctionCurrent(kTandemVt, p.data(), point.voltage_V, slopes);
    const double size = std::max(p[JunctionPhotocurrent(0)], p[JunctionPhotocurrent(1)]);
    for (int i = 0; i < kTwoJunctionParameters; ++i) {
      const double at = p[i], step = 1e-5 * at;
      p[i] = at + step;
      const double above = TwoJunctionCurrent(kTandemVt, p.data(), point.voltage_V);
      p[i] = at - step;
      const double below = TwoJunctionCurrent(kTandemVt, p.data(), point.voltage_V);
      p[i] = at;
      // A whole change of the parameter, in photocurrents.
      EXPECT_NEAR(slopes[i] * at / size, (above - below) / (2 * step) * at / size,
                  1e-6 * std::max(1.0, std::fabs(slopes[i] * at / size)))
          << point.device << " " << point.voltage_V << " " << i;
    }
  }
}

TEST(TwoJunctions, KeyPointsLieOnTheCurve) {
  for (const std::vector<double>& p : kTandems) {
    const KeyPoints points = TwoJunctionKeyPoints(kTandemVt, p.data());
    const auto current = [&](double voltage) {
      return TwoJunctionCurrent(kTandemVt, p.data(), voltage);
    };
    EXPECT_DOUBLE_EQ(points.short_circuit_current_A, current(0));
    EXPECT_NEAR(current(points.open_circuit_voltage_V), 0, 1e-11 * p[0]);
    EXPECT_NEAR(current(points.max_power_voltage_V), points.max_power_current_A, 1e-9 * p[0]);
    for (const double step : {-1e-3, 1e-3}) {
      const double beside = points.max_power_voltage_V + step;
      EXPECT_LT(beside * current(beside), points.max_power_W);
    }
  }
}

TEST(TwoJunctions, APerfectShuntAndADarkJunctionHaveACurrent) {
  std::vector<double> p = kTandems[0];
  p[JunctionShunt(0)] = p[JunctionShunt(1)] = HUGE_VAL;
  EXPECT_NEAR(TwoJunctionCurrent(kTandemVt, p.data(), 0), p[JunctionPhotocurrent(0)],
              1e-9 * p[JunctionPhotocurrent(0)]);
  p = kTandems[0];
  p[JunctionPhotocurrent(1)] = 0;
  // The dark junction blocks: at open circuit all voltage is that of the lit one.
  const double voc = TwoJunctionVoltage(kTandemVt, p.data(), 0);
  const double lit =
      p[JunctionIdeality(0)] * kTandemVt *
      std::log((p[JunctionPhotocurrent(0)] - voc / p[JunctionShunt(0)]) / p[JunctionSaturation(0)] +
               1);
  EXPECT_NEAR(voc, lit, 1e-12);
}

}  // namespace
}  // namespace lyrefit
