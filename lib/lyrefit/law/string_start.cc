#include "lyrefit/law/string.h"
#include "lyrefit/law/string_kind.h"

namespace lyrefit {

void StartString(const Cell<Pack>& cell, const StringLimits& limits, const Pack& voltage,
                 const Pack& current, StringState* state) {
  state->kinds = cell.kinds;
  state->parts = cell.parts;
  state->strings = cell.strings;
  if (cell.kinds == 1) {
    state->u[0] = state->far[0] = Smaller(voltage + current * cell.resistance, limits.voltage);
    state->part_voltage[0] = voltage;
    state->current[0] = current;
    return;
  }
  // Start voltage of each cell group at this current: that of its first diode, or of its shunt in
  // reverse.
  for (int g = 0; g < cell.kinds; ++g) {
    const Kind<Pack>& kind = cell.kind[g];
    const Part& part = cell.part[kind.part];
    const Pack room = cell.photocurrent * kind.light - current;
    const Pack forward =
        LogUpperBound(1.0 + Larger(room, 0.0) / Larger(cell.diode[0].saturation, 1e-300)) /
        cell.diode[0].inverse_n_vt;
    const Pack least = part.bypassed ? -limits.reverse / part.cells : Pack(-50.0);
    const Pack reverse = Larger(room / (cell.conductance + kind.leak + 1e-3), least);
    state->u[g] = state->far[g] = Choose(0.0 < room, Smaller(forward, limits.voltage), reverse);
  }
  for (int p = 0; p < cell.parts; ++p) {
    const bool bypassed = cell.part[p].bypassed;
    Pack lowest = 1e3;
    for (int g = 0; g < cell.kinds; ++g) {
      if (cell.kind[g].part == p) lowest = Smaller(lowest, state->u[g]);
    }
    state->part_voltage[p] =
        bypassed ? Larger(lowest, -limits.reverse / cell.part[p].cells) : lowest;
  }
  for (int s = 0; s < cell.strings; ++s) state->current[s] = current;
}

}  // namespace lyrefit
