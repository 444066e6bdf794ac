#include "lyrefit/model/string.h"
#include "lyrefit/model/string_cell_group.h"

namespace lyrefit {

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
