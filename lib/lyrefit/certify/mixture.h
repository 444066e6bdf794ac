#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lyrefit/base/numbers.h"

namespace lyrefit {

// The convex problem at a given Rs, for any mixture of diodes with n in given ranges. The unknowns
// are coefficients of the linear terms within their ranges (photocurrent, shunt conductance) and a
// non-negative measure over n. They minimise
//
//   1/2 sum over points of (weight (light - leaks(Vd) - sum of diode currents(Vd) - target))^2
//
// with Vd = V + I Rs. "Light" is the photocurrent, a "leak" is a shunt current. For the
// measured-current residual of a curve, I and target are the measured currents. The problem is
// least squares over a continuum of columns, and its solution has few atoms (diodes). Any vector y
// proves a lower bound (weak duality). With b the weighted target, it is b . y - |y|^2 / 2 less the
// largest gain of the admissible columns along y. A diode is given by u = 1 / (n Ns Vt) and by its
// current at a voltage Vs. Vs is the largest junction voltage at this Rs, so that columns are of
// order 1:
//
//   a(u) = -(exp(u Vd) - 1) / (exp(u Vs) - 1).

// A linear unknown in [lower, upper] with the column constant + per_volt Vd. The column has one
// sign at forward voltages: positive for light, which has no part per volt, and negative for a
// leak.
struct LinearTerm {
  Eigen::VectorXd constant;
  Eigen::VectorXd per_volt;
  double lower = 0;
  double upper = kInfinity;

  bool light() const { return per_volt.isZero(0); }
  Eigen::VectorXd Column(const Eigen::VectorXd& vd) const {
    return constant + per_volt.cwiseProduct(vd);
  }
};

struct MixtureData {
  Eigen::VectorXd voltage_V;
  Eigen::VectorXd current_A;  // Vd = voltage_V + Rs current_A
  Eigen::VectorXd target_A;   // currents to be fitted
  Eigen::VectorXd weight;     // of the residuals, not of their squares
  std::vector<LinearTerm> terms;
  double reference_voltage_V = 0;  // largest voltage at which the device delivers current

  Eigen::VectorXd JunctionVoltage(double rs) const { return voltage_V + rs * current_A; }
  Eigen::VectorXd WeightedTarget() const { return weight.cwiseProduct(target_A); }
};

// The unweighted measured-current problem of a curve. It has two terms, both zero or more:
// photocurrent (A) and shunt conductance (S), in this order.
enum CurveTerm { kPhotocurrentTerm, kShuntTerm };
MixtureData CurveData(const std::vector<double>& voltage_V, const std::vector<double>& current_A);

// A range of u, in 1/V, and of the sum of the saturation currents of the diodes in it.
struct Window {
  double lower = 0;
  double upper = 0;
  double saturation_lower_A = 0;
  double saturation_upper_A = kInfinity;
};

// One diode of a mixture.
struct Atom {
  double u = 0;
  double current_A = 0;  // Is (exp(u Vref) - 1)
};

// Solution of the convex problem at one Rs (ohm).
struct Mixture {
  double rs = 0;
  double scale_voltage_V = 0;  // Vs
  double reference_voltage_V = 0;
  Eigen::VectorXd linear;   // coefficients of the data's terms
  std::vector<Atom> atoms;  // by rising u
  double primal = 0;        // half the sum of squares of this mixture, an upper bound
  double slope = 0;         // d primal / d Rs
  Eigen::VectorXd y;        // dual vector: weighted (target - model), cleaned of rounding errors
  // Dual value: b . y - |y|^2 / 2 less the largest gain of the linear terms and saturation currents
  // with finite ranges.
  double dual = 0;
  Eigen::VectorXd pulls;  // of the terms: weighted column . y
  // Multipliers of the ranges of Is, one per window. Multiplier times Is is subtracted from the
  // gain of a diode along y. The multiplier is 0 where no end of the range is active.
  std::vector<double> saturation_pulls;
  double excess = 0;  // proved bound of a . y less those multiples of Is, columns scaled at Vs
  double relative_gap = 0;  // (|primal - dual| + penalty of the excess) / primal
};

// Solves the problem at `rs` (ohm) with u in the windows, which are sorted and share at most an
// end. `start` has the atoms of a neighbouring solution, or is empty. The mixture respects the
// ranges of Is. `tolerance` is the relative duality gap to reach; the result states the gap that
// was reached. `dark_bound_A` is the penalty factor of the remaining excess. It bounds the sum of
// shunt and diode currents at Vs of every competitive mixture.
Mixture SolveMixture(const MixtureData& data, const std::vector<Window>& windows, double rs,
                     const std::vector<Atom>& start, double tolerance, double dark_bound_A);

// The diode column a(u) at junction voltages vd, for any Vs > 0.
Eigen::VectorXd DiodeColumn(const Eigen::VectorXd& vd, double scale_voltage_V, double u);

// The current of a mixture as a function of the junction voltage. It is concave, and falls wherever
// its leak terms do not rise. The linear terms must be the same at all points (one curve).
class MixtureLaw {
 public:
  MixtureLaw(const MixtureData& data, const Mixture& mixture);
  double Current(double vd) const;
  double Slope(double vd) const;  // - dI / dVd, >= 0
  // The current at the terminal voltage V, the root of I = Current(V + I rs), for rs >= 0.
  double Solve(double voltage_V, double rs) const;

 private:
  double constant_ = 0;
  double per_volt_ = 0;
  double reference_voltage_V_ = 0;
  std::vector<Atom> atoms_;
};

// The solved currents of a mixture at the voltages of the data and at its own Rs.
Eigen::VectorXd SolvedCurrents(const MixtureData& data, const Mixture& mixture);

struct DiodeValues {
  double u = 0;  // 1 / (n Ns Vt), in 1/V
  double saturation_A = 0;
};

// Returns the diodes of a model that equals the mixture: one per window, in the order of `windows`,
// with u and Is inside that window. Several diodes may share one atom of the mixture. A diode whose
// Is may be 0 may have no atom; it then carries no current. Returns none if no such model exists,
// or if an Is is below 1e-305 A.
std::optional<std::vector<DiodeValues>> AsDiodes(const Mixture& mixture,
                                                 const std::vector<Window>& windows);

}  // namespace lyrefit
