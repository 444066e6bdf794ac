#include "lyrefit/model/string.h"

namespace lyrefit {

StringLimits LimitsOf(const Cell<Pack>& cell) {
  StringLimits limits;
  limits.n_vt = 1.0 / cell.diode[0].inverse_n_vt;
  limits.voltage = 1e3;
  for (int d = 0; d < cell.diodes; ++d) {
    const Pack n_vt = 1.0 / cell.diode[d].inverse_n_vt;
    limits.n_vt = Smaller(limits.n_vt, n_vt);
    const Pack ratio = (abs(cell.photocurrent) + 1.0) / Larger(cell.diode[d].saturation, 1e-300);
    limits.voltage = Smaller(limits.voltage, n_vt * LogUpperBound(1.0 + ratio));
  }
  limits.bypass_vt = cell.bypass_ideality * cell.thermal_voltage;
  limits.reverse = cell.bypass;
  return limits;
}

void StartString(const Cell<Pack>& cell, const StringLimits& limits, const Pack& voltage,
                 const Pack& current, StringState* state) {
  state->groups = cell.groups;
  state->substrings = cell.substrings;
  state->strings = cell.strings;
  if (cell.groups == 1) {
    state->u[0] = state->far[0] = Smaller(voltage + current * cell.resistance, limits.voltage);
    state->substring_voltage[0] = voltage;
    state->current[0] = current;
    return;
  }
  // Start voltage of each cell group at this current: that of its first diode, or of its shunt in
  // reverse.
  for (int g = 0; g < cell.groups; ++g) {
    const CellGroup<Pack>& group = cell.group[g];
    const Substring& substring = cell.substring[group.substring];
    const Pack room = cell.photocurrent * group.light - current;
    const Pack forward =
        LogUpperBound(1.0 + Larger(room, 0.0) / Larger(cell.diode[0].saturation, 1e-300)) /
        cell.diode[0].inverse_n_vt;
    const Pack least = substring.bypassed ? -limits.reverse / substring.cells : Pack(-50.0);
    const Pack reverse = Larger(room / (cell.conductance + group.leak + 1e-3), least);
    state->u[g] = state->far[g] = Choose(0.0 < room, Smaller(forward, limits.voltage), reverse);
  }
  for (int p = 0; p < cell.substrings; ++p) {
    const bool bypassed = cell.substring[p].bypassed;
    Pack lowest = 1e3;
    for (int g = 0; g < cell.groups; ++g) {
      if (cell.group[g].substring == p) lowest = Smaller(lowest, state->u[g]);
    }
    state->substring_voltage[p] =
        bypassed ? Larger(lowest, -limits.reverse / cell.substring[p].cells) : lowest;
  }
  for (int s = 0; s < cell.strings; ++s) state->current[s] = current;
}

}  // namespace lyrefit
