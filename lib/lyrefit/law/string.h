#pragma once

#include "lyrefit/law/cell.h"

// Unlike cells in series, and strings of them in parallel: given the voltage, the current that all
// share. Cells that are all alike are a string of one kind.
//
// Every kind g has one unknown u, from which its voltage v(u) and its current F(u) follow; kinds of
// one part carry the same current J, beside it the part's bypass diode carries B:
//
//   F_g(u_g) = J_p,   U_p = mean of v_g - D(I),   J_p + B(-U_p) = I,   sum of w_p U_p = W V
//
// (w, W: shares of the part and of the string in all cells). Newton on all of it at once: the
// system is a tree, so a step costs one evaluation of each kind and a few sums. Exponentials are
// kept from overshooting as circuit simulators do (Nagel 1975, SPICE2): beyond the voltage where
// the junction carries all there is, a step goes only as far as its logarithm.
namespace lyrefit {

// Where an iteration stands, of eight readings: unknowns of the kinds, voltages of the parts,
// currents of the strings, each as if all cells stood in that string.
struct StringState {
  Pack u[kMostKinds];
  Pack part_voltage[kMostKinds];
  Pack current[kMostKinds];
};

// Where exponentials begin to rule: steps beyond go by their logarithm.
struct StringLimits {
  Pack voltage;  // of an unknown
  Pack n_vt;
  Pack reverse;  // of a bypass diode, its own voltage
  Pack bypass_vt;
};
StringLimits LimitsOf(const Cell<Pack>& cell);

// A kind at its unknown, with slopes along it. In two halves, I = (F(V) + F(u)) / 2 and
// u = V + R F(u) / 2: the far half's voltage is the unknown, and the near one's follows.
struct KindPoint {
  Dual<1, Pack> voltage;  // of the near half
  Dual<1, Pack> current;
  Dual<1, Pack> far;   // halved: F(u)
  Dual<1, Pack> near;  // halved: F(V), slope along V
};

// How the delivered current changes with what the equations are made of, at their root.
struct StringSlopes {
  Pack by_current[kMostKinds];  // F of each kind
  Pack by_voltage[kMostKinds];  // v of each kind
  Pack by_share[kMostKinds];
  Pack by_bypass[kMostKinds];    // B of each part
  Pack by_drop[kMostKinds];      // D of each string
  Pack by_terminal[kMostKinds];  // V, as each string sees it
};

struct StringRoot {
  Pack current;  // delivered by all strings
  KindPoint kind[kMostKinds];
  StringSlopes slopes;
};

// The root at `voltage` per cell, from the state that is given, which moves there.
StringRoot SolveString(const Bench<Pack>& bench, const Cell<Pack>& cell, const StringLimits& limits,
                       const Pack& voltage, StringState* state);

}  // namespace lyrefit
