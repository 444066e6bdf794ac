#include "lyrefit/estimate/refine/drop_diode.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/estimate/refine/coordinates.h"

namespace lyrefit {
namespace {

// A diode is dropped if it adds less than this part of the largest current at the largest voltage.
// A trial diode is as weak, so that only the direction of its current matters.
constexpr double kFaded = 1e-9;
constexpr int kSteps = 24;  // over the range of n

// Ratio of a diode's current at the largest voltage to its saturation current.
double Growth(const ModelShape& shape, const std::vector<double>& p, double n) {
  return std::exp(std::min(shape.junction_V(p) / (n * shape.thermal_voltage_V), 600.0));
}

DiodeToAdd Try(const FitModel& model, FitPoint trial, int is, double n) {
  const ModelShape& shape = model.shape();
  std::vector<bool> active(shape.size(), true);
  active[is] = false;
  trial.p[shape.parameters[is].with[0]] = n;
  trial.p[is] = kFaded * shape.current_scale_A / Growth(shape, trial.p, n);
  const Linearization now = Linearize(model, trial, active);
  const double norm = now.jacobian.col(0).norm();
  const double slope = now.jacobian.col(0).dot(now.residual);
  return {-slope / (norm * now.residual.norm()), trial.p[is] * -slope / (norm * norm), n};
}

}  // namespace

void ActivateAbsent(const ModelShape& shape, const std::vector<double>& p,
                    std::vector<bool>* active) {
  for (int i = 0; i < shape.size(); ++i) {
    const FitParameter& parameter = shape.parameters[i];
    if (parameter.kind != ParameterKind::kSaturation || !(p[i] <= 0)) continue;
    (*active)[i] = (*active)[parameter.with[0]] = true;
  }
}

bool RemoveFaded(const ModelShape& shape, std::vector<double>* p, std::vector<bool>* active) {
  bool any = false;
  ActivateAbsent(shape, *p, active);
  for (int i = 0; i < shape.size(); ++i) {
    const FitParameter& parameter = shape.parameters[i];
    if (!parameter.may_vanish || (*active)[i]) continue;
    const double strongest = (*p)[i] * Growth(shape, *p, (*p)[parameter.with[0]]);
    if (strongest > kFaded * shape.current_scale_A) continue;
    (*p)[i] = 0;
    any = true;
  }
  if (any) ActivateAbsent(shape, *p, active);
  return any;
}

DiodeToAdd FindDiodeToAdd(const FitModel& model, const FitModel* coarse, const FitPoint& point,
                          int saturation) {
  const ModelShape& shape = model.shape();
  const FitParameter& n = shape.parameters[shape.parameters[saturation].with[0]];
  const int steps = n.fixed() ? 0 : kSteps;
  DiodeToAdd best;
  for (int step = 0; step <= steps; ++step) {
    const double t = static_cast<double>(step) / kSteps;
    const double trial = n.fixed() ? n.lower : 1 / ((1 - t) / n.lower + t / n.upper);
    const DiodeToAdd one = Try(coarse != nullptr ? *coarse : model, point, saturation, trial);
    if (one.cosine > best.cosine) best = one;
  }
  return coarse != nullptr && best.n > 0 ? Try(model, point, saturation, best.n) : best;
}

}  // namespace lyrefit
