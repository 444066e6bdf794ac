#include "lyrefit/estimate/refine/model.h"

#include <algorithm>
#include <cmath>

namespace lyrefit {

int ModelShape::locals() const {
  int count = 0;
  for (const FitBlock& block : blocks) count += block.locals;
  return count;
}

double ModelShape::junction_V(const std::vector<double>& p) const {
  double left_V = voltage_scale_V;
  for (int i = 0; i < size(); ++i) {
    if (parameters[i].kind == ParameterKind::kSeries) left_V -= forward_A * p[i];
  }
  return std::max(left_V, thermal_voltage_V);
}

std::vector<FitParameter> MakeFitParameters(const std::vector<ParameterInfo>& infos,
                                            const std::vector<double>& lower,
                                            const std::vector<double>& upper) {
  std::vector<FitParameter> parameters(lower.size());
  for (std::size_t i = 0; i < lower.size(); ++i) {
    FitParameter& parameter = parameters[i];
    if (i < infos.size()) {
      parameter.kind = infos[i].kind;
      parameter.step = infos[i].step;
      parameter.with = infos[i].with;
    }
    parameter.lower = lower[i];
    parameter.upper = upper[i];
    parameter.may_vanish = parameter.kind == ParameterKind::kSaturation && lower[i] <= 0;
  }
  return parameters;
}

void SetBlocks(const std::vector<int>& readings, ModelShape* shape) {
  shape->points = 0;
  for (const int count : readings) {
    shape->blocks.push_back({count, 0});
    shape->points += count;
  }
}

void SetParameters(const std::vector<ParameterInfo>& infos, const std::vector<double>& lower,
                   const std::vector<double>& upper, ModelShape* shape) {
  shape->parameters = MakeFitParameters(infos, lower, upper);
  const double perfect = shape->resistance_scale() / kPerfectConductance;
  for (FitParameter& parameter : shape->parameters) {
    if (parameter.kind == ParameterKind::kShunt && !parameter.fixed()) {
      parameter.upper = std::min(parameter.upper, perfect);
    }
  }
}

double FitModel::MeanSquare(const FitPoint& point) const {
  double sum = 0;
  const double* local = point.local.data();
  std::vector<double> residuals;
  for (std::size_t b = 0; b < shape_.blocks.size(); ++b) {
    residuals.assign(shape_.blocks[b].residuals, 0);
    if (!Evaluate(static_cast<int>(b), point.p.data(), local, residuals.data(), nullptr, nullptr)) {
      return HUGE_VAL;
    }
    for (const double r : residuals) sum += r * r;
    local += shape_.blocks[b].locals;
  }
  return sum / shape_.points;
}

}  // namespace lyrefit
