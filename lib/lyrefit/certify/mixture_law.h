#pragma once

#include "lyrefit/certify/mixture.h"

namespace lyrefit {

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

}  // namespace lyrefit
