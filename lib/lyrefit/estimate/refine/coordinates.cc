#include "lyrefit/estimate/refine/coordinates.h"

#include <algorithm>

namespace lyrefit {
namespace {

constexpr double kLowestConductance = -0.1;  // in units of 1 / R0
constexpr double kLargestLogCurrent = 30;    // of a diode at V0, in units of I0

// Kinds whose coordinates fall as the parameter rises.
bool Falls(ParameterKind kind) { return kind == ParameterKind::kIdeality || IsConductance(kind); }

// The natural value of a step of 1 along a linear coordinate.
double StepOf(const ModelShape& shape, const FitParameter& parameter) {
  if (parameter.kind == ParameterKind::kSeries) return shape.resistance_scale();
  if (parameter.kind != ParameterKind::kPhotocurrent) return parameter.step;
  return parameter.step * shape.current_scale_A;
}

}  // namespace

Coordinates::Coordinates(const ModelShape& shape, std::vector<double> p, std::vector<bool> active)
    : shape_(&shape),
      p_(std::move(p)),
      pivot_(shape.junction_V(p_) / shape.thermal_voltage_V),
      slot_(p_.size(), -1) {
  for (int i = 0; i < shape.size(); ++i) {
    if (active[i]) continue;
    slot_[i] = size();
    moving_.push_back(i);
  }
  for (int k = 0; k < size(); ++k) {
    const int i = moving_[k];
    const bool saturation = shape.parameters[i].kind == ParameterKind::kSaturation;
    const int n = shape.parameters[i].with[0];
    const double shift = saturation ? pivot_ / p_[n] : 0;
    const bool none = saturation && Moves(n);
    lower_.push_back(none ? -HUGE_VAL : OwnLower(k) + shift);
    upper_.push_back(none ? HUGE_VAL : OwnUpper(k) + shift);
  }
}

std::vector<double> Coordinates::Start() const {
  std::vector<double> theta;
  for (const int i : moving_) theta.push_back(Forward(i, p_[i]));
  return theta;
}

double Coordinates::Forward(int i, double value) const {
  const FitParameter& parameter = shape_->parameters[i];
  const double own = OwnForward(i, value);
  return parameter.kind == ParameterKind::kSaturation ? own + pivot_ / p_[parameter.with[0]] : own;
}

double Coordinates::OwnForward(int i, double value) const {
  const FitParameter& parameter = shape_->parameters[i];
  switch (parameter.kind) {
    case ParameterKind::kSaturation:
      return std::log(value / shape_->current_scale_A);
    case ParameterKind::kIdeality:
      return 1 / value;
    case ParameterKind::kShunt:
      return shape_->resistance_scale() / value;
    case ParameterKind::kDarkShunt:
      return p_[parameter.with[0]] / value;
    default:
      return value / StepOf(*shape_, parameter);
  }
}

// A dark shunt moves with its shunt, unless it is fixed.
bool Coordinates::FollowsShunt(int i) const {
  const FitParameter& parameter = shape_->parameters[i];
  return parameter.kind == ParameterKind::kDarkShunt && !parameter.fixed();
}

void Coordinates::ToParameters(const double* theta, double* p) const {
  const int count = shape_->size();
  for (int i = 0; i < count; ++i) p[i] = p_[i];
  for (int k = 0; k < size(); ++k) {
    const int i = moving_[k];
    const FitParameter& parameter = shape_->parameters[i];
    if (parameter.kind == ParameterKind::kIdeality) {
      p[i] = 1 / theta[k];
    } else if (parameter.kind == ParameterKind::kShunt) {
      const bool perfect = std::fabs(theta[k]) < kPerfectConductance;
      p[i] = shape_->resistance_scale() / (perfect ? kPerfectConductance : theta[k]);
    } else {
      p[i] = theta[k] * StepOf(*shape_, parameter);
    }
  }
  for (int i = 0; i < count; ++i) {  // parameters that depend on others
    const FitParameter& parameter = shape_->parameters[i];
    const int with = parameter.with[0];
    if (parameter.kind == ParameterKind::kSaturation && Moves(i)) {
      p[i] = shape_->current_scale_A * std::exp(theta[slot_[i]] - pivot_ / p[with]);
    } else if (FollowsShunt(i)) {
      p[i] = p[with] / (Moves(i) ? theta[slot_[i]] : p_[with] / p_[i]);
    }
  }
}

std::vector<Coordinates::Slope> Coordinates::Slopes(const double* p) const {
  std::vector<Slope> slopes;
  slopes.reserve(2 * moving_.size());
  const double r0 = shape_->resistance_scale();
  for (int i = 0; i < shape_->size(); ++i) {
    const FitParameter& parameter = shape_->parameters[i];
    const int with = parameter.with[0], k = slot_[i];
    if (FollowsShunt(i)) {
      if (Moves(i)) slopes.push_back({i, k, -p[i] * p[i] / p[with]});
      if (Moves(with)) slopes.push_back({i, slot_[with], -p[i] * p[with] / r0});
    } else if (!Moves(i)) {
      continue;
    } else if (parameter.kind == ParameterKind::kSaturation) {
      slopes.push_back({i, k, p[i]});
      if (Moves(with)) slopes.push_back({i, slot_[with], -pivot_ * p[i]});
    } else if (parameter.kind == ParameterKind::kIdeality) {
      slopes.push_back({i, k, -p[i] * p[i]});
    } else if (parameter.kind == ParameterKind::kShunt) {
      slopes.push_back({i, k, -p[i] * p[i] / r0});
    } else {
      slopes.push_back({i, k, StepOf(*shape_, parameter)});
    }
  }
  return slopes;
}

double Coordinates::Own(int coordinate, const std::vector<double>& theta) const {
  const FitParameter& parameter = shape_->parameters[moving_[coordinate]];
  if (parameter.kind != ParameterKind::kSaturation) return theta[coordinate];
  const int n = parameter.with[0];
  return theta[coordinate] - pivot_ * (Moves(n) ? theta[slot_[n]] : 1 / p_[n]);
}

double Coordinates::OwnLower(int coordinate) const {
  const int i = moving_[coordinate];
  const FitParameter& parameter = shape_->parameters[i];
  const ParameterRange range = BoundsAt(*shape_, i, p_);
  return OwnForward(i, Falls(parameter.kind) ? range.high : range.low);
}

double Coordinates::OwnUpper(int coordinate) const {
  const int i = moving_[coordinate];
  const FitParameter& parameter = shape_->parameters[i];
  const ParameterRange range = BoundsAt(*shape_, i, p_);
  return OwnForward(i, Falls(parameter.kind) ? range.low : range.high);
}

double Coordinates::AtBound(int coordinate, bool lower, const std::vector<double>& p) const {
  const int i = moving_[coordinate];
  const ParameterRange range = BoundsAt(*shape_, i, p);
  return lower != Falls(shape_->parameters[i].kind) ? range.low : range.high;
}

bool Coordinates::Sane(const double* theta) const {
  for (int k = 0; k < size(); ++k) {
    const ParameterKind kind = shape_->parameters[moving_[k]].kind;
    const double low = lower_[k], high = upper_[k];
    if (std::isfinite(low) && std::isfinite(high)) {
      const double margin = 0.5 * (high - low);
      if (theta[k] < low - margin || theta[k] > high + margin) return false;
    }
    if (kind == ParameterKind::kShunt && theta[k] < kLowestConductance) return false;
    const bool positive = kind == ParameterKind::kIdeality || kind == ParameterKind::kDarkShunt;
    if (positive && theta[k] < 0.5 * low) return false;
    if (kind == ParameterKind::kSaturation && !(theta[k] < kLargestLogCurrent)) return false;
  }
  return true;
}

ParameterRange BoundsAt(const ModelShape& shape, int i, const std::vector<double>& p) {
  const FitParameter& parameter = shape.parameters[i];
  if (parameter.kind != ParameterKind::kDarkShunt || parameter.fixed()) {
    return {parameter.lower, parameter.upper};
  }
  const double shunt = p[parameter.with[0]];
  return {shunt, shunt * std::exp(p[parameter.with[1]])};
}

bool EvaluateBlock(const FitModel& model, const Coordinates& coordinates, int block,
                   const double* theta, const double* local, double unit_A, double* residuals,
                   double* slopes, double* local_slopes) {
  if (!coordinates.Sane(theta)) return false;
  const ModelShape& shape = model.shape();
  const std::size_t rows = shape.blocks[block].residuals, count = shape.size();
  const std::size_t locals = shape.blocks[block].locals, moving = coordinates.size();
  std::vector<double> p(count);
  std::vector<double> natural(slopes != nullptr ? rows * count : 0);
  coordinates.ToParameters(theta, p.data());
  if (local_slopes != nullptr) std::fill(local_slopes, local_slopes + rows * locals, 0.0);
  if (!model.Evaluate(block, p.data(), local, residuals,
                      slopes != nullptr ? natural.data() : nullptr, local_slopes)) {
    return false;
  }
  const double scale = 1 / unit_A;
  for (std::size_t r = 0; r < rows; ++r) residuals[r] *= scale;
  if (!AllFinite(residuals, rows)) return false;
  if (local_slopes != nullptr) {
    for (std::size_t k = 0; k < rows * locals; ++k) local_slopes[k] *= scale;
    if (!AllFinite(local_slopes, rows * locals)) return false;
  }
  if (slopes == nullptr) return true;
  std::fill(slopes, slopes + rows * moving, 0.0);
  const std::vector<Coordinates::Slope> chain = coordinates.Slopes(p.data());
  for (std::size_t r = 0; r < rows; ++r) {
    const double* from = natural.data() + r * count;
    double* to = slopes + r * moving;
    for (const Coordinates::Slope& link : chain) {
      to[link.coordinate] += from[link.parameter] * (link.value * scale);
    }
  }
  return AllFinite(slopes, rows * moving);
}

Linearization Linearize(const FitModel& model, const FitPoint& point,
                        const std::vector<bool>& active) {
  const ModelShape& shape = model.shape();
  const Coordinates coordinates(shape, point.p, active);
  const std::vector<double> theta = coordinates.Start();
  const int moving = coordinates.size();
  Linearization now;
  int rows = 0;
  for (const FitBlock& block : shape.blocks) {
    now.first_row.push_back(rows);
    rows += block.residuals;
  }
  now.residual.setZero(rows);
  now.jacobian.setZero(rows, moving);
  const double* local = point.local.data();
  for (std::size_t b = 0; b < shape.blocks.size(); ++b) {
    const FitBlock& block = shape.blocks[b];
    const int first = now.first_row[b];
    now.local.push_back(RowMatrix::Zero(block.residuals, block.locals));
    double* slopes = now.jacobian.data() + static_cast<std::ptrdiff_t>(first) * moving;
    if (!EvaluateBlock(model, coordinates, static_cast<int>(b), theta.data(), local, 1.0,
                       now.residual.data() + first, slopes, now.local.back().data())) {
      now.residual.segment(first, block.residuals).setZero();
      now.jacobian.middleRows(first, block.residuals).setZero();
      now.local.back().setZero();
    }
    local += block.locals;
  }
  for (int k = 0; k < moving; ++k) now.parameter.push_back(coordinates.parameter(k));
  std::vector<double> p(shape.size());
  coordinates.ToParameters(theta.data(), p.data());
  now.natural_slope = Eigen::MatrixXd::Zero(shape.size(), moving);
  for (const Coordinates::Slope& link : coordinates.Slopes(p.data())) {
    now.natural_slope(link.parameter, link.coordinate) = link.value;
  }
  return now;
}

}  // namespace lyrefit
