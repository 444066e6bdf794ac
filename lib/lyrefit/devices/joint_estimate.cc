#include "lyrefit/devices/joint_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/numbers.h"
#include "lyrefit/devices/joint_problem.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/estimate/refine/intervals.h"

namespace lyrefit {
namespace {

constexpr IntervalRules kJointRules = {
    /*thorough=*/true, /*judge_open_ends=*/false, /*judge_absent_diodes=*/false,
    "no shunt is visible: only a lower limit is known",
    "these measurements do not fix it: another parameter takes its place"};
constexpr double kSecondDiodeP = 0.001;  // least p-value of one diode alone
constexpr double kMisfit = 0.01;         // of Isc or Voc, as for one curve
constexpr double kNotShared = 0.003;     // of Isc or Voc, if the curve's own fit is this much
constexpr double kTimesOwn = 3;          // closer

// A joint problem, with its errors settled, and its fit.
struct JointEnd {
  JointCell cell;
  RefineEnd end;
};

int ReadingsOf(const CellProblem& problem) {
  int readings = 0;
  for (const CellBlock& block : problem.blocks)
    readings += static_cast<int>(block.voltage_V.size());
  return readings;
}

int FreeParameters(const CellProblem& problem) {
  int free = 0;
  for (std::size_t i = 0; i < problem.lower.size(); ++i) {
    free += problem.lower[i] < problem.upper[i] ? 1 : 0;
  }
  return free;
}

RefineEnd BestOf(const CellProblem& problem, const std::vector<std::vector<double>>& starts,
                 const StopToken& stop) {
  const CellModel model(problem);
  RefineOptions how;
  how.stop = stop;
  RefineEnd best;
  best.mean_square = HUGE_VAL;
  for (const std::vector<double>& start : starts) {
    RefineEnd end = RefineModel(model, {start, {}}, how);
    if (end.mean_square < best.mean_square) best = std::move(end);
  }
  return best;
}

// Each measurement counts by the size of its residuals, which the fit changes in turn.
JointEnd FitJointly(JointCell cell, std::vector<std::vector<double>> starts,
                    const StopToken& stop) {
  constexpr int kMostRounds = 12;
  constexpr double kSettled = 0.01;
  CellProblem& problem = cell.problem;
  const double readings = ReadingsOf(problem);
  const double spread = std::sqrt(readings / std::max(1.0, readings - FreeParameters(problem)));
  JointEnd found;
  for (int round = 0; round < kMostRounds && !starts.empty(); ++round) {
    found.end = BestOf(problem, starts, stop);
    if (found.end.p.empty() || stop.requested()) break;
    const std::vector<double> rms = RmsOfBlocks(problem, found.end.p);
    double change = 0;
    for (std::size_t b = 0; b < rms.size(); ++b) {
      const double error = std::max(cell.least_error[b], spread * rms[b]);
      change = std::max(change, std::fabs(std::log(error / problem.blocks[b].error)));
      problem.blocks[b].error = error;
    }
    starts.insert(starts.begin(), found.end.p);
    if (change < kSettled) break;
    if (round > 0) starts.resize(1);
  }
  found.cell = std::move(cell);
  return found;
}

std::vector<bool> FixedOf(const CellProblem& problem) {
  std::vector<bool> fixed;
  for (std::size_t i = 0; i < problem.lower.size(); ++i) {
    fixed.push_back(problem.lower[i] == problem.upper[i]);
  }
  return fixed;
}

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

// The p-value of one diode against a second one of n = 2, under the errors of the fit with two. NaN:
// that fit failed.
double SecondDiodeP(const JointEnd& one, const JointEnd& two) {
  if (two.end.p.empty()) return kUnknown;
  const std::vector<ErrorModel> errors = FindBlockErrors(two.cell, two.end.p);
  CellProblem single = one.cell.problem;
  single.error_A = two.cell.problem.error_A;
  for (std::size_t b = 0; b < single.blocks.size(); ++b) {
    single.blocks[b].error = two.cell.problem.blocks[b].error;
  }
  const int readings = ReadingsOf(single);
  const int degrees = std::max(1, readings - FreeParameters(two.cell.problem));
  return FTestPValue(WhitenedSquares(single, one.end.p, errors) / readings,
                     WhitenedSquares(two.cell.problem, two.end.p, errors) / readings, 1, degrees);
}

void FindJointIntervals(const JointEnd& fit, const std::vector<ErrorModel>& errors,
                        const CellOptions& options, const ProgressReporter& progress,
                        JointEstimate* joint) {
  const CellProblem& problem = fit.cell.problem;
  const CellModel model(problem);
  IntervalProblem intervals;
  intervals.estimates =
      MakeEstimates(problem.parameters, problem.lower, problem.upper, {}, fit.end.p);
  intervals.active = fit.end.active;
  intervals.rules = kJointRules;
  intervals.threads = options.threads;
  intervals.variance = problem.error_A * problem.error_A;
  const std::vector<bool> fixed = FixedOf(problem);
  intervals.stretch =
      StretchOf(SpreadUnderErrors(problem, fit.end, fixed, errors).standard_error,
                FindSpread(model, fit.end, fixed, intervals.variance).standard_error);
  intervals.spread = SpreadUnderErrors(problem, fit.end, fit.end.active, errors);
  const int degrees = std::max(1, ReadingsOf(problem) - FreeParameters(problem));
  intervals.t.assign(intervals.estimates.size(), StudentT95(degrees));
  intervals.profile = [&](const ProfileQuery& query) {
    return FindProfileSide(model, fit.end, query, ProfileOptions(progress.stop()));
  };
  IntervalReport found = FindIntervals(std::move(intervals), progress);
  joint->estimates = std::move(found.estimates);
  joint->correlations = std::move(found.correlations);
}

// Standard errors without each measurement, over those with all, of independent errors.
void FindWhatEachAdds(const JointEnd& fit, JointEstimate* joint) {
  const CellProblem& problem = fit.cell.problem;
  const std::vector<bool> fixed = FixedOf(problem);
  const auto errors_of = [&](const CellProblem& some) {
    return FindSpread(CellModel(some), fit.end, fixed, 1).standard_error;
  };
  const std::vector<double> all = errors_of(problem);
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    std::vector<double> without = errors_of(Without(problem, static_cast<int>(b)));
    for (std::size_t i = 0; i < without.size(); ++i) without[i] /= all[i];
    joint->measurements[b].without = std::move(without);
  }
}

void DescribeMeasurements(const CellReport& report, const JointEnd& fit, JointEstimate* joint) {
  const std::vector<double> rms = RmsOfBlocks(fit.cell.problem, fit.end.p);
  for (std::size_t b = 0; b < rms.size(); ++b) {
    JointMeasurement one;
    one.sweep = fit.cell.sweep[b];
    one.readings = static_cast<int>(fit.cell.problem.blocks[b].voltage_V.size());
    one.rms = rms[b];
    one.noise = fit.cell.noise[b];
    const CellSweep& sweep = report.sweeps[one.sweep];
    if (sweep.fit) one.own_rms = sweep.fit->rmse.refined.solved_current_A;
    joint->measurements.push_back(std::move(one));
  }
}

const Estimate& Named(const JointEstimate& joint, const std::string& symbol) {
  return *std::find_if(joint.estimates.begin(), joint.estimates.end(),
                       [&](const Estimate& e) { return e.info.symbol == symbol; });
}

void VoidJoint(const CellReport& report, const JointEnd& fit, const CellOptions& options,
               JointEstimate* joint) {
  for (const JointMeasurement& one : joint->measurements) {
    const CellSweep& sweep = report.sweeps[one.sweep];
    const bool trace = sweep.kind == SweepKind::kSunsVoc;
    const double part = one.rms / (trace ? fit.cell.voc_V : fit.cell.isc_A);
    const double times = one.rms / one.own_rms;
    if (part <= kMisfit && !(part > kNotShared && times > kTimesOwn)) continue;
    joint->void_because.push_back(
        fmt::format("one set of parameters misses {} by {:.2g} % of {}{}", sweep.name, 100 * part,
                    trace ? "Voc" : "Isc",
                    times > kTimesOwn ? fmt::format(", {:.3g} times its own fit", times) : ""));
  }
  const double n = Named(*joint, "n1").refined;
  if (n > options.ideal_n) {
    joint->void_because.push_back(
        fmt::format("n = {:.3g} is above {:.3g}: none of one junction", n, options.ideal_n));
  }
}

// What the measurements say of the conductance at short circuit.
void DescribeShunt(const JointEnd& fit, JointEstimate* joint) {
  const CellProblem& problem = fit.cell.problem;
  const int brightest = problem.blocks.front().light;
  if (brightest < 0) return;
  const Estimate& shunt = Named(*joint, "Rsh");
  const Estimate& collection = Named(*joint, "c");
  if (!std::isfinite(collection.standard_error) && collection.at_bound == BoundSide::kNone) {
    joint->shunt =
        "a shunt and a loss of collection with the voltage look alike in these measurements; a "
        "second light or the dark curve decides";
    return;
  }
  const double lit = collection.refined * fit.end.p[brightest], dark = 1 / shunt.refined;
  if (!(lit + dark > 0)) return;
  const bool loses = collection.low_95 > 0,
             leaks = std::isfinite(shunt.high_95) && shunt.high_95 < shunt.bounds.upper;
  const double goes = loses ? lit : 0, stays = leaks ? dark : 0;
  if (loses || leaks) joint->collection_part = goes / (goes + stays);
  if (loses && leaks) {
    joint->shunt = fmt::format(
        "of the conductance at short circuit {:.0f} % goes with the light (collection that depends "
        "on "
        "voltage) and {:.0f} % stays in the dark (shunt)",
        100 * joint->collection_part, 100 * (1 - joint->collection_part));
  } else if (loses) {
    joint->shunt =
        "the conductance at short circuit goes with the light: collection that depends on voltage; "
        "no shunt is needed";
  } else if (leaks) {
    joint->shunt =
        "the conductance at short circuit stays in the dark: a shunt; no loss of collection is "
        "needed";
  } else {
    joint->shunt = "neither a shunt nor a loss of collection is needed";
  }
}

}  // namespace

std::optional<JointEstimate> FindJointEstimate(const CellReport& report,
                                               const std::vector<int>& lights, int dark,
                                               const CellOptions& options,
                                               const Observer& observer) {
  if (lights.empty() && dark < 0) return std::nullopt;
  JointCell cell = MakeJointCell(report, lights, dark, options, /*second_diode=*/false);
  // A dark curve that does not conduct has no scale.
  if (cell.problem.blocks.size() < 2 || !(cell.isc_A > 0 && cell.voc_V > 0)) return std::nullopt;
  JointEstimate joint;
  const std::vector<std::vector<double>> starts = JointStarts(cell, report);
  const ProgressReporter progress(observer, "joint estimate", 0);
  const JointEnd one = FitJointly(std::move(cell), starts, progress.stop());
  if (one.end.p.empty() || !std::isfinite(one.end.mean_square)) {
    joint.missing = "no sweep has a fit to start from";
    return joint;
  }
  cell = MakeJointCell(report, lights, dark, options, /*second_diode=*/true);
  const std::vector<std::vector<double>> richer = SecondDiodeStarts(cell, one.end.p);
  const JointEnd two = FitJointly(std::move(cell), richer, progress.stop());
  joint.second_diode_p = SecondDiodeP(one, two);
  joint.second_diode = joint.second_diode_p < kSecondDiodeP;
  const JointEnd& fit = joint.second_diode ? two : one;
  joint.converged = fit.end.converged;
  joint.shared = fit.cell.problem.first_light();
  const std::vector<ErrorModel> errors = FindBlockErrors(fit.cell, fit.end.p);
  FindJointIntervals(fit, errors, options, progress, &joint);
  DescribeMeasurements(report, fit, &joint);
  FindWhatEachAdds(fit, &joint);
  VoidJoint(report, fit, options, &joint);
  DescribeShunt(fit, &joint);
  return joint;
}

}  // namespace lyrefit
