#include "faults/field_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "faults/field_misfit.h"
#include "faults/for_each.h"

namespace faults::field {
namespace {

TEST(FieldCase, OfEveryKindCanBeMadeAndSaysWhatIsInIt) {
  for (const std::string& kind : Kinds()) {
    const Case made = MakeCase(kind, 4);
    const Measurement& taken = made.measurement;
    const bool clean = kind.rfind("clean", 0) == 0;
    EXPECT_EQ(made.truth.accepted.empty(), clean) << kind;
    EXPECT_GE(taken.voltage.size(), 40u) << kind;
    EXPECT_EQ(taken.voltage.size(), taken.current.size()) << kind;
    EXPECT_GE(taken.bypass_diodes, 2) << kind;
    EXPECT_GE(made.misfit, 0) << kind;
    if (clean) {
      EXPECT_EQ(made.misfit, made.healthy) << kind;
    }
    for (const double current : taken.current) EXPECT_TRUE(std::isfinite(current)) << kind;
  }
}

TEST(FieldCase, IsTheSameOnAnyThread) {
  const std::vector<std::string> kinds = {"clean_module", "weak_cell", "light_dip", "hysteresis"};
  std::vector<Case> threaded(kinds.size());
  ForEach(static_cast<int>(kinds.size()), static_cast<int>(kinds.size()),
          [&](int k) { threaded[k] = MakeCase(kinds[k], 12); });
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const Case made = MakeCase(kinds[k], 12);
    EXPECT_EQ(made.measurement.current, threaded[k].measurement.current);
    EXPECT_EQ(made.measurement.voltage, threaded[k].measurement.voltage);
    EXPECT_EQ(made.misfit, threaded[k].misfit);
    EXPECT_NE(made.measurement.current, MakeCase(kinds[k], 13).measurement.current);
  }
}

TEST(FieldCase, AboveAMisfitIsThere) {
  for (const char* kind : {"weak_cell", "scatter", "light_drift"}) {
    EXPECT_GE(MakeCaseAbove(kind, 0.25, 3).misfit, 0.25) << kind;
  }
}

// Real clean sweeps: half of them have a misfit of 0.05 to 0.2 % of Isc, hardly any 0.5 %.
TEST(FieldCase, CleanModulesAreMissedAsRealOnesAre) {
  std::vector<double> missed;
  for (int seed = 0; seed < 25; ++seed) {
    const Measurement taken = MakeCase("clean_module", seed).measurement;
    const double largest = *std::max_element(taken.current.begin(), taken.current.end());
    missed.push_back(100 * BestOneDiode(taken.voltage, taken.current).rms / largest);
  }
  std::sort(missed.begin(), missed.end());
  EXPECT_GT(missed[3], 0.05);
  EXPECT_GT(missed[12], 0.08);
  EXPECT_LT(missed[12], 0.2);
  EXPECT_LT(missed[23], 0.5);
}

Rig Bare(std::uint64_t seed) {
  Random random(seed);
  Rig rig;
  rig.module = DrawModule(Uniformity::kEveryCellItsOwn, &random).module;
  rig.tracer.current_noise = rig.tracer.voltage_noise = 0;
  return rig;
}

TEST(FieldTracer, ChargeDeliversLessUpThanDown) {
  Rig rig = Bare(2);
  rig.tracer.up_and_down = true;
  rig.charge.constant = 0.01;
  Lit lit(rig.module);
  const Readings readings = Exact(rig, &lit);
  const std::size_t count = readings.voltage.size();
  const double isc = ShortCircuit(lit.Whole());
  for (std::size_t i = 1; i + 1 < count / 2; ++i) {
    EXPECT_NEAR(readings.voltage[i], readings.voltage[count - 1 - i], 1e-9);
    EXPECT_NEAR(readings.current[count - 1 - i] - readings.current[i], 0.02 * isc, 1e-6 * isc);
  }
}

TEST(FieldTracer, StepOfTheLightScalesWhatComesAfterIt) {
  Rig rig = Bare(3);
  rig.sky.cloud = Cloud::kStep;
  rig.sky.at = 0.4;
  rig.sky.size = -0.1;
  Lit lit(rig.module);
  const Readings readings = Exact(rig, &lit);
  for (std::size_t i = 0; i < readings.voltage.size() / 2; ++i) {
    const double plain = lit.Current(readings.voltage[i], 1);
    const double expected = readings.time[i] > 0.4 ? 0.9 : 1;
    EXPECT_NEAR(readings.current[i] / plain, expected, 2e-3) << i;
  }
}

TEST(FieldTracer, ShowsWholeStepsOfItsRanges) {
  Rig rig = Bare(4);
  rig.tracer.current_step = 1e-3;
  rig.tracer.fine_below = 0.25;
  Random random(1);
  Lit lit(rig.module);
  const double isc = ShortCircuit(lit.Whole());
  int fine = 0;
  for (const double current : Measured(rig, &lit, &random).current) {
    const double steps = current / (1e-3 * isc);
    const bool small = std::fabs(current) < 0.249 * isc;
    const double whole = small ? 10 * steps : steps;
    EXPECT_NEAR(whole, std::round(whole), 1e-6);
    fine += small && std::fabs(steps - std::round(steps)) > 0.05;
  }
  EXPECT_GT(fine, 0);
}

TEST(FieldTracer, CapacitorCrowdsItsReadingsWhereTheCurrentIsSmall) {
  Rig rig = Bare(5);
  rig.tracer.drive = Drive::kCapacitor;
  rig.tracer.last_current = 0.02;
  Lit lit(rig.module);
  const Readings readings = Exact(rig, &lit);
  const std::vector<double>& v = readings.voltage;
  const double first = v[1] - v[0], last = v[v.size() - 1] - v[v.size() - 2];
  EXPECT_NEAR(last / first, 0.02, 0.01);
  EXPECT_NEAR(readings.current.back(), 0.02 * ShortCircuit(lit.Whole()), 1e-3);
}

TEST(FieldTracer, TakesReadingsToBinsAndStopsAtItsLimits) {
  Rig rig = Bare(6);
  rig.tracer.voltage_bin = 0.02;
  rig.tracer.voltage_end = 0.9;
  rig.tracer.least_current = 0.5;
  Random random(2);
  Lit lit(rig.module);
  const double isc = ShortCircuit(lit.Whole()), voc = OpenCircuit(lit.Whole());
  const Readings readings = Measured(rig, &lit, &random);
  int at_end = 0, at_least = 0;
  for (std::size_t i = 0; i < readings.voltage.size(); ++i) {
    const double bins = readings.voltage[i] / (0.02 * voc);
    EXPECT_NEAR(bins, std::round(bins), 1e-6);
    EXPECT_LE(readings.voltage[i], 0.9 * voc * (1 + 1e-9));
    EXPECT_GE(readings.current[i], 0.5 * isc * (1 - 1e-9));
    at_end += readings.voltage[i] > 0.8999 * voc;
    at_least += readings.current[i] < 0.5001 * isc;
  }
  EXPECT_GT(at_end, 3);
  EXPECT_GT(at_least, 3);
}

TEST(FieldTracer, JumpsWhereItsRangeChanges) {
  Rig rig = Bare(7);
  rig.tracer.fine_below = 0.6;
  rig.tracer.fine_gain = 1.02;
  Lit lit(rig.module);
  const double isc = ShortCircuit(lit.Whole());
  const Readings readings = Exact(rig, &lit);
  for (std::size_t i = 0; i < readings.voltage.size(); ++i) {
    const double plain = lit.Current(readings.voltage[i], 1);
    const double gain = std::fabs(plain) < 0.6 * isc ? 1.02 : 1;
    EXPECT_NEAR(readings.current[i], gain * plain, 1e-9 * isc) << i;
  }
}

}  // namespace
}  // namespace faults::field
