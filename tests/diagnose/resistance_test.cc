#include "lyrefit/diagnose/device_findings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "diagnose/synthetic_diagnosis.h"
#include "lyrefit/base/roots.h"
#include "repeats.h"

// FlashTest tests of modules with the Suns-Voc trace of the same flash, solved cell by cell.
namespace lyrefit {
namespace {

using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr int kSubstrings = 3, kEach = 20;
constexpr double kThermal_V = 0.025692579, kIsc_A = 8, kVoc_V = 0.625, kIdeality = 1.1;

// Resistances in parts of Voc/Isc of a cell, as if the whole cell were behind them; light of the cells
// of one substring.
struct FlashedModule {
  double near = 0.05, far = 0.05, share = 0.4, light = 1, shunt = 100;

  double Junction(double junction_V, double light_here) const {
    const double saturation = kIsc_A / std::expm1(kVoc_V / (kIdeality * kThermal_V));
    return light_here * kIsc_A - saturation * std::expm1(junction_V / (kIdeality * kThermal_V)) -
           junction_V * kIsc_A / kVoc_V / shunt;
  }
  double Behind(double resistance, double voltage_V, double light_here) const {
    const double ohm = resistance * kVoc_V / kIsc_A;
    const double junction_V =
        RootBetween([&](double u) { return u - ohm * Junction(u, light_here) - voltage_V; },
                    voltage_V - 2, voltage_V + 3);
    return Junction(junction_V, light_here);
  }
  // Of a cell.
  double Voltage(double current_A, double light_here) const {
    const auto missing = [&](double v) {
      return (1 - share) * Behind(near, v, light_here) + share * Behind(far, v, light_here) -
             current_A;
    };
    return RootBetween(missing, -300, 1);
  }
  double ModuleVoltage(double current_A) const {
    double sum = 0;
    for (int k = 0; k < kSubstrings; ++k) {
      sum += std::max(kEach * Voltage(current_A, k == 0 ? light : 1), -0.5);
    }
    return sum;
  }
};

struct FlashTest {
  CurveSet with_trace;
  double pseudo_ff = 0, ff = 0, product_W = 0;

  double lost() const { return pseudo_ff - ff; }
  const IvCurve& load() const { return with_trace.curves.front(); }
};

IvCurve FlashCurve(const std::string& name) {
  IvCurve curve;
  curve.name = name;
  curve.conditions.cells_in_series = kSubstrings * kEach;
  curve.notes.bypass_diodes = kSubstrings;
  curve.notes.technology = "mono-Si";
  return curve;
}

FlashTest FlashOf(const FlashedModule& module) {
  constexpr int kPoints = 60;
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 5e-4 * kIsc_A);
  FlashTest flash;
  IvCurve load = FlashCurve("load"), trace = FlashCurve("suns");
  const double voc = kSubstrings * kEach * kVoc_V;
  const double most = 1.0001 * kIsc_A;
  const double bright = module.light < 1 ? module.ModuleVoltage(0.999 * kIsc_A) : 0;
  for (int k = 0; k < kPoints; ++k) {
    const double v = std::max(0.999 * voc * k / (kPoints - 1), bright);
    const double i = RootBetween([&](double x) { return module.ModuleVoltage(x) - v; }, -1, most);
    load.voltage_V.push_back(v);
    load.current_A.push_back(i + noise(random));
    // Every cell at open circuit in its part of the light.
    const double suns = 1 - static_cast<double>(k) / kPoints;
    const auto open = [&](double light) {
      return RootBetween([&](double u) { return module.Junction(u, suns * light); }, -1, 1);
    };
    trace.voltage_V.push_back(kEach * (open(module.light) + (kSubstrings - 1) * open(1)));
    trace.current_A.push_back(kIsc_A * (1 - suns) + noise(random));
  }
  std::reverse(trace.voltage_V.begin(), trace.voltage_V.end());
  std::reverse(trace.current_A.begin(), trace.current_A.end());
  trace.suns_voc_A = kIsc_A;
  const KeyPoints loaded = FindKeyPoints(load.voltage_V, load.current_A);
  const KeyPoints pseudo = FindKeyPoints(trace.voltage_V, trace.current_A);
  const double isc = load.current_A.front();
  flash.product_W = isc * module.ModuleVoltage(0);
  flash.ff = loaded.max_power_W / flash.product_W;
  flash.pseudo_ff = pseudo.max_power_W / (kIsc_A * module.ModuleVoltage(0));
  flash.with_trace.name = "flash";
  flash.with_trace.curves = {load, trace};
  return flash;
}

bool NamesResistance(const Diagnosis& d) {
  return std::any_of(d.verdict.causes.begin(), d.verdict.causes.end(), IsResistance);
}

void ExpectsThe(const FlashTest& flash, const Diagnosis& d) {
  ASSERT_TRUE(d.verdict.resistance_loss.has_value());
  const ResistanceLoss& loss = *d.verdict.resistance_loss;
  EXPECT_LT(loss.part.low_95, flash.lost());
  EXPECT_GT(loss.part.high_95, flash.lost());
  const double beyond_W = (flash.lost() - kUsualResistanceLoss) * flash.product_W;
  EXPECT_LT(loss.beyond_W.low_95, beyond_W);
  EXPECT_GT(loss.beyond_W.high_95, beyond_W);
}

TEST(ResistanceLoss, OfANewModuleIsNoCause) {
  SKIP_IF_SANITIZED();
  const FlashTest flash = FlashOf({});
  const Diagnosis d = DiagnoseOrFail(flash.with_trace);
  ExpectsThe(flash, d);
  EXPECT_FALSE(NamesResistance(d)) << d.verdict.sentence;
  EXPECT_LT(d.verdict.resistance_loss->rise, 0.01);
}

// Parts of a cell differ in new modules too. Their resistance shows, and is no loss to gain.
TEST(ResistanceLoss, WithinThatOfNewModulesGainsNothing) {
  SKIP_IF_SANITIZED();
  FlashedModule module;
  module.near = 0.03;
  module.far = 0.12;
  const FlashTest flash = FlashOf(module);
  EXPECT_LT(flash.lost(), kMostResistanceLoss);
  const Diagnosis d = DiagnoseOrFail(flash.with_trace);
  EXPECT_FALSE(NamesResistance(d)) << d.verdict.sentence;
  ASSERT_FALSE(d.verdict.below_floor.empty()) << d.verdict.sentence;
  EXPECT_TRUE(IsResistance(d.verdict.below_floor.front()));
  EXPECT_TRUE(std::isnan(d.verdict.recoverable_power_W.value));
}

TEST(ResistanceLoss, OfAConnectorIsNamedWithItsWatts) {
  SKIP_IF_SANITIZED();
  FlashedModule module;
  module.near = module.far = 0.16;
  const FlashTest flash = FlashOf(module);
  const Diagnosis d = DiagnoseOrFail(flash.with_trace);
  ExpectsThe(flash, d);
  ASSERT_TRUE(d.verdict.found);
  const Cause& cause = d.verdict.causes.front();
  EXPECT_TRUE(IsResistance(cause)) << d.verdict.sentence;
  EXPECT_EQ(cause.recoverable_power_W.value, d.verdict.resistance_loss->beyond_W.value);
  EXPECT_THAT(cause.sentence, HasSubstr("by the Suns-Voc trace, resistance takes 0.1"));
}

TEST(ResistanceLoss, OfAgedContactsIsThatOfAllResistance) {
  SKIP_IF_SANITIZED();
  FlashedModule module;
  module.far = 0.6;
  const FlashTest flash = FlashOf(module);
  const Diagnosis d = DiagnoseOrFail(flash.with_trace);
  ExpectsThe(flash, d);
  ASSERT_TRUE(d.verdict.found);
  EXPECT_EQ(d.verdict.causes.front().id, "distributed_rs") << d.verdict.sentence;
  EXPECT_EQ(d.verdict.causes.front().effect, "aged_contacts");
}

// A step of the current is none of a resistance, as large as the difference of the fill factors is.
TEST(ResistanceLoss, OfUnlikeCurrentsIsReadAtSmallOnes) {
  SKIP_IF_SANITIZED();
  FlashedModule module;
  module.light = 0.8;
  const FlashTest flash = FlashOf(module);
  EXPECT_GT(flash.lost(), kMostResistanceLoss + kNotedResistanceLoss);
  const Diagnosis d = DiagnoseOrFail(flash.with_trace);
  ASSERT_TRUE(d.verdict.resistance_loss.has_value());
  const ResistanceLoss& loss = *d.verdict.resistance_loss;
  EXPECT_GT(loss.rise, 0.02);
  EXPECT_NEAR(loss.part.value, 0.05, 0.02);
  EXPECT_FALSE(IsNoted(loss));
  EXPECT_FALSE(NamesResistance(d)) << d.verdict.sentence;
  EXPECT_THAT(Ids(d), Not(IsEmpty()));
}

TEST(ResistanceLoss, IsNamedBesideUnlikeCurrents) {
  SKIP_IF_SANITIZED();
  FlashedModule module;
  module.light = 0.8;
  module.near = module.far = 0.15;
  const Diagnosis d = DiagnoseOrFail(FlashOf(module).with_trace);
  EXPECT_TRUE(NamesResistance(d)) << d.verdict.sentence;
  EXPECT_GE(d.verdict.causes.size(), 2U) << d.verdict.sentence;
}

// One sweep shows how much is lost, and not to what.
TEST(FillFactor, OfOneSweepIsASetWithItsLoss) {
  SKIP_IF_SANITIZED();
  FlashedModule module;
  module.far = 0.9;
  module.share = 0.45;
  const FlashTest flash = FlashOf(module);
  const Diagnosis d = DiagnoseOrFail(flash.load());
  EXPECT_FALSE(d.verdict.resistance_loss.has_value());
  ASSERT_TRUE(d.verdict.fill_factor.has_value());
  const FillFactor& fill = *d.verdict.fill_factor;
  EXPECT_TRUE(IsLow(fill));
  EXPECT_NEAR(fill.value.value, flash.ff, 0.01);
  const double lost_W = (flash.lost() - kUsualResistanceLoss) * flash.product_W;
  EXPECT_LT(fill.lost_W.low_95, lost_W);
  EXPECT_GT(fill.lost_W.high_95, lost_W);
  ASSERT_TRUE(d.verdict.found) << d.verdict.sentence;
  const Cause& cause = d.verdict.causes.front();
  std::vector<std::string> members = cause.equivalents;
  members.push_back(cause.id);
  EXPECT_THAT(members, Contains(std::string("distributed_rs"))) << d.verdict.sentence;
  EXPECT_EQ(cause.recoverable_power_W.value, fill.lost_W.value);
}

// Light scales what resistance takes, and cells the voltage of each.
TEST(FillFactor, IsUnknownWhereLightOrCellsAreNotStated) {
  SKIP_IF_SANITIZED();
  FlashedModule module;
  module.far = 0.9;
  IvCurve curve = FlashOf(module).load();
  curve.irradiance_known = false;
  EXPECT_FALSE(DiagnoseOrFail(curve).verdict.fill_factor.has_value());
  curve.irradiance_known = true;
  curve.cells_known = false;
  EXPECT_FALSE(DiagnoseOrFail(curve).verdict.fill_factor.has_value());
}

TEST(FillFactor, OfAHealthyModuleIsNotLowUnderAnyLight) {
  SKIP_IF_SANITIZED();
  const FlashTest flash = FlashOf({});
  const Diagnosis d = DiagnoseOrFail(flash.load());
  ASSERT_TRUE(d.verdict.fill_factor.has_value());
  EXPECT_FALSE(IsLow(*d.verdict.fill_factor)) << d.verdict.fill_factor->value.value;
  EXPECT_FALSE(d.verdict.found);
}

// A leak beside: the trace has it as well, so that it is no resistance.
TEST(ResistanceLoss, OfALeakIsNone) {
  SKIP_IF_SANITIZED();
  FlashedModule module;
  module.shunt = 4;
  const FlashTest flash = FlashOf(module);
  EXPECT_LT(flash.pseudo_ff, 0.74);
  const Diagnosis d = DiagnoseOrFail(flash.with_trace);
  ExpectsThe(flash, d);
  EXPECT_FALSE(NamesResistance(d)) << d.verdict.sentence;
}

}  // namespace
}  // namespace lyrefit
