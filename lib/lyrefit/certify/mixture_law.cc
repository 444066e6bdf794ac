#include "lyrefit/certify/mixture_law.h"

#include <algorithm>
#include <cmath>

namespace lyrefit {

MixtureLaw::MixtureLaw(const MixtureData& data, const Mixture& mixture)
    : reference_voltage_V_(data.reference_voltage_V), atoms_(mixture.atoms) {
  for (std::size_t j = 0; j < data.terms.size(); ++j) {
    const double x = mixture.linear[static_cast<Eigen::Index>(j)];
    constant_ += x * data.terms[j].constant[0];
    per_volt_ += x * data.terms[j].per_volt[0];
  }
}

double MixtureLaw::Current(double vd) const {
  double current = constant_ + per_volt_ * vd;
  for (const Atom& atom : atoms_) {
    const double floor = std::exp(-atom.u * reference_voltage_V_);
    current -= atom.current_A * (std::exp((vd - reference_voltage_V_) * atom.u) - floor) /
               -std::expm1(-atom.u * reference_voltage_V_);
  }
  return current;
}

double MixtureLaw::Slope(double vd) const {
  double slope = -per_volt_;
  for (const Atom& atom : atoms_) {
    slope += atom.current_A * atom.u * std::exp((vd - reference_voltage_V_) * atom.u) /
             -std::expm1(-atom.u * reference_voltage_V_);
  }
  return slope;
}

// Newton's method on h(x) = x - V - rs Current(x), which rises and is convex. From the right it
// never overshoots.
double MixtureLaw::Solve(double voltage_V, double rs) const {
  constexpr int kMostLawSteps = 3000;
  double x = voltage_V + rs * std::max(Current(voltage_V), 0.0);  // h(x) >= 0 there
  for (int step = 0; step < kMostLawSteps; ++step) {
    const double change = (x - voltage_V - rs * Current(x)) / (1 + rs * Slope(x));
    if (!(std::fabs(change) > 1e-15 * (std::fabs(x) + std::fabs(voltage_V)))) break;
    x -= change;
  }
  return rs * Slope(x) > 1 ? (x - voltage_V) / rs : Current(x);
}

Eigen::VectorXd SolvedCurrents(const MixtureData& data, const Mixture& mixture) {
  const MixtureLaw law(data, mixture);
  Eigen::VectorXd currents(data.voltage_V.size());
  for (Eigen::Index k = 0; k < currents.size(); ++k) {
    currents[k] = law.Solve(data.voltage_V[k], mixture.rs);
  }
  return currents;
}

}  // namespace lyrefit
