#include "lyrefit/family/key_point_summary.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lyrefit/family/family_model.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

constexpr double kSameLight_W_m2 = 20;
constexpr double kSameTemperature_C = 1;

// Root mean square of what `part` gives, over the finite values.
template <class Part>
double RmsOver(const std::vector<FamilyCurve>& rows, const Part& part) {
  double squares = 0, count = 0;
  for (const FamilyCurve& row : rows) {
    if (!row.key_points || row.role != CurveRole::kFitted) continue;
    const double one = part(*row.key_points);
    if (!std::isfinite(one)) continue;
    squares += one * one;
    ++count;
  }
  return count > 0 ? std::sqrt(squares / count) : kUnknown;
}

// Pmp as measured nearest to the reference conditions, or NaN.
double MeasuredReferencePower(const std::vector<FamilyCurve>& rows) {
  double power_W = kUnknown, nearest = 1;
  for (const FamilyCurve& row : rows) {
    if (!row.key_points || std::isnan(row.key_points->measured.max_power_W)) continue;
    const double off =
        std::max(std::fabs(row.irradiance_W_m2 - kReferenceIrradiance_W_m2) / kSameLight_W_m2,
                 std::fabs(row.temperature_C - kReferenceTemperature_C) / kSameTemperature_C);
    if (!(off < nearest)) continue;
    nearest = off;
    power_W = row.key_points->measured.max_power_W;
  }
  return power_W;
}

}  // namespace

double KeyPointRms(const JointProblem& problem, const JointPoint& point) {
  const FamilyModel model(problem);
  const FitPoint at = model.Pack(point);
  const double* local = at.local.data();
  double squares = 0, count = 0;
  for (std::size_t c = 0; c < problem.curves.size(); ++c) {
    const FitBlock& block = model.shape().blocks[c];
    std::vector<double> residuals(block.residuals);
    const bool evaluated =
        model.Evaluate(static_cast<int>(c), at.p.data(), local, residuals.data(), nullptr, nullptr);
    if (!evaluated) return kUnknown;
    for (int k = 0; k < problem.curves[c].residuals(); ++k) squares += residuals[k] * residuals[k];
    count += problem.curves[c].residuals();
    local += block.locals;
  }
  return std::sqrt(squares / count) / problem.key_point_scale_A;
}

std::vector<FamilyCurve> WithKeyPoints(std::vector<FamilyCurve> rows, const RefinedFamily& refined,
                                       const std::vector<double>& shared,
                                       const FamilyTests& tests) {
  const FamilyMembers& members = refined.family.curves;
  for (std::size_t c = 0; c < rows.size(); ++c) {
    const FamilyMember& member = members.members[c];
    if (member.role == CurveRole::kLeftOut || !member.joint.key_points) continue;
    KeyPointFit fit;
    const auto& value = member.joint.key_points->value;
    fit.measured.short_circuit_current_A = value[kIscRow];
    fit.measured.open_circuit_voltage_V = value[kVocRow];
    fit.measured.max_power_voltage_V = value[kVmpRow];
    fit.measured.max_power_W = value[kPmpRow];
    fit.measured.max_power_current_A = value[kPmpRow] / value[kVmpRow];
    fit.measured.fill_factor = value[kPmpRow] / (value[kIscRow] * value[kVocRow]);
    const auto at = std::find(members.fitted.begin(), members.fitted.end(), static_cast<int>(c));
    TrueConditions conditions{member.joint.irradiance_W_m2, member.joint.temperature_K};
    if (at != members.fitted.end()) {
      conditions = ConditionsAt(refined.problem, refined.end.point,
                                static_cast<int>(at - members.fitted.begin()));
    }
    const TranslatedDevice device = TranslateTo(
        refined.problem.translation, shared, conditions.irradiance_W_m2, conditions.temperature_K);
    fit.model = ModelKeyPoints(device.device, device.parameters.data());
    rows[c].key_points = fit;
  }
  for (const auto& [c, power_W] : tests.held_out_power_W) {
    if (rows[c].key_points) rows[c].key_points->held_out_power_W = power_W;
  }
  return rows;
}

KeyPointSummary SummariseKeyPoints(const std::vector<FamilyCurve>& rows,
                                   const RefinedFamily& refined, const FamilyOptions& options,
                                   double noise_A, const KeyPoints& reference) {
  KeyPointSummary summary;
  summary.errors = options.key_point_errors;
  summary.scale = noise_A / refined.problem.key_point_scale_A;
  const auto relative = [&](double KeyPoints::*point) {
    return RmsOver(rows, [point](const KeyPointFit& fit) {
      return fit.model.*point / fit.measured.*point - 1;
    });
  };
  summary.short_circuit_current = relative(&KeyPoints::short_circuit_current_A);
  summary.open_circuit_voltage = relative(&KeyPoints::open_circuit_voltage_V);
  summary.max_power_current = relative(&KeyPoints::max_power_current_A);
  summary.max_power_voltage = relative(&KeyPoints::max_power_voltage_V);
  summary.max_power = relative(&KeyPoints::max_power_W);
  summary.reference_power_W = MeasuredReferencePower(rows);
  if (std::isnan(summary.reference_power_W)) summary.reference_power_W = reference.max_power_W;
  summary.max_power_of_reference = RmsOver(rows, [&](const KeyPointFit& fit) {
    return (fit.model.max_power_W - fit.measured.max_power_W) / summary.reference_power_W;
  });
  double squares = 0;
  for (const FamilyCurve& row : rows) {
    if (!row.key_points) continue;
    const Interval& predicted = row.key_points->held_out_power_W;
    const double measured = row.key_points->measured.max_power_W;
    if (!std::isfinite(predicted.value) || !std::isfinite(measured)) continue;
    const double off = (predicted.value - measured) / summary.reference_power_W;
    squares += off * off;
    ++summary.held_out;
    summary.covered += measured >= predicted.low_95 && measured <= predicted.high_95 ? 1 : 0;
  }
  if (summary.held_out > 0) {
    summary.held_out_max_power_of_reference = std::sqrt(squares / summary.held_out);
  }
  return summary;
}

}  // namespace lyrefit
