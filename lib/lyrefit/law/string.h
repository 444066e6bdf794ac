#pragma once

#include "lyrefit/law/cell.h"

// Unlike cells in series, and strings of them in parallel: given the voltage, the current that all
// share. Cells that are all alike are a string of one kind.
//
// Every kind g has a junction voltage u, from which its current F(u) follows; kinds of one part
// carry the same current J, beside it the part's bypass diode carries B:
//
//   F_g(u_g) = J_p,   U_p = mean of u_g - D(I),   J_p + B(-U_p) = I,   sum of w_p U_p = W V
//
// and where two chains stand side by side, each with its own drop,
//
//   F_g(u_g) = J_p,   F_b(u_b) = K_p,   U_p = mean of u_g - D(J_p) = u_b - D(K_p),
//   (J_p + K_p) / 2 + B(-U_p) = I
//
// (w, W: shares of the part and of the string in all cells). Newton on all of it at once: the
// system is a tree, so a step costs one evaluation of each kind and a few sums. Exponentials are
// kept from overshooting as circuit simulators do (Nagel 1975, SPICE2): beyond the voltage where
// the junction carries all there is, a step goes only as far as its logarithm.
namespace lyrefit {

// Where an iteration stands, of eight readings: junction voltages of the kinds (of halved cells the
// near half's and the far one's), voltages of the parts, currents of the strings, each as if all
// cells stood in that string.
struct StringState {
  Pack u[kMostKinds];
  Pack far[kMostKinds];
  Pack part_voltage[kMostKinds];
  Pack current[kMostKinds];
  int kinds = 0;  // how many of each there are: what lies beyond has no value
  int parts = 0;
  int strings = 0;

  bool Fits(const Cell<Pack>& cell) const {
    return kinds == cell.kinds && parts == cell.parts && strings == cell.strings;
  }
};

// Where exponentials begin to rule: steps beyond go by their logarithm.
struct StringLimits {
  Pack voltage;  // of an unknown
  Pack n_vt;
  Pack reverse;  // of a bypass diode, its own voltage
  Pack bypass_vt;
};
StringLimits LimitsOf(const Cell<Pack>& cell);

// A kind at its junction voltage. In two halves, I = (F(u) + F(f)) / 2 and f = u + R F(f) / 2: the
// far half is linearised, so that the current is one of u alone.
struct KindPoint {
  Dual<1, Pack> current;  // with its slope by u
  Dual<1, Pack> far;      // halved: F(f), with its slope
  Pack follows;           // halved: df/du
  Pack behind;            // halved: what f lacks
};

// How the delivered current changes with what the equations are made of, at their root.
struct StringSlopes {
  Pack by_current[kMostKinds];  // F of each kind
  Pack by_share[kMostKinds];
  Pack by_bypass[kMostKinds];      // B of each part
  Pack by_drop[kMostKinds];        // D of each string
  Pack by_chain_drop[kMostKinds];  // D of the chain that a kind of a paired part stands for, or 0
  Pack by_terminal[kMostKinds];    // V, as each string sees it
};

struct StringRoot {
  Pack current;  // delivered by all strings
  KindPoint kind[kMostKinds];
  StringSlopes slopes;
};

// A state to begin from, where `current` is a guess.
void StartString(const Cell<Pack>& cell, const StringLimits& limits, const Pack& voltage,
                 const Pack& current, StringState* state);

// The root at `voltage` per cell, from the state that is given, which moves there; NaN where it was
// given up.
StringRoot SolveString(const EvaluationContext<Pack>& context, const Cell<Pack>& cell, const StringLimits& limits,
                       const Pack& voltage, StringState* state, GiveUp give_up = GiveUp::kNever);

}  // namespace lyrefit
