#include "lyrefit/certify/certify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/certify/attain.h"
#include "lyrefit/certify/beyond.h"
#include "lyrefit/certify/branch.h"
#include "lyrefit/curve/check_readings.h"

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
  double beyond = kInfinity;             // half sum of squares at larger Rs
  double rounding_A = 0;                 // RMSEs no further apart than this are equal
  std::vector<std::string> doubts = {};  // of the readings
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
  TRY(ValidateOptions(options, kCertifyOptionTable));
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

// The device takes the flattest diode there may be at face value.
Expected<void> CheckExponents(const Proof& proof) {
  const MixtureData& data = proof.data;
  const double voltage = (data.voltage_V + proof.limits.rs_lower * data.current_A).maxCoeff();
  const double exponent = voltage * proof.window.lower;
  if (exponent <= kLargestExponent) return {};
  return Fail(
      fmt::format("at n-upper = {:g} a diode's exponent is {:.3g} at {:.6g} V, beyond {:g}: "
                  "is the number of cells in series, {}, right?",
                  proof.options.n_upper, exponent, voltage, kLargestExponent,
                  proof.curve.conditions.cells_in_series),
      proof.curve.source);
}

Expected<void> Prepare(Proof* proof) {
  const IvCurve& curve = proof->curve;
  const CertifyOptions& options = proof->options;
  TRY(Validate(curve));
  TRY(proof->doubts, JudgeReadings(curve));
  TRY(CheckOptions(options));
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
  if (limits.rs_upper < options.rs_upper_ohm) proof->beyond = BoundBeyond(data, limits.rs_upper);
  proof->rounding_A = kCertifiedRounding * data.current_A.cwiseAbs().maxCoeff();
  return CheckExponents(*proof);
}

// Relative gap; an exact fit has none.
double Gap(const Proof& proof, double rmse, double lower) {
  return rmse > proof.rounding_A ? std::max(0.0, 1 - lower / rmse) : 0;
}

bool Certified(const Proof& proof, double rmse, double lower) {
  return rmse - lower <= std::max(kCertifiedGap * rmse, proof.rounding_A);
}

Floor FillFloor(const Proof& proof, const BranchEnd& end) {
  const Mixture& best = end.best;
  Floor floor;
  floor.rmse_A = proof.Rmse(best.primal);
  floor.lower_bound_A = std::min(proof.Rmse(end.lower), floor.rmse_A);
  floor.gap = Gap(proof, floor.rmse_A, floor.lower_bound_A);
  floor.certified = Certified(proof, floor.rmse_A, floor.lower_bound_A);
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

ModelCertificate CertifyModel(const Proof& proof, Model model, const BranchEnd& floor) {
  const CertifyOptions& options = proof.options;
  const BranchLimits& limits = proof.limits;
  const RefineProblem problem =
      ModelProblem(proof.curve, MakeDevice(model, proof.curve.conditions, options.constants),
                   {options.n_lower, options.n_upper, limits.rs_lower, limits.rs_upper,
                    proof.data.reference_voltage_V});
  const int diodes = DiodeCount(problem.device);
  Attained best;
  Attain(problem, proof.data, floor.best, &best);
  const auto half = [&] { return proof.Half(std::sqrt(best.mean_square)); };
  ModelCertificate certificate;
  certificate.model = model;
  double lower = floor.lower;
  const bool floor_proves = static_cast<int>(floor.best.atoms.size()) <= diodes ||
                            lower >= half() * (1 - 2 * limits.tolerance);
  if (!floor_proves) {
    const BranchEnd end = BranchOverDiodes(proof.data, proof.window, diodes, half(), limits);
    certificate.solved = end.solved;
    lower = std::max(lower, std::min(end.lower, proof.beyond));
    if (end.best.primal < half() * (1 - 1e-9)) Attain(problem, proof.data, end.best, &best);
  }
  certificate.parameters = best.p;
  certificate.rmse_A = std::sqrt(best.mean_square);
  certificate.lower_bound_A = std::min(proof.Rmse(lower), certificate.rmse_A);
  certificate.gap = Gap(proof, certificate.rmse_A, certificate.lower_bound_A);
  certificate.certified = Certified(proof, certificate.rmse_A, certificate.lower_bound_A);
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
  const Instant begin = Now();
  Proof proof{curve, options, observer, {}, {}, {}};
  TRY(Prepare(&proof));
  const char* stage = "floor";
  proof.limits.proceed = [&](std::int64_t solved, double best, double lower) {
    Progress progress{stage, solved, 0, solved, proof.Rmse(best), SecondsSince(begin)};
    progress.lower_bound = proof.Rmse(lower);
    if (StopRequested(observer, progress)) proof.stopped = true;
    return !proof.stopped;
  };

  Certificate certificate;
  certificate.version = Version();
  certificate.curve = curve;
  certificate.options = options;
  certificate.doubts = proof.doubts;
  certificate.rs_upper_ohm = proof.limits.rs_upper;
  certificate.reference_voltage_V = proof.data.reference_voltage_V;
  certificate.module_thermal_voltage_V = proof.thermal_voltage_V;
  AppendNonDefaults(options, kCertifyOptionTable, &certificate.non_default_options);
  BranchEnd floor = BranchOverResistance(proof.data, proof.window, proof.limits);
  floor.lower = std::min(floor.lower, proof.beyond);
  certificate.floor = FillFloor(proof, floor);
  for (const Model model : options.models) {
    if (proof.stopped) break;
    const std::string name = ToText(model);
    stage = name.c_str();
    certificate.models.push_back(CertifyModel(proof, model, floor));
    ModelCertificate& last = certificate.models.back();
    const double above = last.rmse_A - certificate.floor.rmse_A;
    last.above_floor = above > proof.rounding_A ? above / certificate.floor.rmse_A : 0;
  }
  certificate.interrupted = proof.stopped;
  certificate.seconds = SecondsSince(begin);
  return certificate;
}

}  // namespace lyrefit
