#include "lyrefit/certify/mixture.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/certify/mixture_solver.h"

namespace lyrefit {

MixtureData CurveData(const std::vector<double>& voltage_V, const std::vector<double>& current_A) {
  const auto points = static_cast<Eigen::Index>(voltage_V.size());
  MixtureData data;
  data.voltage_V = Eigen::Map<const Eigen::VectorXd>(voltage_V.data(), points);
  data.current_A = Eigen::Map<const Eigen::VectorXd>(current_A.data(), points);
  data.target_A = data.current_A;
  data.weight = Eigen::VectorXd::Ones(points);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(points);
  data.terms = {{data.weight, zero}, {zero, -data.weight}};
  for (std::size_t k = 0; k < voltage_V.size(); ++k) {
    if (current_A[k] < 0) continue;
    data.reference_voltage_V = std::max(data.reference_voltage_V, voltage_V[k]);
  }
  return data;
}

Eigen::VectorXd DiodeColumn(const Eigen::VectorXd& vd, double scale_voltage_V, double u) {
  const double floor = std::exp(-u * scale_voltage_V);
  const double scale = -1 / -std::expm1(-u * scale_voltage_V);
  return (scale * (((vd.array() - scale_voltage_V) * u).exp() - floor)).matrix();
}

Mixture SolveMixture(const MixtureData& data, const std::vector<Window>& windows, double rs,
                     const std::vector<Atom>& start, double tolerance, double dark_bound_A) {
  return MixtureSolver(data, windows, rs).Run(start, tolerance, dark_bound_A);
}

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

namespace {

constexpr double kSlack = 1e-12;        // relative tolerance of Is and of u
constexpr double kSmallestIs = 1e-305;  // ampere; smaller doubles lose digits

bool Inside(double u, const Window& window) {
  return u >= window.lower * (1 - kSlack) && u <= window.upper * (1 + kSlack);
}

// Divides the Is of one atom among its diodes: first the lower end of each range, then the rest in
// order up to the upper ends. False if that is impossible.
bool Share(const std::vector<int>& atom_of, int atom, double u, double saturation_A,
           const std::vector<Window>& windows, std::vector<DiodeValues>* diodes) {
  double rest = saturation_A;
  int last = -1;
  for (std::size_t d = 0; d < windows.size(); ++d) {
    if (atom_of[d] != atom) continue;
    if (!Inside(u, windows[d])) return false;
    (*diodes)[d] = {u, windows[d].saturation_lower_A};
    rest -= windows[d].saturation_lower_A;
    last = static_cast<int>(d);
  }
  if (last < 0 || rest < -kSlack * saturation_A) return false;
  for (std::size_t d = 0; d < windows.size(); ++d) {
    if (atom_of[d] != atom) continue;
    const Window& window = windows[d];
    const double room = window.saturation_upper_A - window.saturation_lower_A;
    const double more = std::min(std::max(rest, 0.0), room);
    (*diodes)[d].saturation_A += more;
    rest -= more;
  }
  return rest <= kSlack * saturation_A;
}

}  // namespace

std::optional<std::vector<DiodeValues>> AsDiodes(const Mixture& mixture,
                                                 const std::vector<Window>& windows) {
  const int atoms = static_cast<int>(mixture.atoms.size());
  std::vector<double> saturation_A;
  for (const Atom& atom : mixture.atoms) {
    saturation_A.push_back(atom.current_A / std::expm1(atom.u * mixture.reference_voltage_V));
    if (!(saturation_A.back() >= kSmallestIs)) return std::nullopt;
  }
  if (atoms > static_cast<int>(windows.size())) return std::nullopt;
  std::vector<int> atom_of(windows.size(), -1);  // -1: the diode carries no current
  while (true) {
    std::vector<DiodeValues> diodes(windows.size());
    bool fits = true;
    for (std::size_t d = 0; d < windows.size(); ++d) {
      diodes[d].u = windows[d].lower;
      fits = fits && (atom_of[d] >= 0 || windows[d].saturation_lower_A <= 0);
    }
    for (int j = 0; j < atoms && fits; ++j) {
      fits = Share(atom_of, j, mixture.atoms[j].u, saturation_A[j], windows, &diodes);
    }
    if (fits) return diodes;
    std::size_t d = 0;
    while (d < atom_of.size() && ++atom_of[d] == atoms) atom_of[d++] = -1;
    if (d == atom_of.size()) return std::nullopt;
  }
}

}  // namespace lyrefit
