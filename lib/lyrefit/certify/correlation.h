#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/certify/interval.h"
#include "lyrefit/certify/mixture.h"

namespace lyrefit {

// The largest correlation a(u) . y of a diode column a(u) with a vector y, over windows of u.
struct Correlation1D {
  double bound = 0;   // proved upper bound over the windows; never below 0
  double best = 0;    // largest value evaluated
  double best_u = 0;  // u of that value
};

// Bounds the correlation by bisection of the windows. A piece is finished when bounds on its second
// derivative prove that it stays below `allowed`, or when it is known to exceed `allowed`. `vd` are
// junction voltages in volt and `y` is the weighted dual vector, one element per point. Columns are
// scaled at `scale_voltage_V` (Vs of mixture.h). `marks` are atoms where the correlation touches
// zero from below; pieces end there. `pulls` has one multiplier per window, or is empty: multiplier
// times Is is subtracted from the gain of a diode. With doubles the bound is a proof up to
// rounding, with intervals without exception.
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

// Bounds the correlation between two solutions at rs0 and rs1 (ohm), for every u of the windows. At
// t in [0, 1] the correlation is the weighted a(u; rs0 + t (rs1 - rs0)) . (y0 + t (y1 - y0)).
// Returns an upper bound of its negative second derivative in t. The correlation exceeds the
// interpolation between its ends, or zero, by at most t (1 - t) / 2 times that. Pieces too far
// below zero to rise above it are omitted. Columns are scaled by the diode's current at
// `scale_voltage_V`. `pulls0` and `pulls1` are the multipliers of Is at both ends. Returns infinity
// if an exponent is too large.
template <class Real = double>
double BoundBend(const MixtureData& data, const std::vector<Window>& windows, double rs0,
                 double rs1, const Eigen::VectorXd& y0, const Eigen::VectorXd& y1,
                 double scale_voltage_V, const std::vector<double>& pulls0 = {},
                 const std::vector<double>& pulls1 = {});

}  // namespace lyrefit
