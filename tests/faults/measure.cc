#include "faults/measure.h"

#include <algorithm>
#include <cmath>

#include "faults/cell.h"
#include "faults/series_string.h"

namespace faults {
namespace {

constexpr int kStepsBetween = 8;  // steps of the charge between two readings

struct Truth {
  const Device& device;
  const Effects& effects;
  const Plan& plan;

  double X(double time_s) const { return plan.kind <= Kind::kUpDown ? plan.X(time_s) : 0; }
  double Suns(const Setting& at, double time_s) const {
    if (at.suns == 0) return 0;  // no effect adds light to a dark curve
    const double shown = at.suns;
    const double x = X(time_s);
    double suns = shown * (1 + effects.sensor_bend * (shown - 1) + effects.sensor_gain);
    suns += effects.sensor_offset;
    suns *= 1 + effects.drift * x + (x > effects.step_at ? effects.step : 0);
    const double from_dip = (x - effects.dip_at) / effects.dip_width;
    return suns * (1 - effects.dip * std::exp(-from_dip * from_dip / 2));
  }
  Cell CellAt(const Setting& at, double time_s) const {
    const double kelvin = at.kelvin + effects.temperature_offset_K +
                          effects.temperature_gradient_K * at.suns +
                          effects.temperature_drift_K * X(time_s);
    return CellUnder(device, effects, Suns(at, time_s), kelvin);
  }
};

// Terminal voltage at any time, linear between the readings and extrapolated beyond both ends.
double VoltageAt(const Plan& plan, double time_s) {
  const std::vector<Setting>& all = plan.settings;
  const double interval = all[1].time_s - all[0].time_s;
  const double place = (time_s - all[0].time_s) / interval;
  const int last = static_cast<int>(all.size()) - 2;
  const int left = std::clamp(static_cast<int>(std::floor(place + 1e-9)), 0, last);
  return all[left].voltage + (place - left) * (all[left + 1].voltage - all[left].voltage);
}

std::vector<Substring> Arranged(const Device& device, const Effects& effects, const Cell& cell) {
  Cell weak = cell;
  if (effects.mismatch_deficit != 0) {
    weak.photocurrent *= 1 - effects.mismatch_deficit;
    const int count = static_cast<int>(std::lround(effects.mismatch_share * device.cells));
    return {{{{cell, device.cells - count}, {weak, count}}, 1, false, false, 0, cell.photocurrent}};
  }
  weak.photocurrent *= 1 - effects.shade_depth;
  const int each = device.cells / device.substrings;
  Substring shaded{{{weak, each}},       effects.shaded_substrings, true,
                   effects.bypass_ideal, effects.bypass_drop,       cell.photocurrent};
  Substring lit{{{cell, each}},   device.substrings - effects.shaded_substrings, false, false, 0,
                cell.photocurrent};
  return {lit, shaded};
}

// Integrates the junction charge in time. The sweep begins three intervals before the first
// reading.
std::vector<double> ChargedCurrents(const Truth& truth) {
  const std::vector<Setting>& all = truth.plan.settings;
  const double interval = (all[1].time_s - all[0].time_s) / kStepsBetween;
  const int cells = truth.device.cells;
  double time_s = all[0].time_s - 3 * interval * kStepsBetween;
  Cell cell = truth.CellAt(all[0], all[0].time_s);
  double charge =
      JunctionCharge(cell, JunctionAtVoltage(cell, VoltageAt(truth.plan, time_s) / cells));
  std::vector<double> currents;
  for (const Setting& at : all) {
    double v = 0;
    const int steps = static_cast<int>(std::lround((at.time_s - time_s) / interval));
    for (int i = 1; i <= steps; ++i) {
      const double now = at.time_s - (steps - i) * interval;
      cell = truth.CellAt(at, std::max(now, all[0].time_s));
      cell.interval_s = interval;
      cell.charge = charge;
      v = JunctionAtVoltage(cell, VoltageAt(truth.plan, now) / cells);
      charge = JunctionCharge(cell, v);
    }
    time_s = at.time_s;
    currents.push_back(AtJunction(cell, v).current);
  }
  return currents;
}

double CurrentAt(const Truth& truth, const Setting& at) {
  const Effects& effects = truth.effects;
  const Device& device = truth.device;
  const Cell cell = truth.CellAt(at, at.time_s);
  double voltage =
      effects.skew_s == 0 ? at.voltage : VoltageAt(truth.plan, at.time_s + effects.skew_s);
  voltage += effects.voltage_offset * device.cells;
  if (effects.shade_depth == 0 && effects.mismatch_deficit == 0) {
    return CellCurrent(cell, voltage / device.cells);
  }
  return StringCurrent(Arranged(device, effects, cell), voltage);
}

}  // namespace

std::vector<double> ExactCurrents(const Device& device, const Effects& effects, const Plan& plan) {
  const Truth truth{device, effects, plan};
  std::vector<double> currents;
  if (effects.capacitance != 0 || effects.diffusion_s != 0) {
    currents = ChargedCurrents(truth);
  } else {
    for (const Setting& at : plan.settings) currents.push_back(CurrentAt(truth, at));
  }
  for (double& current : currents) {
    current = current * (1 + effects.current_gain) + effects.current_offset_A;
    if (effects.clip_A > 0) current = std::min(current, effects.clip_A);
  }
  return currents;
}

}  // namespace faults
