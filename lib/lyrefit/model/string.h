#pragma once

#include "lyrefit/model/cell.h"

// Solves unlike cells in series, and such strings in parallel: finds the current at a given
// voltage. A string of identical cells has one cell group.
//
// Each cell group g has a junction voltage u that determines its current F(u). All cell groups of a
// substring p carry the same current J. The bypass diode in parallel carries B:
//
//   F_g(u_g) = J_p,   U_p = mean of u_g - D(I),   J_p + B(-U_p) = I,   sum of w_p U_p = W V
//
// If a substring is two chains in parallel (half-cut), each with its own drop:
//
//   F_g(u_g) = J_p,   F_b(u_b) = K_p,   U_p = mean of u_g - D(J_p) = u_b - D(K_p),
//   (J_p + K_p) / 2 + B(-U_p) = I
//
// w and W are the shares of the substring and of the string in all cells. Newton's method solves
// all equations at once. The system is a tree, so a step costs one evaluation of each cell group
// and a few sums. Exponentials are limited as in circuit simulators (Nagel 1975, SPICE2): beyond
// the voltage at which the junction carries all the current, a step is replaced by its logarithm.
namespace lyrefit {

// State of the iteration for eight readings: junction voltages of the cell groups, voltages of the
// substrings, currents of the strings. In cells of two parts `u` is the near part's and `far` the
// far part's voltage. Voltages and currents of a string are scaled as if all cells were in that string.
struct StringState {
  Pack u[kMostGroups];
  Pack far[kMostGroups];
  Pack substring_voltage[kMostGroups];
  Pack current[kMostGroups];
  int groups = 0;  // numbers of valid entries
  int substrings = 0;
  int strings = 0;

  bool Fits(const Cell<Pack>& cell) const {
    return groups == cell.groups && substrings == cell.substrings && strings == cell.strings;
  }
};

// Voltages at which exponentials dominate: steps beyond them are logarithmic.
struct StringLimits {
  Pack voltage;  // of an unknown
  Pack n_vt;
  Pack reverse;  // of a bypass diode, at its own voltage
  Pack bypass_vt;
};
StringLimits LimitsOf(const Cell<Pack>& cell);

// Current of a cell group at its junction voltage. With two parts, I = (1 - a) F(u) + a F(f) and
// f = u + R F(f). The far part is linearised, so that the current depends on u alone.
struct GroupPoint {
  Dual<1, Pack> current;  // with its slope by u
  Dual<1, Pack> far;      // two parts: F(f), with its slope
  Pack follows;           // two parts: df/du
  Pack behind;            // two parts: residual of the equation for f
};

// Derivatives of the delivered current by each term of the equations, at the root.
struct StringSlopes {
  Pack by_current[kMostGroups];  // F of each cell group
  Pack by_share[kMostGroups];
  Pack by_bypass[kMostGroups];      // B of each substring
  Pack by_drop[kMostGroups];        // D of each string
  Pack by_chain_drop[kMostGroups];  // D of the group's chain (parallel), else 0
  Pack by_terminal[kMostGroups];    // V, in each string
};

struct StringRoot {
  Pack current;  // delivered by all strings
  GroupPoint group[kMostGroups];
  StringSlopes slopes;
};

// Start state from a guess `current`.
void StartString(const Cell<Pack>& cell, const StringLimits& limits, const Pack& voltage,
                 const Pack& current, StringState* state);

// Solves the string at `voltage` per cell from `state`, which is moved to the root. The current is
// NaN in lanes where the iteration was given up.
StringRoot SolveString(const EvaluationContext<Pack>& context, const Cell<Pack>& cell,
                       const StringLimits& limits, const Pack& voltage, StringState* state,
                       GiveUp give_up = GiveUp::kNever);

}  // namespace lyrefit
