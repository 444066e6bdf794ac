#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/family/family_judge.h"
#include "lyrefit/family/key_point_summary.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
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
