#include "lyrefit/certify/attain.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/refine/refine.h"
#include "lyrefit/refine/separable.h"

namespace lyrefit {
namespace {

constexpr int kGridStarts = 4;

// The steepest diode's exponent at the largest junction voltage.
double LargestExponent(const Device& device, const MixtureData& data,
                       const std::vector<double>& p) {
  const double voltage = (data.voltage_V + p[kRs] * data.current_A).maxCoeff();
  double largest = 0;
  for (int d = 0; d < DiodeCount(device); ++d) {
    if (p[SaturationCurrentIndex(d)] <= 0) continue;
    largest = std::max(largest, voltage / (p[IdealityIndex(d)] * device.module_thermal_voltage_V));
  }
  return largest;
}

// A mixture as parameters of a model: its strongest diodes.
std::vector<double> FromMixture(const RefineProblem& problem, const MixtureData& data,
                                const Mixture& mixture) {
  std::vector<Atom> atoms = mixture.atoms;
  std::sort(atoms.begin(), atoms.end(),
            [](const Atom& a, const Atom& b) { return a.current_A > b.current_A; });
  const double reference = data.reference_voltage_V;
  std::vector<double> p(problem.device.size());
  p[kIph] = mixture.photocurrent_A;
  p[kRs] = mixture.rs;
  p[kRsh] = std::min(reference / std::max(mixture.shunt_current_A, 1e-300), problem.upper[kRsh]);
  for (int d = 0; d < DiodeCount(problem.device); ++d) {
    const int n = IdealityIndex(d);
    p[n] = problem.upper[n];
    if (d >= static_cast<int>(atoms.size())) continue;
    p[SaturationCurrentIndex(d)] = atoms[d].current_A / std::expm1(atoms[d].u * reference);
    p[n] = std::min(
        std::max(1 / (atoms[d].u * problem.device.module_thermal_voltage_V), problem.lower[n]),
        problem.upper[n]);
  }
  return p;
}

// No diode and no shunt.
std::vector<double> ConstantCurrent(const RefineProblem& problem, const MixtureData& data) {
  std::vector<double> p(problem.device.size(), 0);
  p[kIph] = std::max(data.current_A.mean(), 0.0);
  p[kRs] = problem.lower[kRs];
  p[kRsh] = problem.upper[kRsh];
  for (int d = 0; d < DiodeCount(problem.device); ++d) {
    p[IdealityIndex(d)] = problem.upper[IdealityIndex(d)];
  }
  return p;
}

}  // namespace

RefineProblem ModelProblem(const IvCurve& curve, Device device, const ModelRanges& ranges) {
  double current = 0;
  for (const double i : curve.current_A) current = std::max(current, std::fabs(i));
  const double resistance = ranges.reference_voltage_V / current;
  const double steepest =
      ranges.reference_voltage_V / (kLargestExponent * device.module_thermal_voltage_V);
  std::vector<double> lower(device.size(), 0), upper(device.size(), 10 * current);
  lower[kRs] = ranges.rs_lower;
  upper[kRs] = ranges.rs_upper;
  lower[kRsh] = 1e-6 * resistance;
  upper[kRsh] = 1e15 * resistance;
  for (int d = 0; d < DiodeCount(device); ++d) {
    lower[IdealityIndex(d)] = std::min(std::max(ranges.n_lower, steepest), ranges.n_upper);
    upper[IdealityIndex(d)] = ranges.n_upper;
  }
  return MakeRefineProblem(std::move(device), Objective::kMeasuredCurrent, curve.voltage_V,
                           curve.current_A, {}, std::move(lower), std::move(upper));
}

void Attain(const RefineProblem& problem, const MixtureData& data, const Mixture& mixture,
            Attained* best) {
  const auto consider = [&](const std::vector<double>& p) {
    if (LargestExponent(problem.device, data, p) > kLargestExponent) return;
    const double mean_square = MeanSquare(problem, p);
    if (mean_square < best->mean_square) *best = {p, mean_square};
  };
  consider(ConstantCurrent(problem, data));
  std::vector<std::vector<double>> starts = {FromMixture(problem, data, mixture)};
  for (SeparableStart& start : SeparableStarts(problem, mixture.rs, kGridStarts)) {
    starts.push_back(std::move(start.p));
  }
  for (const std::vector<double>& start : starts) {
    consider(start);
    consider(Refine(problem, SeparableDescent(problem, start)).p);
  }
}

}  // namespace lyrefit
