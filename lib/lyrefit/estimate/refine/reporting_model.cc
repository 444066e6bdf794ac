#include "lyrefit/estimate/refine/reporting_model.h"

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace lyrefit {
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
