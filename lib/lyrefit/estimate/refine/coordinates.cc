#include "lyrefit/estimate/refine/coordinates.h"

#include <algorithm>
#include <cmath>

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

}  // namespace lyrefit
