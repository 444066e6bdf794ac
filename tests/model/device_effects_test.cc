#include "lyrefit/model/device_effects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "effects/synthetic_use.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/reporting_units.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

const std::vector<double> kModule = {8.2, 2e-9, 1.15, 0.25, 300};

// A sweep up and down of a module, below 0 V at its ends, with times.
IvCurve UpAndDown() {
  IvCurve curve;
  curve.name = "made";
  curve.conditions.cells_in_series = 60;
  for (int k = 0; k < 40; ++k) curve.voltage_V.push_back(-2 + 41.0 * k / 39);
  for (int k = 38; k >= 0; --k) curve.voltage_V.push_back(curve.voltage_V[k]);
  for (std::size_t k = 0; k < curve.voltage_V.size(); ++k) curve.time_s.push_back(0.01 * k);
  const Device device = MakeDevice(Model::kSingleDiode, curve.conditions);
  curve.current_A = SolveCurrents(device, kModule.data(), curve.voltage_V);
  return curve;
}

Expected<Device> ExtendModule(const std::vector<EffectUse>& uses, bool force = true) {
  const IvCurve curve = UpAndDown();
  return Extend(MakeDevice(Model::kSingleDiode, curve.conditions), Model::kSingleDiode,
                ConstantSet::kCodata, curve, uses, force);
}

std::string ErrorOf(const std::vector<EffectUse>& uses, bool force = true) {
  const auto device = ExtendModule(uses, force);
  return device ? "no error" : device.error().ToString();
}

class DeviceEffectsTest : public ::testing::TestWithParam<const Effect*> {};

TEST_P(DeviceEffectsTest, LeadsToReportedUnitsAndBack) {
  const auto device = ExtendModule({{GetParam(), {}}});
  ASSERT_TRUE(device) << device.error().ToString();
  const Readings& readings = device->effects->readings;
  std::vector<Probe> probes = GetParam()->probes(readings.traits);
  for (const Probe& probe : probes) {
    std::vector<double> p = kModule;
    p.insert(p.end(), probe.begin(), probe.end());
    const std::vector<double> back = Internal(*device, Reported(*device, p));
    for (std::size_t i = 0; i < p.size(); ++i) {
      EXPECT_NEAR(back[i], p[i], 1e-10 * (1 + std::fabs(p[i]))) << device->parameters[i].symbol;
    }
  }
}

TEST_P(DeviceEffectsTest, IsTheDeviceAloneWhereItsEffectIsNotThere) {
  const auto device = ExtendModule({{GetParam(), {}}});
  ASSERT_TRUE(device);
  std::vector<double> p = kModule;
  for (const EffectParameter& info : GetParam()->parameters) p.push_back(info.neutral);
  const IvCurve curve = UpAndDown();
  std::vector<double> current_A(curve.size());
  ASSERT_TRUE(ExtendedCurrents(*device, p.data(), current_A.data(), nullptr));
  for (std::size_t k = 0; k < curve.size(); ++k) {
    // Below 0 V bypass diodes conduct, and each cell in a string has a small leak.
    if (GetParam()->groups && curve.voltage_V[k] < 0) continue;
    const double slack = GetParam()->groups ? 1e-6 : 1e-10;
    EXPECT_NEAR(current_A[k], curve.current_A[k], slack) << curve.voltage_V[k] << " V";
  }
}

TEST_P(DeviceEffectsTest, DifferentiatesByTheDevicesOwnParameters) {
  const auto device = ExtendModule({{GetParam(), {}}});
  ASSERT_TRUE(device);
  std::vector<double> p = kModule;
  const Probe probe = GetParam()->probes(device->effects->readings.traits).front();
  p.insert(p.end(), probe.begin(), probe.end());
  const std::size_t points = UpAndDown().size(), size = p.size();
  std::vector<double> current_A(points), jacobian(points * size), up(points), down(points);
  ASSERT_TRUE(ExtendedCurrents(*device, p.data(), current_A.data(), jacobian.data()));
  for (std::size_t i = 0; i < kModule.size(); ++i) {
    const double step = 1e-5 * p[i];
    std::vector<double> moved = p;
    moved[i] = p[i] + step;
    ASSERT_TRUE(ExtendedCurrents(*device, moved.data(), up.data(), nullptr));
    moved[i] = p[i] - step;
    ASSERT_TRUE(ExtendedCurrents(*device, moved.data(), down.data(), nullptr));
    double largest = 0, apart = 0;
    for (std::size_t k = 0; k < points; ++k) {
      const double exact = jacobian[k * size + i] * p[i];
      const double difference = (up[k] - down[k]) / 2e-5;
      largest = std::max(largest, std::fabs(exact));
      apart = std::max(apart, std::fabs(exact - difference));
    }
    EXPECT_LE(apart, 1e-4 * largest + 1e-7) << device->parameters[i].symbol;
  }
}

std::vector<const Effect*> WithParameters() {
  std::vector<const Effect*> effects;
  for (const Effect* effect : Catalogue()) {
    // clip is absent not at a limit of zero current, but at a separate value.
    if (!effect->parameters.empty() && std::string(effect->id) != "clip") effects.push_back(effect);
  }
  return effects;
}

INSTANTIATE_TEST_SUITE_P(Effects, DeviceEffectsTest, ::testing::ValuesIn(WithParameters()),
                         [](const auto& test) { return std::string(test.param->id); });

TEST(Extend, NamesParametersAfterTheirEffect) {
  const auto device = ExtendModule({UseOf("shading"), UseOf("drift")});
  ASSERT_TRUE(device) << device.error().ToString();
  EXPECT_EQ(device->size(), 12);
  EXPECT_EQ(device->Find("shading.d"), 5);
  EXPECT_EQ(device->Find("shading_bypass_voltage"), 7);
  EXPECT_EQ(device->Find("shading.c"), 8);
  EXPECT_EQ(device->Find("drift.d"), 9);
}

TEST(Extend, HoldsAndLimitsInReportedUnits) {
  const auto device =
      ExtendModule({UseOf("nonohmic_shunt", {{"m", {2, 2}}, {"shunt_strength", {0, 1e-4}}})});
  ASSERT_TRUE(device) << device.error().ToString();
  const std::vector<ParameterBounds>& bounds = device->effects->bounds;
  EXPECT_EQ(bounds[1].lower, bounds[1].upper);
  std::vector<double> p = kModule;
  p.push_back(bounds[0].upper);
  p.push_back(2);
  EXPECT_NEAR(Reported(*device, p)[5], 1e-4, 1e-16);
  EXPECT_EQ(DescribeUse(device->effects->uses[0]), "nonohmic_shunt:m=2,shunt_strength=0:0.0001");
}

TEST(Extend, SaysWhatCannotBe) {
  EXPECT_THAT(ErrorOf({UseOf("shading", {{"q", {1, 1}}})}),
              HasSubstr("shading: has no parameter 'q', expected d, w, Vb"));
  EXPECT_THAT(ErrorOf({UseOf("shading", {{"d", {0.5, 2}}})}),
              HasSubstr("shading: d = 0.5:2 is outside 0 to 0.999"));
  EXPECT_THAT(ErrorOf({UseOf("shading", {{"d", {0.5, 0.1}}})}),
              HasSubstr("d = 0.5:0.1 is reversed"));
  EXPECT_THAT(ErrorOf({UseOf("drift"), UseOf("drift")}), HasSubstr("drift: is there twice"));
  EXPECT_THAT(ErrorOf({UseOf("shading"), UseOf("mismatch")}),
              HasSubstr("mismatch: cannot stand beside shading"));
  EXPECT_THAT(ErrorOf({UseOf("temp_offset")}, false),
              HasSubstr("temp_offset: needs curves at several temperatures (--force"));
  EXPECT_EQ(ErrorOf({UseOf("temp_offset")}, true), "no error");
  EXPECT_THAT(ErrorOf({UseOf("outliers")}), HasSubstr("outliers: has no parameters"));
  EXPECT_THAT(ErrorOf({UseOf("substrings", {{"w1", {0.6, 0.6}}, {"w2", {0.5, 0.5}}})}),
              HasSubstr("shares of 1.1 in all leave no cell for the rest"));
  EXPECT_THAT(ErrorOf({UseOf("substrings"), UseOf("transient"), UseOf("back_contact"),
                       UseOf("clip"), UseOf("drift")}),
              HasSubstr("28 parameters are too many for one law, expected 20 at most"));
}

TEST(Extend, KeepsToWholeNumbers) {
  IvCurve curve = UpAndDown();
  curve.notes.bypass_diodes = 3;
  const auto extend = [&](const EffectUse& use) {
    return Extend(MakeDevice(Model::kSingleDiode, curve.conditions), Model::kSingleDiode,
                  ConstantSet::kCodata, curve, {use}, /*force=*/true);
  };
  const auto error_of = [&](const EffectUse& use) {
    const auto device = extend(use);
    return device ? "no error" : device.error().ToString();
  };
  const auto share_of = [&](double low, double high) {
    const auto device = extend(UseOf("shading", {{"w", {low, high}}}));
    EXPECT_TRUE(device) << device.error().ToString();
    return device ? device->effects->bounds[1] : ParameterBounds{};
  };
  const ParameterBounds any = share_of(0.2, 0.9);  // the bounds move to whole substrings
  EXPECT_DOUBLE_EQ(any.lower, 1.0 / 3);
  EXPECT_DOUBLE_EQ(any.upper, 2.0 / 3);
  EXPECT_DOUBLE_EQ(any.whole, 1.0 / 3);
  const ParameterBounds typed = share_of(0.33333, 0.66666);  // rounded values of thirds
  EXPECT_DOUBLE_EQ(typed.lower, 1.0 / 3);
  EXPECT_DOUBLE_EQ(typed.upper, 2.0 / 3);
  const ParameterBounds one = share_of(0.3, 0.4);  // one value only, so nothing to try
  EXPECT_EQ(one.lower, one.upper);
  EXPECT_DOUBLE_EQ(one.lower, 1.0 / 3);
  const ParameterBounds fixed = share_of(0.4, 0.4);
  EXPECT_EQ(fixed.lower, 0.4);
  EXPECT_EQ(fixed.upper, 0.4);
  EXPECT_THAT(error_of(UseOf("shading", {{"w", {0.4, 0.5}}})),
              HasSubstr("shading: w = 0.4:0.5 holds no whole number of 3 substrings: expected a "
                        "range around 0.666667"));
  EXPECT_THAT(error_of(UseOf("weak_cell", {{"chains", {1.2, 1.8}}})),
              HasSubstr("weak_cell: chains = 1.2:1.8 holds no whole number of them: expected a "
                        "range around 2"));
  curve.notes.bypass_diodes.reset();  // number of substrings unknown
  EXPECT_EQ(error_of(UseOf("shading", {{"w", {0.4, 0.5}}})), "no error");
}

// With two parallel chains, a weak cell without any light lacks half of the substring's light. A
// larger deficit changes nothing.
TEST(Extend, AWeakCellIsDarkAtMost) {
  const auto currents = [](double deficit, double chains) {
    const auto device = ExtendModule({UseOf("weak_cell")});
    std::vector<double> p = kModule;
    p.insert(p.end(), {deficit, 1, 0, 0.5, 0.1, 15, 3.4, 0.7, chains});
    std::vector<double> current_A(device->effects->readings.points.size());
    EXPECT_TRUE(ExtendedCurrents(*device, p.data(), current_A.data(), nullptr));
    return current_A;
  };
  EXPECT_EQ(currents(0.5, 2), currents(0.9, 2));
  EXPECT_NE(currents(0.49, 2), currents(0.5, 2));
  EXPECT_NE(currents(0.5, 1), currents(0.9, 1));
}

}  // namespace
}  // namespace lyrefit
