#include "peer.h"

#include <cmath>

namespace lyrefit::bench {

PeerProblem::PeerProblem(const Case& subject, Model model, Objective objective)
    : device_(subject.device),
      points_(subject.points),
      objective_(objective),
      space_(subject.bounds, std::vector<double>(subject.device.size(), std::nan(""))),
      target_(1e3 * CertifiedRmse(model, objective) * (1 + 1e-9)),
      x_(space_.dimensions()),
      p_(subject.device.size()),
      current_(subject.points.current_A) {
  for (int j = 0; j < dimensions(); ++j) {
    side_.push_back(space_.box().upper[j] - space_.box().lower[j]);
    const ParameterBounds& bounds = subject.bounds[j];
    logarithmic_.push_back(bounds.scale == SearchScale::kLog && bounds.search_lower > 0);
  }
}

void PeerProblem::ToParameters(const double* unit, double* p) const {
  for (int j = 0; j < dimensions(); ++j) x_[j] = space_.box().lower[j] + unit[j] * side_[j];
  space_.ToParameters(x_.data(), p);
}

double PeerProblem::Rmse(const double* unit) const {
  ToParameters(unit, p_.data());
  return 1e3 * std::sqrt(MeanSquare(device_, objective_, p_.data(), points_));
}

double PeerProblem::MeanSquareAndGradient(const double* unit, double* gradient) const {
  ToParameters(unit, p_.data());
  const double* p = p_.data();
  if (gradient == nullptr) return 1e6 * MeanSquare(device_, objective_, p, points_);

  const int diodes = DiodeCount(device_);
  const bool solved = objective_ == Objective::kSolvedCurrent;
  if (solved) {
    PreparedDevice prepared;
    PrepareDevice(device_.terms.data(), static_cast<int>(device_.terms.size()),
                  device_.resistance_series, device_.module_thermal_voltage_V, p, &prepared);
    FastestKernel().solve_currents(prepared, points_,
                                   JunctionVoltageLimit(prepared, points_.largest_voltage_V),
                                   current_.data());
  }
  for (int j = 0; j < dimensions(); ++j) gradient[j] = 0;
  double sum = 0;
  double slope[9];  // of the model's current with respect to each parameter
  for (int k = 0; k < points_.size; ++k) {
    const int block = k / Block::kLanes, lane = k % Block::kLanes;
    const double measured = points_.current_A[block].lane[lane];
    const double inner = solved ? current_[block].lane[lane] : measured;
    const double vd = points_.voltage_V[block].lane[lane] + inner * p[kRs];
    double current = p[kIph] - vd / p[kRsh];
    double conductance = -1 / p[kRsh];  // dF/dVd
    for (int d = 0; d < diodes; ++d) {
      const int is = SaturationCurrentIndex(d), n = IdealityIndex(d);
      const double b = 1 / (p[n] * device_.module_thermal_voltage_V);
      const double e = std::exp(vd * b);
      current -= p[is] * (e - 1);
      conductance -= p[is] * b * e;
      slope[is] = 1 - e;
      slope[n] = p[is] * e * vd * b / p[n];
    }
    slope[kIph] = 1;
    slope[kRsh] = vd / (p[kRsh] * p[kRsh]);
    slope[kRs] = inner * conductance;
    const double residual = (solved ? inner : current) - measured;
    const double factor = solved ? 1 / (1 - p[kRs] * conductance) : 1;
    sum += residual * residual;
    for (int j = 0; j < dimensions(); ++j) gradient[j] += 2 * residual * factor * slope[j];
  }
  for (int j = 0; j < dimensions(); ++j) {
    gradient[j] *= 1e6 / points_.size * side_[j] * (logarithmic_[j] ? p[j] : 1);
  }
  return 1e6 * sum / points_.size;
}

}  // namespace lyrefit::bench
