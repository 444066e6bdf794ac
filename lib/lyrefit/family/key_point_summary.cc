#include "lyrefit/family/refine_family.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/family/family_judge.h"
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
                                   const JudgedEnd& judged) {
  KeyPointSummary summary;
  summary.errors = options.key_point_errors;
  summary.found = judged.key_point_errors;
  summary.scale = judged.noise_A / refined.problem.key_point_scale_A;
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
  if (std::isnan(summary.reference_power_W))
    summary.reference_power_W = judged.reference.max_power_W;
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

namespace {

constexpr int kSteps = 4;          // on each side of the best device
constexpr double kWide = 1.0 / 3;  // of the ideality: interval over value
constexpr double kLowLight_W_m2 = 200;
constexpr double kHot_K = 348.15;

double PowerAt(const Translation& at, const std::vector<double>& shared, double irradiance_W_m2,
               double temperature_K) {
  const TranslatedDevice device = TranslateTo(at, shared, irradiance_W_m2, temperature_K);
  return ModelKeyPoints(device.device, device.parameters.data()).max_power_W;
}

// Position of the parameter that the curves determine least; -1: all are determined.
int LeastDetermined(const Translation& at, const std::vector<Estimate>& estimates) {
  const auto open = std::find_if(estimates.begin(), estimates.end(),
                                 [](const Estimate& e) { return e.free() && !e.identifiable; });
  const Estimate& n = estimates[at.n];
  const bool wide =
      n.free() && (!n.identifiable || !(n.high_95 - n.low_95 <= kWide * std::fabs(n.refined)));
  if (wide) return at.n;
  return open == estimates.end() ? -1 : static_cast<int>(open - estimates.begin());
}

// Values of the parameter from the best one towards the end of its range.
std::vector<double> Towards(double best, double end, SearchScale scale) {
  std::vector<double> values;
  for (int k = 1; k <= kSteps; ++k) {
    const double part = static_cast<double>(k) / kSteps;
    values.push_back(scale == SearchScale::kLog && best > 0 && end > 0
                         ? best * std::pow(end / best, part)
                         : best + part * (end - best));
  }
  return values;
}

}  // namespace

std::optional<EqualDevices> FindEqualDevices(const RefinedFamily& refined,
                                             const std::vector<Estimate>& estimates,
                                             const Observer& observer) {
  const FamilyProblem& family = refined.family;
  const Translation& at = family.translation;
  const int along = LeastDetermined(at, estimates);
  if (along < 0) return std::nullopt;
  const ProgressReporter progress(observer, "equal devices", 0);
  const double degrees = JointDegrees(refined.problem, family.free_parameters, 0);
  const double t = StudentT95(static_cast<int>(degrees));
  // Key points that the law passes through exactly still have their errors.
  const double scale_A = refined.problem.key_point_scale_A;
  const double variance = std::max(refined.end.squares / degrees, scale_A * scale_A);
  EqualDevices found;
  found.along = at.parameters[along].symbol;
  const auto add = [&](const JointEnd& end) {
    EqualDevice device;
    device.rise = std::max(end.squares - refined.end.squares, 0.0) / (t * t * variance);
    if (!(device.rise <= 1)) return false;
    std::vector<double> shared = end.point.shared;
    shared.resize(at.size());
    device.reference_power_W =
        PowerAt(at, shared, kReferenceIrradiance_W_m2, kReferenceTemperature_K);
    device.low_light_power_W = PowerAt(at, shared, kLowLight_W_m2, kReferenceTemperature_K);
    device.hot_power_W = PowerAt(at, shared, kReferenceIrradiance_W_m2, kHot_K);
    device.shared = std::move(shared);
    found.devices.push_back(std::move(device));
    return true;
  };
  add(refined.end);
  const ParameterBounds& bounds = family.bounds[along];
  const double best = refined.end.point.shared[along];
  JointOptions how;
  how.stop = progress.stop();
  for (const double end : {bounds.search_lower, bounds.search_upper}) {
    JointPoint start = refined.end.point;
    for (const double value : Towards(best, end, bounds.scale)) {
      JointProblem fixed = refined.problem;
      fixed.lower[along] = fixed.upper[along] = value;
      start.shared[along] = value;
      const JointEnd refit = RefineJointly(fixed, start, how);
      if (progress.Stopped()) return std::nullopt;
      if (!add(refit)) break;
      start = refit.point;
    }
  }
  std::sort(found.devices.begin(), found.devices.end(),
            [along](const EqualDevice& a, const EqualDevice& b) {
              return a.shared[along] < b.shared[along];
            });
  return found;
}

}  // namespace lyrefit
