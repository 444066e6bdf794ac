#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/certify/interval.h"
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
// below, and which pieces should therefore end at. Where there are `pulls`, one for each window, a
// diode's Is at that price is taken off what it gains. The bound is a proof: in doubles but for
// rounding, in intervals without exception.
template <class Real>
Correlation1D BoundCorrelation(const ArrayOf<Real>& vd, double scale_voltage_V,
                               const ArrayOf<Real>& y, const std::vector<Window>& windows,
                               const std::vector<Atom>& marks, double allowed,
                               const std::vector<double>& pulls = {});
inline Correlation1D BoundCorrelation(const Eigen::VectorXd& vd, double scale_voltage_V,
                                      const Eigen::VectorXd& y, const std::vector<Window>& windows,
                                      const std::vector<Atom>& marks, double allowed,
                                      const std::vector<double>& pulls = {}) {
  return BoundCorrelation<double>(vd.array(), scale_voltage_V, y.array(), windows, marks, allowed,
                                  pulls);
}

// The same for a pair of solutions at two Rs: bounds from above the negative second derivative,
// along t in [0, 1], of the weighted a(u; rs0 + t (rs1 - rs0)) . (y0 + t (y1 - y0)) for every u of
// the windows. Between the ends the correlation exceeds what is interpolated between them, or zero,
// by at most t (1 - t) / 2 times that; pieces that lie too far below zero to rise above it are left
// out. Here a diode's column is scaled to its current at `scale_voltage_V`. `pulls0` and `pulls1`
// price Is at both ends.
template <class Real = double>
double BoundBend(const MixtureData& data, const std::vector<Window>& windows, double rs0,
                 double rs1, const Eigen::VectorXd& y0, const Eigen::VectorXd& y1,
                 double scale_voltage_V, const std::vector<double>& pulls0 = {},
                 const std::vector<double>& pulls1 = {});

}  // namespace lyrefit
