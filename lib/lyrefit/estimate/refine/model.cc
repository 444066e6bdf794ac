#include "lyrefit/estimate/refine/model.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "lyrefit/estimate/refine/reporting_model.h"

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
  std::vector<double> locals = point.local;
  locals.resize(shape_.locals(), 0);
  const double* local = locals.data();
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

namespace {

ModelShape ReportingShape(ModelShape shape, const EffectSpan& effects) {
  if (effects.effects == nullptr) return shape;
  int first = effects.first;
  for (const EffectUse& use : effects.effects->uses) {
    const int size = use.effect->size();
    std::vector<double> lower, upper;
    lower.reserve(size);
    upper.reserve(size);
    for (int k = first; k < first + size; ++k) {
      lower.push_back(shape.parameters[k].lower);
      upper.push_back(shape.parameters[k].upper);
    }
    const std::vector<ParameterRange> ranges =
        ReportedRanges(*use.effect, effects.effects->readings.scale, lower.data(), upper.data());
    for (const ParameterRange& range : ranges) {
      FitParameter& parameter = shape.parameters[first++];
      parameter.lower = range.low;
      parameter.upper = range.high;
      parameter.step = parameter.fixed() ? 1 : 0.1 * (parameter.upper - parameter.lower);
    }
  }
  return shape;
}

}  // namespace

ReportingModel::ReportingModel(const FitModel& internal, const EffectSpan& effects)
    : FitModel(ReportingShape(internal.shape(), effects)), internal_(internal), effects_(effects) {}

bool ReportingModel::Evaluate(int block, const double* p, const double* local, double* residuals,
                              double* slopes, double* local_slopes) const {
  if (effects_.effects == nullptr) {
    return internal_.Evaluate(block, p, local, residuals, slopes, local_slopes);
  }
  const int count = shape().size();
  const std::vector<double> own = Internal(effects_, std::vector<double>(p, p + count));
  if (!internal_.Evaluate(block, own.data(), local, residuals, slopes, local_slopes)) return false;
  if (slopes == nullptr) return true;
  int first = effects_.first;
  for (const EffectUse& use : effects_.effects->uses) {
    const int size = use.effect->size();
    const Eigen::MatrixXd chain =
        InternalByReported(*use.effect, effects_.effects->readings.scale, own.data() + first);
    for (int r = 0; r < shape().blocks[block].residuals; ++r) {
      Eigen::Map<Eigen::RowVectorXd> row(slopes + static_cast<std::size_t>(r) * count + first,
                                         size);
      row = (row * chain).eval();
    }
    first += size;
  }
  return true;
}

double ReportingModel::MeanSquare(const FitPoint& point) const {
  return internal_.MeanSquare({Internal(effects_, point.p), point.local});
}

}  // namespace lyrefit
