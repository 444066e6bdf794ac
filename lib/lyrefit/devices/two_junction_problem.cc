#include "lyrefit/devices/two_junction_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/key_points.h"

namespace lyrefit {
namespace {

int UncertainLights(const TwoJunctionProblem& problem, const TwoJunctionCurve& curve) {
  if (!(problem.light_sd > 0)) return 0;
  return (curve.light[0].uncertain ? 1 : 0) + (curve.light[1].uncertain ? 1 : 0);
}

// The lights' errors of a curve from its local unknowns.
LightErrors ErrorsOf(const TwoJunctionProblem& problem, const TwoJunctionCurve& curve,
                     const double* local) {
  LightErrors errors = {};
  if (UncertainLights(problem, curve) == 0) return errors;
  for (int j = 0; j < 2; ++j) errors[j] = curve.light[j].uncertain ? *local++ : 0;
  return errors;
}

ModelShape ShapeOf(const TwoJunctionProblem& problem) {
  ModelShape shape;
  std::vector<int> readings;
  for (const TwoJunctionCurve& curve : problem.curves) {
    readings.push_back(static_cast<int>(curve.voltage_V.size()));
  }
  SetBlocks(readings, &shape);
  for (std::size_t c = 0; c < problem.curves.size(); ++c) {
    const int unknown = UncertainLights(problem, problem.curves[c]);
    shape.blocks[c].locals = unknown;
    shape.blocks[c].residuals += unknown;
  }
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

std::vector<LightErrors> LightErrorsOf(const TwoJunctionProblem& problem,
                                       const std::vector<double>& local) {
  std::vector<LightErrors> errors;
  std::size_t next = 0;
  for (const TwoJunctionCurve& curve : problem.curves) {
    errors.push_back(ErrorsOf(problem, curve, local.data() + next));
    next += static_cast<std::size_t>(UncertainLights(problem, curve));
  }
  return errors;
}

std::array<double, kTwoJunctionParameters> DeviceIn(const TwoJunctionProblem& problem, int curve,
                                                    const double* p, const LightErrors& errors) {
  std::array<double, kTwoJunctionParameters> device{};
  std::copy_n(p, kTwoJunctionParameters, device.begin());
  for (int j = 0; j < 2; ++j) {
    const JunctionLight& light = problem.curves[curve].light[j];
    device[JunctionPhotocurrent(j)] =
        light.share * (1 + errors[j]) * PhotocurrentAt(problem, light.photocurrent, p);
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

bool TwoJunctionModel::Evaluate(int block, const double* p, const double* local, double* residuals,
                                double* slopes, double* local_slopes) const {
  const TwoJunctionCurve& curve = problem_.curves[block];
  const int size = shape().size(), locals = shape().blocks[block].locals;
  const LightErrors errors = ErrorsOf(problem_, curve, local);
  const auto device = DeviceIn(problem_, block, p, errors);
  const int points = static_cast<int>(curve.voltage_V.size());
  const bool sloped = slopes != nullptr || local_slopes != nullptr;
  if (slopes != nullptr) std::fill_n(slopes, shape().blocks[block].residuals * size, 0.0);
  for (int k = 0; k < locals; ++k) {
    residuals[points + k] = problem_.noise_A * local[k] / problem_.light_sd;
    if (local_slopes == nullptr) continue;
    local_slopes[(points + k) * locals + k] = problem_.noise_A / problem_.light_sd;
  }
  double by_device[kTwoJunctionParameters];
  double start = kUnknown;
  for (int k = 0; k < points; ++k) {
    const double current =
        TwoJunctionCurrent(problem_.thermal_voltage_V, device.data(), curve.voltage_V[k],
                           sloped ? by_device : nullptr, start);
    start = current;
    if (!std::isfinite(current)) return false;
    residuals[k] = current - curve.current_A[k];
    for (int j = 0, local_at = 0; j < 2 && local_slopes != nullptr && locals > 0; ++j) {
      if (!curve.light[j].uncertain) continue;
      const int i = JunctionPhotocurrent(j);
      local_slopes[k * locals + local_at++] = by_device[i] * device[i] / (1 + errors[j]);
    }
    if (slopes == nullptr) continue;
    double* const row = slopes + static_cast<std::ptrdiff_t>(k) * size;
    for (int i = 0; i < kTwoJunctionParameters; ++i) row[i] = by_device[i];
    row[JunctionPhotocurrent(0)] = row[JunctionPhotocurrent(1)] = 0;
    for (int j = 0; j < 2; ++j) {
      const JunctionLight& light = curve.light[j];
      const double slope = light.share * (1 + errors[j]) * by_device[JunctionPhotocurrent(j)];
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

namespace {

constexpr double kMostKelvinApart = 1;
constexpr double kLeastIdeality = 0.5;
constexpr double kMostIdeality = 6;
constexpr double kLeastSaturation = 1e-80;  // of the largest current
constexpr double kMostSaturation = 0.1;     // of the largest current
constexpr double kMostPhotocurrent = 3;     // of the largest short-circuit current at full light
constexpr double kMostExcess = 2;
constexpr double kMostSeries = 0.5;   // of Voc / Isc
constexpr double kLeastShunt = 0.05;  // of Voc / Isc
constexpr double kNear = 1e-12;       // relative difference of equal lights

bool Same(double a, double b) { return std::fabs(a - b) <= kNear * std::fabs(a); }

Expected<StatedLight> LightOf(const IvCurve& curve, const TwoJunctionOptions& options) {
  StatedLight light;
  light.top = curve.notes.light_top.value_or(kUnknown);
  light.bottom = curve.notes.light_bottom.value_or(kUnknown);
  const auto stated = options.lights.find(curve.name);
  if (stated != options.lights.end()) light = stated->second;
  for (const double share : {light.top, light.bottom}) {
    if (std::isnan(share) || (share >= 0 && std::isfinite(share))) continue;
    return Fail(
        fmt::format("curve {}: expected a light of at least 0, found {:g}", curve.name, share));
  }
  if (light.top == 0 && light.bottom == 0) {
    return Fail("curve " + curve.name + ": at least one junction must be lit");
  }
  return light;
}

Expected<void> CheckCurves(const CurveSet& set, const TwoJunctionOptions& options) {
  if (set.curves.empty()) return Fail("expected at least one curve");
  const double first_K = set.curves.front().conditions.cell_temperature_K;
  for (const IvCurve& curve : set.curves) {
    TRY(Validate(curve));
    const double kelvin = curve.conditions.cell_temperature_K;
    if (std::fabs(kelvin - first_K) > kMostKelvinApart) {
      return Fail(fmt::format(
          "two junctions are fitted to curves of one temperature: {} has "
          "{:.4g} C, {} has {:.4g} C",
          set.curves.front().name, first_K - kZeroCelsius_K, curve.name, kelvin - kZeroCelsius_K));
    }
  }
  for (const auto& [id, light] : options.lights) {
    const bool there = std::any_of(set.curves.begin(), set.curves.end(),
                                   [id = id](const IvCurve& curve) { return curve.name == id; });
    if (there) continue;
    std::string names;
    for (const IvCurve& curve : set.curves) names += (names.empty() ? "" : ", ") + curve.name;
    return Fail(fmt::format("light: there is no curve {}, expected one of {}", id, names));
  }
  return {};
}

Expected<void> AddCurves(const CurveSet& set, const TwoJunctionOptions& options,
                         PreparedTwoJunctions* prepared) {
  bool any = false;
  for (const IvCurve& curve : set.curves) {
    TRY(const StatedLight light, LightOf(curve, options));
    any = any || !std::isnan(light.top) || !std::isnan(light.bottom);
    prepared->light.push_back(light);
    const KeyPoints points = FindKeyPoints(curve.voltage_V, curve.current_A);
    if (!(points.short_circuit_current_A > 0)) {
      return Fail("curve " + curve.name +
                  ": two junctions are fitted to lit curves that pass short circuit");
    }
    prepared->isc_A.push_back(points.short_circuit_current_A);
    const double highest = *std::max_element(curve.voltage_V.begin(), curve.voltage_V.end());
    const double voc =
        std::isnan(points.open_circuit_voltage_V) ? highest : points.open_circuit_voltage_V;
    prepared->voc_V = std::max(prepared->voc_V, voc);
    prepared->problem.curves.push_back({curve.voltage_V, curve.current_A, {}});
    prepared->readings += static_cast<int>(curve.size());
  }
  // One curve is its own reference.
  if (!any || set.curves.size() == 1) prepared->light.front() = {1, 1};
  return {};
}

// Whether the exchange of both junctions leaves the curves as they are: the shares of their lights
// are in one ratio everywhere.
bool AreInterchangeable(const std::vector<StatedLight>& lights) {
  double ratio = kUnknown;
  for (const StatedLight& light : lights) {
    if (std::isnan(light.top) && std::isnan(light.bottom)) continue;
    const double own = light.bottom / light.top;
    if (!std::isfinite(own) || (!std::isnan(ratio) && !Same(own, ratio))) return false;
    ratio = own;
  }
  return true;
}

void AddParameter(ParameterInfo info, double lower, double upper, TwoJunctionProblem* problem) {
  problem->parameters.push_back(std::move(info));
  problem->lower.push_back(lower);
  problem->upper.push_back(upper);
}

// Largest short-circuit current of the curves that state the light of junction `j`, at full light.
double FullCurrent(const PreparedTwoJunctions& prepared, int j) {
  double largest = 0;
  for (std::size_t c = 0; c < prepared.light.size(); ++c) {
    const double share = j == 0 ? prepared.light[c].top : prepared.light[c].bottom;
    if (share > 0) largest = std::max(largest, prepared.isc_A[c] / share);
  }
  return largest;
}

Expected<void> AddShared(PreparedTwoJunctions* prepared) {
  TwoJunctionProblem* const problem = &prepared->problem;
  const double current = problem->current_scale_A;
  const double resistance = prepared->voc_V / current;
  const double infinite = kInfinity;
  const std::vector<ParameterInfo> infos = TwoJunctionInfos();
  for (int i = 0; i < kTwoJunctionParameters; ++i) {
    const ParameterInfo& info = infos[i];
    if (info.kind == ParameterKind::kPhotocurrent) {
      const int j = i == JunctionPhotocurrent(0) ? 0 : 1;
      if (problem->ordered && j == 1) {
        AddParameter({"x2", "photocurrent_excess_2", "",
                      "excess of the photocurrent of junction 2: Iph2 = Iph1 (1 + x2)",
                      ParameterKind::kPlain, 0.1},
                     0, kMostExcess, problem);
        continue;
      }
      const double full = FullCurrent(*prepared, j);
      if (!(full > 0)) {
        return Fail(
            fmt::format("no curve states the light of junction {}: state it for the curve "
                        "that is the reference, {}=1:1",
                        j + 1, "CURVE"));
      }
      AddParameter(info, 0, kMostPhotocurrent * full, problem);
    } else if (info.kind == ParameterKind::kSaturation) {
      AddParameter(info, kLeastSaturation * current, kMostSaturation * current, problem);
    } else if (info.kind == ParameterKind::kIdeality) {
      AddParameter(info, kLeastIdeality, kMostIdeality, problem);
    } else if (info.kind == ParameterKind::kShunt) {
      AddParameter(info, kLeastShunt * resistance, infinite, problem);
    } else {
      AddParameter(info, 0, kMostSeries * resistance, problem);
    }
  }
  return {};
}

// Positions of the photocurrents; those of unknown lights become parameters of their own.
void AddLights(const CurveSet& set, PreparedTwoJunctions* prepared) {
  TwoJunctionProblem* const problem = &prepared->problem;
  for (std::size_t c = 0; c < set.curves.size(); ++c) {
    for (int j = 0; j < 2; ++j) {
      const double share = j == 0 ? prepared->light[c].top : prepared->light[c].bottom;
      JunctionLight& light = problem->curves[c].light[j];
      light = {JunctionPhotocurrent(j), share, false};
      const bool reference = prepared->light[c].top == 1 && prepared->light[c].bottom == 1;
      light.uncertain = share > 0 && !reference;
      if (!std::isnan(share)) continue;
      light = {static_cast<int>(problem->parameters.size()), 1, false};
      ParameterInfo info = TwoJunctionInfos()[JunctionPhotocurrent(j)];
      const std::string& id = set.curves[c].name;
      info.symbol += "[" + id + "]";
      info.name += "[" + id + "]";
      info.doc += " in curve " + id;
      AddParameter(std::move(info), 0, kMostPhotocurrent * prepared->isc_A[c], problem);
    }
  }
}

Expected<int> IndexOf(const TwoJunctionProblem& problem, const std::string& name) {
  if (const auto found = FindParameter(problem.parameters, name)) return *found;
  std::string symbols;
  for (const ParameterInfo& info : problem.parameters) {
    symbols += (symbols.empty() ? "" : ", ") + info.symbol;
  }
  return Fail(fmt::format("the model has no parameter {}: expected one of {}", name, symbols));
}

Expected<void> ApplyRanges(const TwoJunctionOptions& options, TwoJunctionProblem* problem) {
  for (const auto& [name, range] : options.bounds) {
    TRY(const int i, IndexOf(*problem, name));
    if (!(range.first <= range.second) || !std::isfinite(range.first)) {
      return Fail(fmt::format("bound {}: expected LOWER:UPPER in order, found {:g}:{:g}", name,
                              range.first, range.second));
    }
    problem->lower[i] = range.first;
    problem->upper[i] = range.second;
  }
  for (const auto& [name, value] : options.fixed) {
    TRY(const int i, IndexOf(*problem, name));
    problem->lower[i] = problem->upper[i] = value;
  }
  for (std::size_t i = 0; i < problem->parameters.size(); ++i) {
    const ParameterInfo& info = problem->parameters[i];
    const bool positive = info.kind == ParameterKind::kSaturation ||
                          info.kind == ParameterKind::kIdeality ||
                          info.kind == ParameterKind::kShunt;
    if (positive ? problem->lower[i] > 0 : problem->lower[i] >= 0) continue;
    return Fail(fmt::format("{}: expected a value {}, found {:g}", info.symbol,
                            positive ? "above 0" : "of at least 0", problem->lower[i]));
  }
  return {};
}

}  // namespace

Expected<PreparedTwoJunctions> PrepareTwoJunctions(const CurveSet& set,
                                                   const TwoJunctionOptions& options) {
  TRY(CheckCurves(set, options));
  PreparedTwoJunctions prepared;
  TRY(AddCurves(set, options, &prepared));
  TwoJunctionProblem& problem = prepared.problem;
  problem.thermal_voltage_V =
      ThermalVoltage(set.curves.front().conditions.cell_temperature_K, options.constants);
  problem.current_scale_A = *std::max_element(prepared.isc_A.begin(), prepared.isc_A.end());
  problem.voltage_scale_V = 0.5 * prepared.voc_V;
  problem.ordered = AreInterchangeable(prepared.light);
  TRY(AddShared(&prepared));
  AddLights(set, &prepared);
  TRY(ApplyRanges(options, &problem));
  for (std::size_t i = 0; i < problem.parameters.size(); ++i) {
    prepared.free_parameters += problem.lower[i] < problem.upper[i] ? 1 : 0;
  }
  if (prepared.readings <= prepared.free_parameters) {
    return Fail(
        fmt::format("{} readings fix {} parameters without a remainder: measure more "
                    "points, or hold parameters with --fix",
                    prepared.readings, prepared.free_parameters));
  }
  return prepared;
}

}  // namespace lyrefit
