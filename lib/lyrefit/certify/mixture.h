#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/certify/cause_shape.h"

namespace lyrefit {

// The problem at a given Rs for any mixture of diodes with n in given ranges: find coefficients of
// the linear terms within their ranges (photocurrent, shunt) and a non-negative measure over n that
// minimise
//
//   1/2 sum over points of (weight (light - leaks(Vd) - sum of diode currents(Vd) - target))^2
//
// with Vd = V + I Rs. For the measured-current residual of a curve I and target are the measured
// currents. It is convex (least squares over a continuum of columns), its solution has few atoms,
// and any vector y proves a lower bound (weak duality): b . y - |y|^2 / 2 less what the admissible
// columns can gain along y. Diodes are written with u = 1 / (n Ns Vt) and the current they take
// at a voltage Vs, the largest junction voltage there is at this Rs, so that columns are of order
// 1:
//   a(u) = -(exp(u Vd) - 1) / (exp(u Vs) - 1).

// A linear unknown in [lower, upper]; its column is constant + per_volt Vd, the same sign
// everywhere it matters: light has no part per volt and is positive, a leak is negative at forward
// voltages. With a shape the column is that of a cause instead, less shape->value(Vd, theta); terms
// of one shape stand side by side by rising theta, and span all theta between.
struct LinearTerm {
  Eigen::VectorXd constant;
  Eigen::VectorXd per_volt;
  double lower = 0;
  double upper = kInfinity;
  std::shared_ptr<const CauseShape> shape = nullptr;
  double theta = 0;

  bool light() const { return shape == nullptr && per_volt.isZero(0); }
  Eigen::VectorXd Column(const Eigen::VectorXd& vd) const {
    if (shape != nullptr) return -shape->Values(vd, theta);
    return constant + per_volt.cwiseProduct(vd);
  }
  Eigen::VectorXd Slope(const Eigen::VectorXd& vd) const {  // of the column, by Vd
    return shape != nullptr ? Eigen::VectorXd(-shape->Slopes(vd, theta)) : per_volt;
  }
};

struct MixtureData {
  Eigen::VectorXd voltage_V;
  Eigen::VectorXd current_A;  // Vd = voltage_V + Rs current_A
  Eigen::VectorXd target_A;   // what is to be met
  Eigen::VectorXd weight;     // of the residuals, not of their squares
  std::vector<LinearTerm> terms;
  double reference_voltage_V = 0;  // largest voltage at which the device delivers current

  Eigen::VectorXd JunctionVoltage(double rs) const { return voltage_V + rs * current_A; }
  Eigen::VectorXd WeightedTarget() const { return weight.cwiseProduct(target_A); }
};

// The measured-current problem of a curve, unweighted: photocurrent and shunt conductance (in that
// order) of zero or more.
enum CurveTerm { kPhotocurrentTerm, kShuntTerm };
MixtureData CurveData(const std::vector<double>& voltage_V, const std::vector<double>& current_A);

// A range of u, in 1/V, and of the sum of the saturation currents of the diodes in it.
struct Window {
  double lower = 0;
  double upper = 0;
  double saturation_lower_A = 0;
  double saturation_upper_A = kInfinity;
};

struct Atom {
  double u = 0;
  double current_A = 0;  // Is (exp(u Vref) - 1)
};

struct Mixture {
  double rs = 0;
  double scale_voltage_V = 0;  // Vs
  double reference_voltage_V = 0;
  Eigen::VectorXd linear;   // coefficients of the data's terms
  std::vector<Atom> atoms;  // by rising u
  double primal = 0;        // half the sum of squares of this mixture, an upper bound
  double slope = 0;         // d primal / d Rs
  Eigen::VectorXd y;        // the dual vector: weighted measured - modelled, cleaned of rounding
  // b . y - |y|^2 / 2, less what the linear terms and the saturation currents can gain within finite
  // ranges.
  double dual = 0;
  Eigen::VectorXd pulls;  // of the terms: their weighted columns . y
  // Of the windows: what a diode gains along y is priced at this per ampere of Is; 0 where no end of
  // the range of Is holds.
  std::vector<double> saturation_pulls;
  double excess = 0;  // proved: no diode column, scaled at Vs, exceeds a . y = excess beyond that
  double relative_gap = 0;  // |primal - what y proves|, the excess priced, over primal
};

// Solves the problem at `rs` with u in the windows (sorted, at most an end shared), from the atoms of a
// neighbouring solution if there is one. The mixture respects the ranges of Is. `tolerance` is the relative duality gap aimed at; what was
// reached is in the result. `dual_gain_A` prices what is left of the excess: no competitive mixture has
// a larger sum of shunt and diode currents at Vs.
Mixture SolveMixture(const MixtureData& data, const std::vector<Window>& windows, double rs,
                     const std::vector<Atom>& start, double tolerance, double dual_gain_A);

// a(u) at junction voltages vd, for any Vs > 0.
Eigen::VectorXd DiodeColumn(const Eigen::VectorXd& vd, double scale_voltage_V, double u);

}  // namespace lyrefit
