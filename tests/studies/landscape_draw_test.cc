#include "studies/landscape_draw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lyrefit {
namespace {

// A shaded module measured without noise by this tracer.
LandscapeCase ReadWith(Tracer tracer) {
  RandomStream random(3);
  DrawnDevice device = DrawModule(3, &random);
  device.tracer = tracer;
  device.beyond = 1;
  device.made.points = 120;
  device.made.noise_A = 0;
  device.made.with = {Held("shading", {{"d", 0.4}, {"w", 1.0 / 3}, {"Vb", 0.5}})};
  const auto read = Measure(device);
  EXPECT_TRUE(read) << read.error().ToString();
  return read ? *read : LandscapeCase{};
}

// Smallest and largest value of f(dV, dI, I) over the steps, in units of Voc and Isc. NaN values
// are left out.
template <class F>
std::pair<double, double> Steps(const IvCurve& curve, const F& f) {
  const double voc = curve.voltage_V.back(), isc = curve.current_A.front();
  double least = HUGE_VAL, most = 0;
  for (std::size_t k = 1; k < curve.size(); ++k) {
    const double current = 0.5 * (curve.current_A[k] + curve.current_A[k - 1]) / isc;
    const double step = f((curve.voltage_V[k] - curve.voltage_V[k - 1]) / voc,
                          (curve.current_A[k] - curve.current_A[k - 1]) / isc, current);
    if (std::isnan(step)) continue;
    least = std::min(least, step);
    most = std::max(most, step);
  }
  return {least, most};
}

TEST(Measure, StepsTheVoltageEvenlyFromShortToOpenCircuit) {
  const IvCurve curve = ReadWith(Tracer::kVoltage).curve;
  ASSERT_EQ(curve.size(), 120U);
  EXPECT_EQ(curve.voltage_V.front(), 0);
  EXPECT_NEAR(curve.current_A.back(), 0, 1e-3 * curve.current_A.front());
  const auto [least, most] = Steps(curve, [](double dv, double, double) { return dv; });
  EXPECT_NEAR(least, 1.0 / 119, 1e-9);
  EXPECT_NEAR(most, 1.0 / 119, 1e-9);
}

TEST(Measure, StepsTheLengthAlongTheCurveEvenly) {
  const IvCurve curve = ReadWith(Tracer::kArc).curve;
  ASSERT_EQ(curve.size(), 120U);
  EXPECT_NEAR(curve.current_A.back(), 0, 1e-3 * curve.current_A.front());
  const auto [least, most] =
      Steps(curve, [](double dv, double di, double) { return std::hypot(dv, di); });
  EXPECT_GT(least, 0.9 * most);  // across a knee the step is a chord
}

TEST(Measure, ReadsACapacitorThatTheDeviceChargesAtEvenTimes) {
  const IvCurve curve = ReadWith(Tracer::kCharge).curve;
  ASSERT_EQ(curve.size(), 120U);
  EXPECT_NEAR(curve.current_A.back(), 0, 1e-3 * curve.current_A.front());
  // Equal time steps, checked until the current falls to 0.1 Isc.
  const auto [least, most] =
      Steps(curve, [](double dv, double, double i) { return i > 0.1 ? dv / i : NAN; });
  EXPECT_GT(least, 0.9 * most);
}

TEST(Measure, KeepsWhatTheDeviceIsAndWhatItWasMadeWith) {
  const LandscapeCase device = ReadWith(Tracer::kVoltage);
  EXPECT_EQ(device.curve.notes.bypass_diodes, 3);
  EXPECT_EQ(device.truth.at("shading.d"), 0.4);
  EXPECT_EQ(device.truth.size(), 8U);
  EXPECT_NEAR(device.curve.current_A.front(), device.truth.at("Iph"),
              0.06 * device.truth.at("Iph"));
}

TEST(Measure, RefusesADeviceInTheDark) {
  RandomStream random(3);
  DrawnDevice device = DrawModule(3, &random);
  device.made.parameters["Iph"] = 0;
  EXPECT_FALSE(Measure(device));
}

}  // namespace
}  // namespace lyrefit
