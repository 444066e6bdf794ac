#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/law/device.h"

namespace lyrefit {

// The measured-current problem at a given Rs for any mixture of diodes with n in given ranges: find
// Iph >= 0, G >= 0 and a non-negative measure over n that minimise
//
//   1/2 sum over points of (Iph - G Vd - sum of diode currents(Vd) - I)^2,     Vd = V + I Rs.
//
// It is convex (non-negative least squares over a continuum of columns), its solution has few
// atoms, and a vector y with a . y <= 0 for every admissible column a proves the lower bound b . y
// - |y|^2 / 2 (weak duality). Diodes are written with u = 1 / (n Ns Vt) and the current they take
// at a voltage Vs, the largest junction voltage there is at this Rs, so that columns are of order
// 1:
//   a(u) = -(exp(u Vd) - 1) / (exp(u Vs) - 1).
struct MixtureData {
  Eigen::VectorXd voltage_V;
  Eigen::VectorXd current_A;
  double reference_voltage_V = 0;  // largest voltage at which the device delivers current
};

// A range of u, in 1/V.
struct Window {
  double lower = 0;
  double upper = 0;
};

struct Atom {
  double u = 0;
  double current_A = 0;  // Is (exp(u Vref) - 1)
};

struct Mixture {
  double rs = 0;
  double scale_voltage_V = 0;  // Vs
  double photocurrent_A = 0;
  double shunt_current_A = 0;  // G Vref
  std::vector<Atom> atoms;     // by rising u
  double primal = 0;           // half the sum of squares of this mixture, an upper bound
  double slope = 0;            // d primal / d Rs
  Eigen::VectorXd y;           // the dual vector: measured - modelled, cleaned of rounding
  double dual = 0;             // b . y - |y|^2 / 2
  double excess = 0;  // proved: no shunt or diode column, scaled at Vs, exceeds a . y = excess
  double photocurrent_excess = 0;  // the same for the column of ones
  double relative_gap = 0;         // |primal - dual| plus both excesses priced, over primal
};

// Solves the problem at `rs` with u in the windows (disjoint, sorted), from the atoms of a
// neighbouring solution if there is one. `tolerance` is the relative duality gap aimed at; what was
// reached is in the result. `price_A` prices what is left of the excess: no competitive mixture has
// a larger sum of shunt and diode currents at Vs.
Mixture SolveMixture(const MixtureData& data, const std::vector<Window>& windows, double rs,
                     const std::vector<Atom>& start, double tolerance, double price_A);

// a(u) at junction voltages vd, for any Vs > 0.
Eigen::VectorXd DiodeColumn(const Eigen::VectorXd& vd, double scale_voltage_V, double u);

}  // namespace lyrefit
