#include "lyrefit/certify/upper_bound.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/estimate/refine/refine.h"
#include "lyrefit/estimate/refine/separable.h"

namespace lyrefit {
namespace {

constexpr int kGridStarts = 4;

// The exponent of the steepest diode at the largest junction voltage.
double LargestExponent(const Device& device, const MixtureData& data,
                       const std::vector<double>& p) {
  const double voltage = data.JunctionVoltage(p[kRs]).maxCoeff();
  double largest = 0;
  for (int d = 0; d < DiodeCount(device); ++d) {
    if (p[SaturationCurrentIndex(d)] <= 0) continue;
    largest = std::max(largest, voltage / (p[IdealityIndex(d)] * device.module_thermal_voltage_V));
  }
  return largest;
}

// The mean square of Shockley's equation without a clipped exponent.
double UncutMeanSquare(const RefineProblem& problem, const MixtureData& data,
                       const std::vector<double>& p) {
  const Mixture mixture = AsMixture(problem.device, data, p);
  const bool solved = problem.objective == Objective::kSolvedCurrent;
  const Eigen::VectorXd residual =
      solved ? data.weight.cwiseProduct(data.target_A - SolvedCurrents(data, mixture)) : mixture.y;
  return residual.squaredNorm() / static_cast<double>(residual.size());
}

std::vector<double> WithinBox(const RefineProblem& problem, std::vector<double> p) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    p[i] = std::min(std::max(p[i], problem.lower[i]), problem.upper[i]);
  }
  return p;
}

DiodeRanges RangesOf(const ModelRanges& ranges, int diode) {
  if (ranges.diodes.empty()) return {ranges.n_lower, ranges.n_upper};
  return ranges.diodes[static_cast<std::size_t>(diode)];
}

// Parameters of a mixture that is a model within the ranges; otherwise empty.
std::vector<double> AsModel(const RefineProblem& problem, const ModelRanges& ranges,
                            const Mixture& mixture) {
  const double vt = problem.device.module_thermal_voltage_V;
  std::vector<Window> box;
  for (int d = 0; d < DiodeCount(problem.device); ++d) {
    const DiodeRanges diode = RangesOf(ranges, d);
    box.push_back(
        {1 / (diode.n_upper * vt), 1 / (diode.n_lower * vt), diode.is_lower_A, diode.is_upper_A});
  }
  const auto diodes = AsDiodes(mixture, box);
  if (!diodes) return {};
  std::vector<double> p(problem.device.size());
  p[kIph] = mixture.linear[kPhotocurrentTerm];
  p[kRs] = mixture.rs;
  p[kRsh] = 1 / std::max(mixture.linear[kShuntTerm], 1e-300);
  p = WithinBox(problem, p);
  for (std::size_t d = 0; d < box.size(); ++d) {
    const int i = static_cast<int>(d);
    const DiodeRanges diode = RangesOf(ranges, i);
    p[SaturationCurrentIndex(i)] =
        std::min(std::max((*diodes)[d].saturation_A, diode.is_lower_A), diode.is_upper_A);
    p[IdealityIndex(i)] =
        std::min(std::max(1 / ((*diodes)[d].u * vt), diode.n_lower), diode.n_upper);
  }
  return p;
}

// Parameters of a model from the `most` strongest diodes of a mixture. The model's other diodes get
// the smallest Is and the largest n allowed.
std::vector<double> FromMixture(const RefineProblem& problem, const MixtureData& data,
                                const Mixture& mixture, int most) {
  std::vector<Atom> atoms = mixture.atoms;
  std::sort(atoms.begin(), atoms.end(),
            [](const Atom& a, const Atom& b) { return a.current_A > b.current_A; });
  const double reference = data.reference_voltage_V;
  std::vector<double> p(problem.device.size());
  p[kIph] = mixture.linear[kPhotocurrentTerm];
  p[kRs] = mixture.rs;
  p[kRsh] = 1 / std::max(mixture.linear[kShuntTerm], 1e-300);
  for (int d = 0; d < DiodeCount(problem.device); ++d) {
    const int n = IdealityIndex(d);
    p[n] = problem.upper[n];
    if (d >= std::min(most, static_cast<int>(atoms.size()))) continue;
    p[SaturationCurrentIndex(d)] = atoms[d].current_A / std::expm1(atoms[d].u * reference);
    p[n] = 1 / (atoms[d].u * problem.device.module_thermal_voltage_V);
  }
  return WithinBox(problem, p);
}

// A start without diodes and shunt.
std::vector<double> ConstantCurrent(const RefineProblem& problem, const MixtureData& data) {
  std::vector<double> p(problem.device.size(), 0);
  p[kIph] = std::max(data.current_A.mean(), 0.0);
  p[kRs] = problem.lower[kRs];
  p[kRsh] = problem.upper[kRsh];
  for (int d = 0; d < DiodeCount(problem.device); ++d) {
    p[IdealityIndex(d)] = problem.upper[IdealityIndex(d)];
  }
  return WithinBox(problem, p);
}

}  // namespace

Mixture AsMixture(const Device& device, const MixtureData& data, const std::vector<double>& p) {
  Mixture mixture;
  mixture.rs = p[kRs];
  mixture.reference_voltage_V = data.reference_voltage_V;
  mixture.linear = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(data.terms.size()));
  mixture.linear[kPhotocurrentTerm] = p[kIph];
  mixture.linear[kShuntTerm] = 1 / p[kRsh];
  const Eigen::VectorXd vd = data.JunctionVoltage(p[kRs]);
  mixture.scale_voltage_V = vd.maxCoeff();
  mixture.y = data.target_A.array() - p[kIph] + vd.array() / p[kRsh];
  for (int d = 0; d < DiodeCount(device); ++d) {
    const double saturation = p[SaturationCurrentIndex(d)];
    if (!(saturation > 0)) continue;
    const double u = 1 / (p[IdealityIndex(d)] * device.module_thermal_voltage_V);
    mixture.y.array() += (vd.array() * u + std::log(saturation)).exp() - saturation;
    const double most = std::exp(u * data.reference_voltage_V + std::log(saturation));
    mixture.atoms.push_back({u, most - saturation});
  }
  std::sort(mixture.atoms.begin(), mixture.atoms.end(),
            [](const Atom& a, const Atom& b) { return a.u < b.u; });
  mixture.y = data.weight.cwiseProduct(mixture.y);
  mixture.primal = 0.5 * mixture.y.squaredNorm();
  return mixture;
}

RefineProblem ModelProblem(const IvCurve& curve, Device device, const ModelRanges& ranges,
                           Objective objective) {
  double current = 0;
  for (const double i : curve.current_A) current = std::max(current, std::fabs(i));
  const double resistance = ranges.reference_voltage_V / current;
  const double steepest =
      ranges.reference_voltage_V / (kLargestExponent * device.module_thermal_voltage_V);
  std::vector<double> lower(device.size(), 0), upper(device.size(), 10 * current);
  lower[kRs] = ranges.rs_lower;
  upper[kRs] = ranges.rs_upper;
  lower[kIph] = ranges.iph_lower_A;
  upper[kIph] = std::min(ranges.iph_upper_A, std::max(upper[kIph], 2 * ranges.iph_lower_A));
  upper[kRsh] = std::min(1e15 * resistance, ranges.rsh_upper_ohm);
  upper[kRsh] = std::max(upper[kRsh], ranges.rsh_lower_ohm);
  lower[kRsh] =
      ranges.rsh_lower_ohm > 0 ? ranges.rsh_lower_ohm : std::min(1e-6 * resistance, upper[kRsh]);
  for (int d = 0; d < DiodeCount(device); ++d) {
    const DiodeRanges diode = RangesOf(ranges, d);
    const int is = SaturationCurrentIndex(d), n = IdealityIndex(d);
    lower[is] = diode.is_lower_A;
    upper[is] = std::min(diode.is_upper_A, std::max(upper[is], 2 * diode.is_lower_A));
    lower[n] = std::min(std::max(diode.n_lower, steepest), diode.n_upper);
    upper[n] = diode.n_upper;
  }
  return MakeRefineProblem(std::move(device), objective, curve.voltage_V, curve.current_A, {},
                           std::move(lower), std::move(upper));
}

void FindUpperBound(const RefineProblem& problem, const ModelRanges& ranges,
                    const MixtureData& data, const Mixture& mixture, UpperBound* best) {
  const auto consider = [&](const std::vector<double>& p) {
    const bool cut = LargestExponent(problem.device, data, p) > kLargestExponent;
    const double mean_square = cut ? UncutMeanSquare(problem, data, p) : MeanSquare(problem, p);
    if (mean_square < best->mean_square) *best = {p, mean_square};
  };
  // Only the measured-current residual is linear in currents and conductance.
  const bool solved = problem.objective == Objective::kSolvedCurrent;
  RefineProblem linear = problem;
  linear.objective = Objective::kMeasuredCurrent;
  consider(ConstantCurrent(problem, data));
  const std::vector<double> model = AsModel(problem, ranges, mixture);
  if (!model.empty()) consider(model);
  std::vector<std::vector<double>> starts;
  for (int most = DiodeCount(problem.device); most > 0; --most) {
    starts.push_back(FromMixture(problem, data, mixture, most));
    // Starts with fewer diodes differ only if the remaining Is may not be 0.
    if (problem.lower[SaturationCurrentIndex(most - 1)] == 0) break;
  }
  for (SeparableStart& start : SeparableStarts(linear, mixture.rs, kGridStarts)) {
    starts.push_back(std::move(start.p));
  }
  for (const std::vector<double>& start : starts) {
    consider(start);
    if (solved) consider(WithinBox(problem, Refine(problem, start).p));
    consider(WithinBox(problem, Refine(problem, SeparableDescent(linear, start)).p));
  }
}

}  // namespace lyrefit
