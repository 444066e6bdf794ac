#include "lyrefit/devices/two_junction_model.h"

#include <algorithm>
#include <cmath>

namespace lyrefit {
namespace {

ModelShape ShapeOf(const TwoJunctionProblem& problem) {
  ModelShape shape;
  std::vector<int> readings;
  for (const TwoJunctionCurve& curve : problem.curves) {
    readings.push_back(static_cast<int>(curve.voltage_V.size()));
  }
  SetBlocks(readings, &shape);
  shape.current_scale_A = problem.current_scale_A;
  shape.voltage_scale_V = problem.voltage_scale_V;
  shape.thermal_voltage_V = problem.thermal_voltage_V;
  SetParameters(problem.parameters, problem.lower, problem.upper, &shape);
  return shape;
}

// Photocurrent of junction `j` before the share of its light.
double PhotocurrentAt(const TwoJunctionProblem& problem, int photocurrent, const double* p) {
  const bool excess = problem.ordered && photocurrent == JunctionPhotocurrent(1);
  return excess ? p[JunctionPhotocurrent(0)] * (1 + p[photocurrent]) : p[photocurrent];
}

}  // namespace

std::array<double, kTwoJunctionParameters> DeviceIn(const TwoJunctionProblem& problem, int curve,
                                                    const double* p) {
  std::array<double, kTwoJunctionParameters> device{};
  std::copy_n(p, kTwoJunctionParameters, device.begin());
  for (int j = 0; j < 2; ++j) {
    const JunctionLight& light = problem.curves[curve].light[j];
    device[JunctionPhotocurrent(j)] = light.share * PhotocurrentAt(problem, light.photocurrent, p);
  }
  return device;
}

std::array<double, kTwoJunctionParameters> JunctionsAtReference(const TwoJunctionProblem& problem,
                                                                const double* p) {
  std::array<double, kTwoJunctionParameters> device{};
  std::copy_n(p, kTwoJunctionParameters, device.begin());
  for (int j = 0; j < 2; ++j) {
    device[JunctionPhotocurrent(j)] = PhotocurrentAt(problem, JunctionPhotocurrent(j), p);
  }
  return device;
}

TwoJunctionModel::TwoJunctionModel(const TwoJunctionProblem& problem)
    : FitModel(ShapeOf(problem)), problem_(problem) {}

bool TwoJunctionModel::Evaluate(int block, const double* p, const double* /*local*/,
                                double* residuals, double* slopes, double* /*local_slopes*/) const {
  const TwoJunctionCurve& curve = problem_.curves[block];
  const int size = shape().size();
  const auto device = DeviceIn(problem_, block, p);
  const int points = static_cast<int>(curve.voltage_V.size());
  if (slopes != nullptr) std::fill_n(slopes, points * size, 0.0);
  double by_device[kTwoJunctionParameters];
  double start = kUnknown;
  for (int k = 0; k < points; ++k) {
    const double current =
        TwoJunctionCurrent(problem_.thermal_voltage_V, device.data(), curve.voltage_V[k],
                           slopes != nullptr ? by_device : nullptr, start);
    start = current;
    if (!std::isfinite(current)) return false;
    residuals[k] = current - curve.current_A[k];
    if (slopes == nullptr) continue;
    double* const row = slopes + static_cast<std::ptrdiff_t>(k) * size;
    for (int i = 0; i < kTwoJunctionParameters; ++i) row[i] = by_device[i];
    row[JunctionPhotocurrent(0)] = row[JunctionPhotocurrent(1)] = 0;
    for (int j = 0; j < 2; ++j) {
      const JunctionLight& light = curve.light[j];
      const double slope = light.share * by_device[JunctionPhotocurrent(j)];
      if (problem_.ordered && light.photocurrent == JunctionPhotocurrent(1)) {
        row[JunctionPhotocurrent(0)] += slope * (1 + p[light.photocurrent]);
        row[light.photocurrent] += slope * p[JunctionPhotocurrent(0)];
      } else {
        row[light.photocurrent] += slope;
      }
    }
  }
  return true;
}

}  // namespace lyrefit
