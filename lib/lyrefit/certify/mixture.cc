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

}  // namespace lyrefit
