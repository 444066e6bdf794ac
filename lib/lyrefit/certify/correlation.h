#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/certify/mixture.h"

namespace lyrefit {

// The largest correlation a(u) . y of a diode column over windows of u.
struct Correlation1D {
  double bound = 0;   // proved: nothing in the windows is larger; never below 0
  double best = 0;    // the largest value met
  double best_u = 0;  // where
};

// Bisects the windows until every piece is proved to stay below `allowed` by bounds on the second
// derivative, or is known to exceed it. `marks` are places where the correlation touches zero from
// below, and which pieces should therefore end at. Rounding aside the bound is a proof.
Correlation1D BoundCorrelation(const Eigen::VectorXd& vd, double scale_voltage_V,
                               const Eigen::VectorXd& y, const std::vector<Window>& windows,
                               const std::vector<Atom>& marks, double allowed);

// The same for a pair of solutions at Rs and Rs + dr: bounds from above the negative second
// derivative, along t in [0, 1], of a(u; Rs + t dr) . (y0 + t (y1 - y0)) for every u of the windows
// and for the shunt's column. Between the ends the correlation exceeds the larger of its ends, or
// zero, by at most t (1 - t) / 2 times that; pieces that lie too far below zero to rise above it
// are left out. Here a diode's column is scaled to its current at `scale_voltage_V`, and the
// shunt's as well.
double BoundBend(const MixtureData& data, const std::vector<Window>& windows, double rs, double dr,
                 const Eigen::VectorXd& y0, const Eigen::VectorXd& y1, double scale_voltage_V);

}  // namespace lyrefit
