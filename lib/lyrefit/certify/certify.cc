#include "lyrefit/certify/certify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/certify/box.h"
#include "lyrefit/certify/branch.h"
#include "lyrefit/certify/mixture.h"
#include "lyrefit/certify/relaxation.h"
#include "lyrefit/certify/solved_relaxation.h"
#include "lyrefit/certify/upper_bound.h"
#include "lyrefit/curve/beyond_voc.h"
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/estimate/fit/polish.h"

namespace lyrefit {
namespace {

// A range of Rs without an end is divided up to this multiple of the largest forward voltage over
// the largest current. The number of parts needed grows with Rs.
constexpr double kMostDivided = 4;

// State shared by all steps of one proof.
struct Proof {
  const IvCurve& curve;
  const CertifyOptions& options;
  const ProgressReporter progress;
  MixtureData data;
  Window window;
  BranchLimits limits;
  double thermal_voltage_V = 0;
  double rs_reached = 0;                  // largest Rs that a search reached
  std::vector<Mixture> upper_bound = {};  // lowest mixtures of the floor and of every model so far
  double rounding_A = 0;                  // RMSEs no further apart than this are equal
  std::vector<std::string> doubts = {};   // about the readings

  double Rmse(double half_sum_of_squares) const {
    return std::sqrt(2 * half_sum_of_squares / static_cast<double>(curve.size()));
  }
  // RMSE of a lower bound, rounded down if the proof is rigorous.
  double RmseBelow(double half_sum_of_squares) const {
    return options.rigorous ? SafeRmse(half_sum_of_squares, curve.size())
                            : Rmse(half_sum_of_squares);
  }
  double Half(double rmse) const { return 0.5 * static_cast<double>(curve.size()) * rmse * rmse; }
  double Ideality(double u) const { return 1 / (u * thermal_voltage_V); }
  double SaturationCurrent(const Atom& atom) const {
    return atom.current_A / std::expm1(atom.u * data.reference_voltage_V);
  }
  WideInterval ThermalVoltage() const {
    return SafeThermalVoltage(curve.conditions, options.constants);
  }
  std::vector<Window> BoxOfModel(int diodes) const {
    return BoxOf(options, diodes, thermal_voltage_V, ThermalVoltage());
  }
};

bool IsSolvedCurrent(const Proof& proof) {
  return proof.options.objective == Objective::kSolvedCurrent;
}

// Bounds models of `diodes` diodes, or of any number of them (0). `primal` is a half sum of squares
// known to be reached.
BranchEnd RunBranch(const BranchLimits& limits, int diodes, double primal, Proof* proof) {
  const std::vector<Window> box = proof->BoxOfModel(diodes);
  const SolvedRelaxation solved(proof->data);
  const MeasuredRelaxation measured(proof->data, limits.rigorous);
  const Relaxation& relaxation =
      IsSolvedCurrent(*proof) ? static_cast<const Relaxation&>(solved) : measured;
  BranchEnd end = diodes == 0 ? BranchOver(relaxation, proof->window, 0, primal, limits)
                              : BranchOver(relaxation, box, primal, limits);
  proof->rs_reached = std::max(proof->rs_reached, end.rs_reached);
  return end;
}

Expected<void> CheckOptions(const CertifyOptions& options) {
  TRY(ValidateOptions(options, kCertifyOptionTable));
  TRY(CheckRanges(options));
  if (options.rigorous && options.objective == Objective::kSolvedCurrent) {
    return Fail("rigorous bounds are of the measured-current objective only");
  }
  return {};
}

// Error if even the exponent of the flattest diode is so large that the device would clip it.
Expected<void> CheckExponents(const Proof& proof) {
  const MixtureData& data = proof.data;
  const double voltage = data.JunctionVoltage(proof.limits.rs_lower).maxCoeff();
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
  TRY(proof->doubts, JudgeReadings(curve));
  proof->data = CurveData(curve.voltage_V, curve.current_A);
  SetRanges(options, &proof->data);
  const MixtureData& data = proof->data;
  const double largest_current = data.current_A.maxCoeff();
  if (!(data.reference_voltage_V > 0) || !(largest_current > 0)) {
    return Fail("no point delivers current at a forward voltage: a certificate needs a lit curve",
                curve.source);
  }
  proof->thermal_voltage_V = curve.conditions.ModuleThermalVoltage(options.constants);
  proof->window = AnyDiode(options, proof->thermal_voltage_V, proof->ThermalVoltage());
  BranchLimits& limits = proof->limits;
  limits.rs_lower = options.rs_lower_ohm;
  limits.rs_upper = options.rs_upper_ohm;
  limits.rs_cut = data.reference_voltage_V / largest_current;
  if (!std::isfinite(limits.rs_upper)) limits.rs_divided = kMostDivided * limits.rs_cut;
  if (limits.rs_lower > limits.rs_cut) {
    return Fail(
        fmt::format("rs-lower = {:g} ohm is above {:g} ohm, the largest forward voltage "
                    "over the largest current",
                    limits.rs_lower, limits.rs_cut));
  }
  limits.tolerance = 2 * options.tolerance;  // of the sum of squares
  limits.rigorous = options.rigorous;
  limits.most_solved = static_cast<int>(options.effort);
  proof->rounding_A = kCertifiedRounding * data.current_A.cwiseAbs().maxCoeff();
  return CheckExponents(*proof);
}

// Relative gap; 0 for an exact fit, up to rounding.
double Gap(const Proof& proof, double rmse, double lower) {
  if (proof.options.rigorous) return SafeGap(rmse, lower);
  return rmse > proof.rounding_A ? std::max(0.0, 1 - lower / rmse) : 0;
}

bool Certified(const Proof& proof, double rmse, double lower) {
  return rmse - lower <= std::max(kCertifiedGap * rmse, proof.rounding_A);
}

// Upper bound of the floor's RMSE from its stated parameters, in intervals.
double SafeFloorRmse(const Proof& proof, const Floor& floor) {
  std::vector<SafeDiode> diodes;
  for (const FloorDiode& diode : floor.diodes) {
    diodes.push_back({diode.n, diode.saturation_current_A});
  }
  return SafeUpperRmse(proof.curve, proof.ThermalVoltage(), floor.photocurrent_A,
                       floor.resistance_series_ohm, WideInterval(floor.conductance_shunt_S),
                       diodes);
}

double SafeModelRmse(const Proof& proof, int diode_count, const std::vector<double>& p) {
  std::vector<SafeDiode> diodes;
  diodes.reserve(static_cast<std::size_t>(diode_count));
  for (int d = 0; d < diode_count; ++d) {
    diodes.push_back({p[IdealityIndex(d)], p[SaturationCurrentIndex(d)]});
  }
  return SafeUpperRmse(proof.curve, proof.ThermalVoltage(), p[kIph], p[kRs],
                       WideInterval(1) / WideInterval(p[kRsh]), diodes);
}

// The dual vector at the floor's Rs and the junction voltages of its columns. For the
// solved-current objective they belong to the problem linearised around the solved currents,
// otherwise to the measured currents.
std::pair<Eigen::VectorXd, Eigen::VectorXd> FloorDual(const Proof& proof, const Mixture& best) {
  if (!IsSolvedCurrent(proof)) return {best.y, proof.data.JunctionVoltage(best.rs)};
  const Eigen::VectorXd solved = SolvedCurrents(proof.data, best);
  const Eigen::VectorXd vd = proof.data.voltage_V + best.rs * solved;
  const MixtureLaw law(proof.data, best);
  Eigen::VectorXd dual = proof.data.target_A - solved;
  for (Eigen::Index k = 0; k < dual.size(); ++k) dual[k] /= 1 + best.rs * law.Slope(vd[k]);
  return {dual, vd};
}

// A model may be lower than the search of an unfinished floor. Replaces the floor's mixture by the
// best mixture at the Rs of such a model.
void TakeBest(const Proof& proof, BranchEnd* floor) {
  for (const Mixture& model : proof.upper_bound) {
    if (!(model.primal < floor->best.primal * (1 - kCertifiedGap))) continue;
    const double tolerance = 0.01 * proof.limits.tolerance;
    const double dark_bound_A = 1e3 * proof.data.target_A.cwiseAbs().maxCoeff();
    Mixture here = model;
    if (IsSolvedCurrent(proof)) {
      const SolvedMixture solved =
          SolveSolvedMixture(proof.data, {proof.window}, model.rs, model.atoms, tolerance);
      here.y = solved.mixture.y;
      here.excess = solved.mixture.excess;
      here.relative_gap = std::fabs(model.primal - solved.mixture.dual) / model.primal;
      if (solved.value < model.primal) {
        here = solved.mixture;
        here.primal = solved.value;
      }
    } else {
      here =
          SolveMixture(proof.data, {proof.window}, model.rs, model.atoms, tolerance, dark_bound_A);
    }
    if (here.primal < floor->best.primal) floor->best = here;
  }
}

Floor FillFloor(const Proof& proof, const BranchEnd& end) {
  const Mixture& best = end.best;
  Floor floor;
  floor.photocurrent_A = best.linear[kPhotocurrentTerm];
  floor.resistance_series_ohm = best.rs;
  floor.conductance_shunt_S = best.linear[kShuntTerm];
  for (const Atom& atom : best.atoms) {  // rising u is falling n
    double n = proof.Ideality(atom.u);
    if (proof.options.rigorous) {  // the windows of u are slightly wider
      n = std::min(std::max(n, proof.options.n_lower), proof.options.n_upper);
    }
    floor.diodes.push_back({n, proof.SaturationCurrent(atom), atom.current_A});
  }
  floor.rmse_A = proof.options.rigorous ? SafeFloorRmse(proof, floor) : proof.Rmse(best.primal);
  floor.lower_bound_A = std::min(proof.RmseBelow(end.lower), floor.rmse_A);
  floor.gap = Gap(proof, floor.rmse_A, floor.lower_bound_A);
  floor.certified = Certified(proof, floor.rmse_A, floor.lower_bound_A);
  const auto [dual, junction_voltage] = FloorDual(proof, best);
  floor.dual_A.assign(dual.begin(), dual.end());
  floor.junction_voltage_V.assign(junction_voltage.begin(), junction_voltage.end());
  floor.duality_gap = best.relative_gap;
  floor.largest_correlation = best.y.norm() > 0 ? best.excess / best.y.norm() : 0;
  floor.solved = end.solved;
  return floor;
}

// Search for the lowest RMSE of one model.
class ModelSearch {
 public:
  ModelSearch(Proof* proof, Model model)
      : proof_(*proof), diodes_(static_cast<int>(model)), device_(DeviceOf(*proof, model)) {}

  // Improves the result from a mixture with any number of diodes.
  void From(const Mixture& mixture) {
    const CertifyOptions& options = proof_.options;
    const double rs = std::max({proof_.limits.rs_cut, proof_.rs_reached, mixture.rs});
    const ModelRanges ranges = RangesUpTo(std::min(options.rs_upper_ohm, rs));
    const RefineProblem problem = ModelProblem(proof_.curve, device_, ranges, options.objective);
    FindUpperBound(problem, ranges, proof_.data, mixture, &best_);
  }
  // The best parameters, with interchangeable diodes in the order of a fit's.
  std::vector<double> OrderedP() const {
    std::vector<ParameterBounds> bounds(device_.size(), {0, 0});
    const std::vector<DiodeRanges> ranges = RangesUpTo(proof_.options.rs_upper_ohm).diodes;
    for (std::size_t d = 0; d < ranges.size(); ++d) {
      const int diode = static_cast<int>(d);
      bounds[IdealityIndex(diode)] = {ranges[d].n_lower, ranges[d].n_upper};
      bounds[SaturationCurrentIndex(diode)] = {ranges[d].is_lower_A, ranges[d].is_upper_A};
    }
    std::vector<double> p = best_.p;
    OrderAlike(device_, bounds, &p, nullptr);
    return p;
  }
  double mean_square() const { return best_.mean_square; }
  double Half() const { return proof_.Half(std::sqrt(best_.mean_square)); }
  Mixture AsMixture() const {
    Mixture mixture = lyrefit::AsMixture(device_, proof_.data, best_.p);
    mixture.primal = Half();
    return mixture;
  }

 private:
  ModelRanges RangesUpTo(double rs_ohm) const {
    return RangesOfModel(proof_.options, diodes_, rs_ohm, proof_.data.reference_voltage_V);
  }

  static Device DeviceOf(const Proof& proof, Model model) {
    return MakeDevice(model, proof.curve.conditions, proof.options.constants);
  }

  const Proof& proof_;
  int diodes_;
  Device device_;
  UpperBound best_;
};

ModelCertificate CertifyModel(Model model, const BranchEnd& floor, Proof* shared) {
  const Proof& proof = *shared;
  const int diodes = static_cast<int>(model);
  ModelSearch best(shared, model);
  for (const Mixture& mixture : proof.upper_bound) best.From(mixture);
  ModelCertificate certificate;
  certificate.model = model;
  double lower = floor.lower;
  const bool floor_proves = AsDiodes(floor.best, proof.BoxOfModel(diodes)) ||
                            lower >= best.Half() * (1 - 2 * proof.limits.tolerance);
  if (!floor_proves) {
    BranchLimits limits = proof.limits;
    limits.polish = [&](const Mixture& mixture) {
      best.From(mixture);
      return best.Half();
    };
    const BranchEnd end = RunBranch(limits, diodes, best.Half(), shared);
    certificate.solved = end.solved;
    lower = std::max(lower, end.lower);
    if (end.best.primal < best.Half() * (1 - 1e-9)) best.From(end.best);
  }
  shared->upper_bound.push_back(best.AsMixture());
  certificate.parameters = best.OrderedP();
  certificate.rmse_A = proof.options.rigorous ? SafeModelRmse(proof, diodes, certificate.parameters)
                                              : std::sqrt(best.mean_square());
  certificate.lower_bound_A = std::min(proof.RmseBelow(lower), certificate.rmse_A);
  certificate.gap = Gap(proof, certificate.rmse_A, certificate.lower_bound_A);
  certificate.certified = Certified(proof, certificate.rmse_A, certificate.lower_bound_A);
  return certificate;
}

}  // namespace

std::vector<double> DualCosines(const Certificate& certificate, const std::vector<double>& n) {
  const auto points = static_cast<Eigen::Index>(certificate.curve.size());
  const Eigen::Map<const Eigen::VectorXd> vd(certificate.floor.junction_voltage_V.data(), points);
  const Eigen::Map<const Eigen::VectorXd> y(certificate.floor.dual_A.data(), points);
  std::vector<double> cosines;
  for (const double ideality : n) {
    const Eigen::VectorXd column = DiodeColumn(
        vd, certificate.reference_voltage_V, 1 / (ideality * certificate.module_thermal_voltage_V));
    cosines.push_back(column.dot(y) / std::max(column.norm() * y.norm(), 1e-300));
  }
  return cosines;
}

Expected<Certificate> Certify(const IvCurve& curve, const CertifyOptions& asked,
                              const Observer& observer) {
  const Instant begin = Now();
  TRY(CheckOptions(asked));
  TRY(Validate(curve));
  const IvCurve kept = WithoutBeyondVoc(curve);
  const CertifyOptions used = WithEveryDiode(asked);
  Proof proof{kept, used, ProgressReporter(observer), {}, {}, {}};
  TRY(Prepare(&proof));
  const char* stage = "floor";
  proof.limits.stop = [&](std::int64_t solved, double best, double lower) {
    return proof.progress.Report(
        {stage, solved, 0, solved, proof.Rmse(best), /*seconds=*/0, proof.Rmse(lower)});
  };

  Certificate certificate;
  certificate.version = Version();
  certificate.curve = kept;
  certificate.options = used;
  certificate.doubts = proof.doubts;
  certificate.reference_voltage_V = proof.data.reference_voltage_V;
  certificate.module_thermal_voltage_V = proof.thermal_voltage_V;
  AppendNonDefaults(asked, kCertifyOptionTable, &certificate.non_default_options);
  BranchEnd floor = RunBranch(proof.limits, 0, kInfinity, &proof);
  proof.upper_bound.push_back(floor.best);
  for (const Model model : used.models) {
    if (proof.progress.stop().requested()) break;
    const std::string name = ToText(model);
    stage = name.c_str();
    certificate.models.push_back(CertifyModel(model, floor, &proof));
  }
  TakeBest(proof, &floor);
  certificate.floor = FillFloor(proof, floor);
  for (ModelCertificate& model : certificate.models) {
    const double above = model.rmse_A - certificate.floor.rmse_A;
    model.above_floor = above > proof.rounding_A ? above / certificate.floor.rmse_A : 0;
  }
  certificate.rs_upper_ohm =
      std::min(used.rs_upper_ohm, std::max(proof.limits.rs_cut, proof.rs_reached));
  certificate.interrupted = proof.progress.stop().requested();
  certificate.seconds = SecondsSince(begin);
  return certificate;
}

}  // namespace lyrefit
