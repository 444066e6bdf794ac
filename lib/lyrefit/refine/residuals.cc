#include "lyrefit/refine/residuals.h"

#include <ceres/jet.h>
#include <glog/logging.h>

#include <cmath>

#include "lyrefit/base/dual.h"

namespace lyrefit {
namespace {

using Jet = ceres::Jet<double, kJetWidth>;
using Gradient = Eigen::Matrix<double, 1, kJetWidth>;  // with respect to the coordinates

// A term as a function of its two prepared numbers and of the junction voltage alone: three
// derivatives a point, whatever the number of coordinates.
using OfThree = Dual<3>;

struct Sloped {
  PreparedTerm<OfThree> term;
  Gradient a;
  Gradient b;
};

// The explicit right-hand side at one point.
struct Explicit {
  double current = 0;
  double conductance = 0;  // dF/dVd
  Gradient gradient;       // at a current that is held
};

class ExplicitModel {
 public:
  ExplicitModel(const Device& device, const Jet* p) : rs_(p[device.resistance_series]) {
    for (const Term& term : device.terms) {
      PreparedTerm<Jet> jet{};
      PrepareTerm(term, p, device.module_thermal_voltage_V, &jet);
      terms_.push_back({{jet.kind, {jet.a.a, 0}, {jet.b.a, 1}}, jet.a.v, jet.b.v});
    }
  }
  double rs() const { return rs_.a; }

  Explicit At(double voltage_V, double current_A) const {
    const OfThree vd(voltage_V + current_A * rs_.a, 2);
    Explicit point;
    point.gradient.setZero();
    for (const Sloped& sloped : terms_) {
      const OfThree current = TermCurrent(sloped.term, vd);
      point.current += current.a;
      point.conductance += current.v[2];
      point.gradient += current.v[0] * sloped.a + current.v[1] * sloped.b;
    }
    point.gradient += (point.conductance * current_A) * rs_.v.transpose();
    return point;
  }

 private:
  Jet rs_;
  std::vector<Sloped> terms_;
};

}  // namespace

bool CurveResiduals::Evaluate(const double* theta, double* residuals, double* jacobian) const {
  if (!coordinates_.Sane(theta)) return false;
  std::vector<double> p(problem_.device.parameters.size());
  coordinates_.ToParameters(theta, p.data());
  const bool measured = problem_.objective == Objective::kMeasuredCurrent;
  const std::vector<double> at =
      measured ? problem_.current_A
               : SolveCurrents(problem_.device, p.data(), problem_.points, *problem_.kernel);
  if (jacobian != nullptr || measured) return Differentiate(theta, at, residuals, jacobian);
  for (std::size_t k = 0; k < at.size(); ++k) {
    residuals[k] = (at[k] - problem_.current_A[k]) * (std::sqrt(problem_.weights[k]) / unit_A_);
    if (!std::isfinite(residuals[k])) return false;
  }
  return true;
}

bool CurveResiduals::Differentiate(const double* theta, const std::vector<double>& at,
                                   double* residuals, double* jacobian) const {
  const int moving = coordinates_.size();
  CHECK_LE(moving, kJetWidth);
  std::vector<Jet> jets(moving), p(problem_.device.parameters.size());
  for (int k = 0; k < moving; ++k) jets[k] = Jet(theta[k], k);
  coordinates_.ToParameters(jets.data(), p.data());
  const ExplicitModel model(problem_.device, p.data());
  const bool measured = problem_.objective == Objective::kMeasuredCurrent;
  for (std::size_t k = 0; k < at.size(); ++k) {
    const Explicit point = model.At(problem_.voltage_V[k], at[k]);
    const double scale = std::sqrt(problem_.weights[k]) / unit_A_;
    residuals[k] = ((measured ? point.current : at[k]) - problem_.current_A[k]) * scale;
    if (!std::isfinite(residuals[k])) return false;
    if (jacobian == nullptr) continue;
    const double implicit = measured ? 1.0 : 1.0 / (1.0 - model.rs() * point.conductance);
    const Gradient row = point.gradient * (implicit * scale);
    if (!row.allFinite()) return false;
    for (int c = 0; c < moving; ++c) jacobian[k * moving + c] = row[c];
  }
  return true;
}

}  // namespace lyrefit
