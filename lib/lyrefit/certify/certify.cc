#include "lyrefit/certify/certify.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "lyrefit/base/version.h"
#include "lyrefit/certify/branch.h"
#include "lyrefit/refine/refine.h"
#include "lyrefit/refine/separable.h"

namespace lyrefit {
namespace {

// What every step of one proof needs.
struct Proof {
  const IvCurve& curve;
  const CertifyOptions& options;
  const Observer& observer;
  MixtureData data;
  Window window;
  BranchLimits limits;
  double thermal_voltage_V = 0;
  bool stopped = false;

  double Rmse(double half_sum_of_squares) const {
    return std::sqrt(2 * half_sum_of_squares / static_cast<double>(curve.size()));
  }
  double Half(double rmse) const { return 0.5 * static_cast<double>(curve.size()) * rmse * rmse; }
  double Ideality(double u) const { return 1 / (u * thermal_voltage_V); }
  double SaturationCurrent(const Atom& atom) const {
    return atom.current_A / std::expm1(atom.u * data.reference_voltage_V);
  }
};

Expected<void> CheckOptions(const CertifyOptions& options) {
  if (auto valid = ValidateOptions(options, kCertifyOptionTable); !valid) return valid;
  if (!(options.n_lower < options.n_upper)) {
    return Fail(fmt::format("n-lower = {:g} must be below n-upper = {:g}", options.n_lower,
                            options.n_upper));
  }
  if (options.rs_lower_ohm > options.rs_upper_ohm) {
    return Fail(fmt::format("rs-lower = {:g} is above rs-upper = {:g}", options.rs_lower_ohm,
                            options.rs_upper_ohm));
  }
  return {};
}

Expected<void> Prepare(Proof* proof) {
  const IvCurve& curve = proof->curve;
  const CertifyOptions& options = proof->options;
  if (auto valid = Validate(curve); !valid) return valid;
  if (auto valid = CheckOptions(options); !valid) return valid;
  const auto points = static_cast<Eigen::Index>(curve.size());
  MixtureData& data = proof->data;
  data.voltage_V = Eigen::Map<const Eigen::VectorXd>(curve.voltage_V.data(), points);
  data.current_A = Eigen::Map<const Eigen::VectorXd>(curve.current_A.data(), points);
  double largest_current = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    if (curve.current_A[k] < 0) continue;
    largest_current = std::max(largest_current, curve.current_A[k]);
    data.reference_voltage_V = std::max(data.reference_voltage_V, curve.voltage_V[k]);
  }
  if (!(data.reference_voltage_V > 0) || !(largest_current > 0)) {
    return Fail("no point delivers current at a forward voltage: a certificate needs a lit curve",
                curve.source);
  }
  proof->thermal_voltage_V = curve.conditions.ModuleThermalVoltage(options.constants);
  proof->window = {1 / (options.n_upper * proof->thermal_voltage_V),
                   1 / (options.n_lower * proof->thermal_voltage_V)};
  BranchLimits& limits = proof->limits;
  limits.rs_lower = options.rs_lower_ohm;
  limits.rs_upper = std::min(options.rs_upper_ohm, data.reference_voltage_V / largest_current);
  if (limits.rs_lower > limits.rs_upper) {
    return Fail(
        fmt::format("rs-lower = {:g} ohm is above {:g} ohm, the largest forward voltage "
                    "over the largest current",
                    limits.rs_lower, limits.rs_upper));
  }
  limits.tolerance = 2 * options.tolerance;  // of the sum of squares
  limits.most_solved = static_cast<int>(options.effort);
  return {};
}

double Gap(double value, double lower) { return value > 0 ? std::max(0.0, 1 - lower / value) : 0; }

Floor FillFloor(const Proof& proof, const BranchEnd& end) {
  const Mixture& best = end.best;
  Floor floor;
  floor.rmse_A = proof.Rmse(best.primal);
  floor.lower_bound_A = std::min(proof.Rmse(end.lower), floor.rmse_A);
  floor.gap = Gap(floor.rmse_A, floor.lower_bound_A);
  floor.photocurrent_A = best.photocurrent_A;
  floor.resistance_series_ohm = best.rs;
  floor.conductance_shunt_S = best.shunt_current_A / proof.data.reference_voltage_V;
  for (const Atom& atom : best.atoms) {  // rising u is falling n
    floor.diodes.push_back({proof.Ideality(atom.u), proof.SaturationCurrent(atom), atom.current_A});
  }
  floor.dual_A.assign(best.y.data(), best.y.data() + best.y.size());
  floor.duality_gap = best.relative_gap;
  floor.largest_correlation = best.y.norm() > 0 ? best.excess / best.y.norm() : 0;
  floor.solved = end.solved;
  return floor;
}

// The model's own least-squares problem within the ranges of the proof.
RefineProblem ModelProblem(const Proof& proof, Model model) {
  const IvCurve& curve = proof.curve;
  Device device = MakeDevice(model, curve.conditions, proof.options.constants);
  const double current = proof.data.current_A.cwiseAbs().maxCoeff();
  const double resistance = proof.data.reference_voltage_V / current;
  std::vector<double> lower(device.size(), 0), upper(device.size(), 10 * current);
  lower[kRs] = proof.limits.rs_lower;
  upper[kRs] = proof.limits.rs_upper;
  lower[kRsh] = 1e-6 * resistance;
  upper[kRsh] = 1e15 * resistance;
  for (int d = 0; d < DiodeCount(device); ++d) {
    lower[IdealityIndex(d)] = proof.options.n_lower;
    upper[IdealityIndex(d)] = proof.options.n_upper;
  }
  return MakeRefineProblem(std::move(device), Objective::kMeasuredCurrent, curve.voltage_V,
                           curve.current_A, {}, std::move(lower), std::move(upper));
}

// A mixture as parameters of a model: its strongest diodes.
std::vector<double> FromMixture(const Proof& proof, const RefineProblem& problem,
                                const Mixture& mixture) {
  std::vector<Atom> atoms = mixture.atoms;
  std::sort(atoms.begin(), atoms.end(),
            [](const Atom& a, const Atom& b) { return a.current_A > b.current_A; });
  std::vector<double> p(problem.device.size());
  p[kIph] = mixture.photocurrent_A;
  p[kRs] = mixture.rs;
  p[kRsh] = std::min(proof.data.reference_voltage_V / std::max(mixture.shunt_current_A, 1e-300),
                     problem.upper[kRsh]);
  for (int d = 0; d < DiodeCount(problem.device); ++d) {
    const bool there = d < static_cast<int>(atoms.size());
    p[SaturationCurrentIndex(d)] = there ? proof.SaturationCurrent(atoms[d]) : 0;
    const double n = there ? proof.Ideality(atoms[d].u) : problem.upper[IdealityIndex(d)];
    p[IdealityIndex(d)] =
        std::min(std::max(n, problem.lower[IdealityIndex(d)]), problem.upper[IdealityIndex(d)]);
  }
  return p;
}

// Polishes a mixture, and a few starts that owe nothing to it; keeps the better of `end` and what
// comes out.
void Improve(const Proof& proof, const RefineProblem& problem, const Mixture& mixture,
             RefineEnd* end) {
  constexpr int kGrid = 4;
  std::vector<std::vector<double>> starts = {FromMixture(proof, problem, mixture)};
  for (SeparableStart& start : SeparableStarts(problem, mixture.rs, kGrid)) {
    starts.push_back(std::move(start.p));
  }
  for (const std::vector<double>& start : starts) {
    const RefineEnd refined = Refine(problem, SeparableDescent(problem, start));
    if (end->p.empty() || refined.mean_square < end->mean_square) *end = refined;
    if (MeanSquare(problem, start) < end->mean_square) {
      end->p = start;
      end->mean_square = MeanSquare(problem, start);
    }
  }
}

ModelCertificate CertifyModel(const Proof& proof, Model model, const BranchEnd& floor) {
  const RefineProblem problem = ModelProblem(proof, model);
  RefineEnd best;
  Improve(proof, problem, floor.best, &best);
  ModelCertificate certificate;
  certificate.model = model;
  double lower = floor.lower;
  const bool floor_proves =
      lower >= proof.Half(std::sqrt(best.mean_square)) * (1 - 2 * proof.limits.tolerance);
  if (!floor_proves) {
    const BranchEnd end = BranchOverDiodes(proof.data, proof.window, DiodeCount(problem.device),
                                           proof.Half(std::sqrt(best.mean_square)), proof.limits);
    certificate.solved = end.solved;
    lower = std::max(lower, end.lower);
    if (end.best.primal < proof.Half(std::sqrt(best.mean_square)) * (1 - 1e-9)) {
      Improve(proof, problem, end.best, &best);
    }
  }
  certificate.parameters = best.p;
  certificate.rmse_A = std::sqrt(best.mean_square);
  certificate.lower_bound_A = std::min(proof.Rmse(lower), certificate.rmse_A);
  certificate.gap = Gap(certificate.rmse_A, certificate.lower_bound_A);
  certificate.certified = certificate.gap <= kCertifiedGap;
  return certificate;
}

}  // namespace

std::vector<double> DualCosines(const Certificate& certificate, const std::vector<double>& n) {
  const auto points = static_cast<Eigen::Index>(certificate.curve.size());
  const Eigen::Map<const Eigen::VectorXd> voltage(certificate.curve.voltage_V.data(), points);
  const Eigen::Map<const Eigen::VectorXd> current(certificate.curve.current_A.data(), points);
  const Eigen::Map<const Eigen::VectorXd> y(certificate.floor.dual_A.data(), points);
  const Eigen::VectorXd vd = voltage + certificate.floor.resistance_series_ohm * current;
  std::vector<double> cosines;
  for (const double ideality : n) {
    const Eigen::VectorXd column = DiodeColumn(
        vd, certificate.reference_voltage_V, 1 / (ideality * certificate.module_thermal_voltage_V));
    cosines.push_back(column.dot(y) / std::max(column.norm() * y.norm(), 1e-300));
  }
  return cosines;
}

Expected<Certificate> Certify(const IvCurve& curve, const CertifyOptions& options,
                              const Observer& observer) {
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  Proof proof{curve, options, observer, {}, {}, {}, 0, false};
  if (auto ready = Prepare(&proof); !ready) return tl::unexpected(ready.error());
  const char* stage = "floor";
  proof.limits.proceed = [&](std::int64_t solved, double best, double lower) {
    Progress progress{stage, solved, 0, solved, proof.Rmse(best), seconds()};
    progress.lower_bound = proof.Rmse(lower);
    if (StopRequested(observer, progress)) proof.stopped = true;
    return !proof.stopped;
  };

  Certificate certificate;
  certificate.version = Version();
  certificate.curve = curve;
  certificate.options = options;
  certificate.rs_upper_ohm = proof.limits.rs_upper;
  certificate.reference_voltage_V = proof.data.reference_voltage_V;
  certificate.module_thermal_voltage_V = proof.thermal_voltage_V;
  AppendNonDefaults(options, kCertifyOptionTable, &certificate.non_default_options);
  const BranchEnd floor = BranchOverResistance(proof.data, proof.window, proof.limits);
  certificate.floor = FillFloor(proof, floor);
  for (const Model model : options.models) {
    if (proof.stopped) break;
    const std::string name = ToText(model);
    stage = name.c_str();
    certificate.models.push_back(CertifyModel(proof, model, floor));
    ModelCertificate& last = certificate.models.back();
    last.above_floor = std::max(0.0, last.rmse_A / certificate.floor.rmse_A - 1);
  }
  certificate.interrupted = proof.stopped;
  certificate.seconds = seconds();
  return certificate;
}

}  // namespace lyrefit
