#include "lyrefit/devices/joint_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/roots.h"
#include "lyrefit/devices/joint_problem.h"
#include "lyrefit/estimate/fit/estimate_parameters.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/family/family_judge.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

constexpr IntervalRules kJointRules = {
    /*thorough=*/true, /*judge_open_ends=*/false, /*judge_absent_diodes=*/false,
    "no shunt is visible: only a lower limit is known",
    "these measurements do not fix it: another parameter takes its place"};
constexpr double kSecondDiodeP = 0.001;  // least p-value of one diode alone
constexpr double kContactsP = 0.001;     // least p-value of one series resistance alone
constexpr double kWarmerP = 0.001;       // least p-value of one temperature alone
constexpr double kMisfit = 0.01;         // of Isc or Voc, as for one curve
constexpr double kNotShared = 0.003;     // of Isc or Voc, if the curve's own fit is this much
constexpr double kTimesOwn = 3;          // closer

std::vector<bool> FixedOf(const CellProblem& problem) {
  std::vector<bool> fixed;
  for (std::size_t i = 0; i < problem.lower.size(); ++i) {
    fixed.push_back(problem.lower[i] == problem.upper[i]);
  }
  return fixed;
}

// A model of all measurements of a cell, and its polished end.
class JointCandidate {
 public:
  JointCandidate(const CellReport& report, const std::vector<int>& lights, int dark,
                 const CellOptions& options, const JointKind& of_kind)
      : kind(of_kind),
        cell(MakeJointCell(report, lights, dark, options, kind)),
        model(cell.problem),
        problem{model,
                MakeEstimates(cell.problem.parameters, cell.problem.lower, cell.problem.upper)} {
    for (const CellBlock& block : cell.problem.blocks) {
      problem.readings += static_cast<int>(block.voltage_V.size());
    }
    problem.settle = [this](const RefineEnd& at) { return SettleErrors(at.p); };
    problem.errors = [this](const RefineEnd& at) { return ErrorsAt(at); };
    problem.intervals = kJointRules;
  }
  JointCandidate(const JointCandidate&) = delete;
  JointCandidate& operator=(const JointCandidate&) = delete;

  const std::vector<double>& p() const { return polished.best.p; }

  // Polishes from these starts.
  void Polish(const std::vector<std::vector<double>>& points, const EstimateOptions& options,
              const ProgressReporter& progress) {
    std::vector<EstimateStart> starts;
    starts.reserve(points.size());
    for (const std::vector<double>& p : points) starts.push_back({"fit of a measurement", p});
    polished = PolishParameters(problem, std::move(starts), options, progress);
    if (kind.contacts && !p().empty()) OrderParts();
  }

  const JointKind kind;
  JointCell cell;
  const CellModel model;
  EstimateProblem problem;
  PolishedParameters polished;

 private:
  // The part with the share has the larger resistance.
  void OrderParts() {
    RefineEnd& end = polished.best;
    const int share = cell.problem.contact_share(), far = cell.problem.contact_resistance();
    constexpr int kNear = kRs - 1;
    if (end.p[far] >= end.p[kNear]) return;
    std::swap(end.p[far], end.p[kNear]);
    end.p[share] = 1 - end.p[share];
    if (end.active.empty()) return;
    const bool active = end.active[far];
    end.active[far] = end.active[kNear];
    end.active[kNear] = active;
  }

  // Each measurement counts by the size of its residuals, which the fit changes in turn. False: the
  // sizes stay.
  bool SettleErrors(const std::vector<double>& p) {
    constexpr double kSettled = 0.01;
    const double spread =
        std::sqrt(problem.readings / std::max(1.0, 1.0 * DegreesOfFreedom(problem)));
    const std::vector<double> rms = RmsOfBlocks(cell.problem, p);
    double change = 0;
    for (std::size_t b = 0; b < rms.size(); ++b) {
      double& size = cell.problem.blocks[b].error;
      const double error = std::max(cell.least_error[b], spread * rms[b]);
      change = std::max(change, std::fabs(std::log(error / size)));
      size = error;
    }
    return change >= kSettled;
  }

  EstimateErrors ErrorsAt(const RefineEnd& at) const {
    const CellProblem& measured = cell.problem;
    const double variance = measured.error_A * measured.error_A;
    const std::vector<bool> fixed = FixedOf(measured);
    const std::vector<ErrorModel> errors = FindBlockErrors(cell, at.p);
    return {variance, DegreesOfFreedom(problem), SpreadUnderErrors(measured, at, at.active, errors),
            StretchOf(SpreadUnderErrors(measured, at, fixed, errors).standard_error,
                      FindSpread(model, at, fixed, variance).standard_error)};
  }
};

// Squares of the residuals over their errors, by the size and the correlation of `errors`.
double WhitenedSquares(const CellProblem& problem, const std::vector<double>& p,
                       const std::vector<ErrorModel>& errors) {
  const CellModel model(problem);
  double squares = 0;
  for (std::size_t b = 0; b < errors.size(); ++b) {
    RowMatrix residual(errors[b].size(), 1);
    if (!model.Evaluate(static_cast<int>(b), p.data(), nullptr, residual.data(), nullptr,
                        nullptr)) {
      return kUnknown;
    }
    Whiten(errors[b], {}, residual);
    squares += residual.squaredNorm();
  }
  return squares;
}

// The p-value of a model against one with `extra` more parameters, under the errors of the fit with
// these. NaN: that fit failed.
double NestedP(const JointCandidate& plain, const JointCandidate& richer, int extra) {
  if (richer.p().empty()) return kUnknown;
  const std::vector<ErrorModel> errors = FindBlockErrors(richer.cell, richer.p());
  CellProblem weighed = plain.cell.problem;
  weighed.error_A = richer.cell.problem.error_A;
  for (std::size_t b = 0; b < weighed.blocks.size(); ++b) {
    weighed.blocks[b].error = richer.cell.problem.blocks[b].error;
  }
  const int readings = plain.problem.readings;
  return FTestPValue(WhitenedSquares(weighed, plain.p(), errors) / readings,
                     WhitenedSquares(richer.cell.problem, richer.p(), errors) / readings, extra,
                     DegreesOfFreedom(richer.problem));
}

// Maximum power of the brightest curve with these series resistances of its parts.
double PowerOf(const CellProblem& problem, const std::vector<double>& p, double near_ohm,
               double far_ohm) {
  std::vector<double> near =
      DeviceUnderLight(problem, p.data(), p[problem.blocks.front().light], /*heated=*/true);
  std::vector<double> far = near;
  near[kRs] = near_ohm;
  far[kRs] = far_ohm;
  const double share = problem.contacts ? p[problem.contact_share()] : 0;
  const auto power = [&](double voltage_V) {
    const auto current = [&](const std::vector<double>& device) {
      return SolveOperatingPoint(problem.device, device.data(), voltage_V).current_A;
    };
    return voltage_V * ((1 - share) * current(near) + share * current(far));
  };
  return power(MaximumBetween(power, 0, ModelOpenCircuit(problem.device, near.data())));
}

// What the series resistances cost under the brightest light.
struct ResistanceLosses {
  Ranged contacts_W;
  double of_power = kUnknown;
};

ResistanceLosses FindResistanceLosses(const JointCandidate& fit, const RefineEnd& end) {
  const CellProblem& problem = fit.cell.problem;
  if (!fit.kind.contacts || problem.blocks.front().light < 0) return {};
  const auto power = [&](const std::vector<double>& p) {
    return PowerOf(problem, p, p[kRs - 1], p[problem.contact_resistance()]);
  };
  const EstimateErrors errors = fit.problem.errors(end);
  const Interval loss =
      DerivedInterval(errors.spread, end.active, static_cast<int>(end.p.size()),
                      StudentT95(errors.degrees), end.p, [&](const std::vector<double>& p) {
                        return PowerOf(problem, p, p[kRs - 1], p[kRs - 1]) - power(p);
                      });
  return {{loss.value, std::max(0.0, loss.low_95), loss.high_95},
          1 - power(end.p) / PowerOf(problem, end.p, 0, 0)};
}

// Standard errors without block `b`, over those with all, of independent errors.
std::vector<double> StandardErrorsWithout(const CellProblem& problem, const RefineEnd& end, int b) {
  const std::vector<bool> fixed = FixedOf(problem);
  const std::vector<double> all = FindSpread(CellModel(problem), end, fixed, 1).standard_error;
  const CellProblem rest = Without(problem, b);
  std::vector<double> without = FindSpread(CellModel(rest), end, fixed, 1).standard_error;
  for (std::size_t i = 0; i < without.size(); ++i) without[i] /= all[i];
  return without;
}

std::vector<JointMeasurement> MeasurementsOf(const CellReport& report, const JointCandidate& fit,
                                             const RefineEnd& end) {
  std::vector<JointMeasurement> measurements;
  const std::vector<double> rms = RmsOfBlocks(fit.cell.problem, end.p);
  for (std::size_t b = 0; b < rms.size(); ++b) {
    JointMeasurement one;
    one.sweep = fit.cell.sweep[b];
    one.readings = static_cast<int>(fit.cell.problem.blocks[b].voltage_V.size());
    one.rms = rms[b];
    one.noise = fit.cell.noise[b];
    const CellSweep& sweep = report.sweeps[one.sweep];
    if (sweep.fit) one.own_rms = sweep.fit->rmse.refined.solved_current_A;
    one.without = StandardErrorsWithout(fit.cell.problem, end, static_cast<int>(b));
    measurements.push_back(std::move(one));
  }
  return measurements;
}

const Estimate& Named(const JointEstimate& joint, const std::string& symbol) {
  return *std::find_if(joint.estimates.begin(), joint.estimates.end(),
                       [&](const Estimate& e) { return e.info.symbol == symbol; });
}

std::vector<std::string> WhyVoid(const CellReport& report, const JointCell& cell,
                                 const CellOptions& options, const JointEstimate& joint) {
  std::vector<std::string> reasons;
  for (const JointMeasurement& one : joint.measurements) {
    const CellSweep& sweep = report.sweeps[one.sweep];
    const bool trace = sweep.kind == SweepKind::kSunsVoc && !sweep.pseudo_current;
    const double part = one.rms / (trace ? cell.voc_V : cell.isc_A);
    const double times = one.rms / one.own_rms;
    if (part <= kMisfit && !(part > kNotShared && times > kTimesOwn)) continue;
    reasons.push_back(
        fmt::format("one set of parameters misses {} by {:.2g} % of {}{}", sweep.name, 100 * part,
                    trace ? "Voc" : "Isc",
                    times > kTimesOwn ? fmt::format(", {:.3g} times its own fit", times) : ""));
  }
  const double n = Named(joint, "n1").refined;
  if (n > options.ideal_n) {
    reasons.push_back(
        fmt::format("n = {:.3g} is above {:.3g}: none of one junction", n, options.ideal_n));
  }
  return reasons;
}

// What the measurements say of the conductance at short circuit.
struct ShuntFound {
  double collection_part = kUnknown;
  std::string sentence = {};
};

ShuntFound FindShunt(const CellProblem& problem, const RefineEnd& end, const JointEstimate& joint) {
  const int brightest = problem.blocks.front().light;
  if (brightest < 0) return {};
  const Estimate& shunt = Named(joint, "Rsh");
  const Estimate& collection = Named(joint, "c");
  if (!std::isfinite(collection.standard_error) && collection.at_bound == BoundSide::kNone) {
    return {kUnknown,
            "a shunt and a loss of collection with the voltage look alike in these measurements; a "
            "second light or the dark curve decides"};
  }
  const double lit = collection.refined * end.p[brightest], dark = 1 / shunt.refined;
  if (!(lit + dark > 0)) return {};
  const bool loses = collection.low_95 > 0,
             leaks = std::isfinite(shunt.high_95) && shunt.high_95 < shunt.bounds.upper;
  if (!loses && !leaks) return {kUnknown, "neither a shunt nor a loss of collection is needed"};
  const double goes = loses ? lit : 0, stays = leaks ? dark : 0, part = goes / (goes + stays);
  if (loses && leaks) {
    return {part,
            fmt::format(
                "of the conductance at short circuit {:.0f} % goes with the light (collection that "
                "depends on voltage) and {:.0f} % stays in the dark (shunt)",
                100 * part, 100 * (1 - part))};
  }
  return {part, loses ? "the conductance at short circuit goes with the light: collection that "
                        "depends on voltage; no shunt is needed"
                      : "the conductance at short circuit stays in the dark: a shunt; no loss of "
                        "collection is needed"};
}

// Change of Voc with the temperature by the law of a heated block.
double VocPerKelvin(const JointCell& cell) {
  const CellProblem& problem = cell.problem;
  const double thermal_V = problem.device.module_thermal_voltage_V;
  return (cell.voc_V - (problem.gap_over_thermal + 3) * thermal_V) / problem.temperature_K;
}

// What one diode at one temperature is tested against.
struct JointCandidates {
  std::unique_ptr<JointCandidate> second_diode;
  std::unique_ptr<JointCandidate> warmer;
  std::unique_ptr<JointCandidate> both;
};

// Whether the temperatures of a fit lie within what is tried.
bool IsInside(const JointCandidate& fit) {
  constexpr double kAtBound = 0.99;
  const int at = fit.cell.problem.warmth();
  return !fit.p().empty() && std::fabs(fit.p()[at]) < kAtBound * fit.cell.problem.upper[at];
}

// A second diode and a temperature of the lit sweeps above the dark one's (where `may_be_warmer`) are
// each tried alone and beside the other: what the other makes needless is left out. Where each makes
// the other needless, the closer one counts.
const JointCandidate& TryDiodeAndWarmth(const JointCandidate& one, bool may_be_warmer,
                                        JointCandidates* fits, const EstimateOptions& options,
                                        const ProgressReporter& progress, JointEstimate* joint) {
  JointCandidate &two = *fits->second_diode, &warm = *fits->warmer, &both = *fits->both;
  two.Polish(SecondDiodeStarts(two.cell, one.p()), options, progress);
  joint->second_diode_p = NestedP(one, two, 1);
  joint->second_diode = joint->second_diode_p < kSecondDiodeP;
  if (may_be_warmer) {
    warm.Polish(WarmerStarts(warm.cell, one.p()), options, progress);
    joint->warmer_p = IsInside(warm) ? NestedP(one, warm, 1) : 1;
    joint->warmer = joint->warmer_p < kWarmerP;
  }
  if (!joint->warmer) return joint->second_diode ? two : one;
  both.Polish(SecondDiodeStarts(both.cell, warm.p()), options, progress);
  const double diode_p = NestedP(warm, both, 1), warmer_p = NestedP(two, both, 1);
  const bool diode = diode_p < kSecondDiodeP, warmer = warmer_p < kWarmerP && IsInside(both);
  joint->either = joint->second_diode && !diode && !warmer;
  if (diode && !warmer) joint->warmer = false;
  if (joint->either) joint->warmer = NestedP(warm, two, 1) > 0.5;
  joint->second_diode = diode || (joint->either && !joint->warmer);
  if (!joint->either) joint->second_diode_p = diode_p;
  if (joint->second_diode) return joint->warmer ? both : two;
  return warm;
}

}  // namespace

std::optional<JointEstimate> FindJointEstimate(const CellReport& report,
                                               const std::vector<int>& lights, int dark,
                                               const CellOptions& options,
                                               const Observer& observer) {
  if (lights.empty() && dark < 0) return std::nullopt;
  JointCandidate one(report, lights, dark, options, {});
  // A dark curve that does not conduct has no scale.
  const bool scaled = one.cell.isc_A > 0 && one.cell.voc_V > 0;
  if (one.cell.problem.blocks.size() < 2 || !scaled) return std::nullopt;
  JointEstimate joint;
  const ProgressReporter progress(observer, "joint estimate", 0);
  EstimateOptions estimate;
  estimate.threads = options.threads;
  one.Polish(JointStarts(one.cell, report), estimate, progress);
  if (one.p().empty() || !std::isfinite(one.polished.best.mean_square)) {
    joint.missing = "no sweep has a fit to start from";
    return joint;
  }
  const auto made = [&](const JointKind& kind) {
    return std::make_unique<JointCandidate>(report, lights, dark, options, kind);
  };
  JointCandidates fits = {made({true, false, false}), made({false, false, true}),
                          made({true, false, true})};
  const JointCandidate& plain =
      TryDiodeAndWarmth(one, !lights.empty() && dark >= 0, &fits, estimate, progress, &joint);
  const JointKind of = plain.kind;
  JointCandidate aged(report, lights, dark, options, {of.second_diode, true, of.warmer});
  // Laboratory cells depart from their model in more ways, which a small part of the area imitates.
  if (report.cells_in_series > 1) {
    aged.Polish(ContactStarts(aged.cell, plain.p()), estimate, progress);
    joint.contacts_p = NestedP(plain, aged, 2);
  }
  joint.contacts = joint.contacts_p < kContactsP;
  // A second diode may have been in the place of the contacts.
  JointCandidate alone(report, lights, dark, options, {false, true, of.warmer});
  if (joint.contacts && of.second_diode) {
    alone.Polish(ContactStarts(alone.cell, (of.warmer ? *fits.warmer : one).p()), estimate,
                 progress);
    joint.second_diode_p = NestedP(alone, aged, 1);
    joint.second_diode = joint.second_diode_p < kSecondDiodeP;
  }
  const JointCandidate& with = of.second_diode && !joint.second_diode ? alone : aged;
  const JointCandidate& fit = joint.contacts ? with : plain;
  EstimatedParameters found = JudgeParameters(fit.problem, fit.polished, {}, estimate, progress);
  static_cast<EstimateReport&>(joint) = std::move(found.report);
  joint.shared = fit.cell.problem.first_light();
  joint.measurements = MeasurementsOf(report, fit, found.end);
  joint.void_because = WhyVoid(report, fit.cell, options, joint);
  ShuntFound shunt = FindShunt(fit.cell.problem, found.end, joint);
  joint.collection_part = shunt.collection_part;
  joint.shunt = std::move(shunt.sentence);
  const ResistanceLosses losses = FindResistanceLosses(fit, found.end);
  joint.contact_loss_W = losses.contacts_W;
  joint.series_loss = losses.of_power;
  joint.voc_per_K = VocPerKelvin(fit.cell);
  return joint;
}

}  // namespace lyrefit
