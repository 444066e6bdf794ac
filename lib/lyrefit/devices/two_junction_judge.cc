#include "lyrefit/devices/two_junction_judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/estimate/refine/intervals.h"
#include "lyrefit/estimate/refine/profile.h"

namespace lyrefit {
namespace {

constexpr IntervalRules kTwoJunctionRules = {
    /*thorough=*/true, /*judge_open_ends=*/false, /*judge_absent_diodes=*/false,
    "no shunt is visible: only a lower limit is known",
    "the data do not fix it: another parameter takes its place"};
constexpr int kRestarts = 3;
constexpr double kFarOutside = 9;  // rise at which a refit is given up, of that at the end

// The device has these limits by its nature; to reach one of them says something.
bool IsNaturalEnd(const ParameterInfo& info, bool upper) {
  if (info.kind == ParameterKind::kSeries || info.kind == ParameterKind::kPlain) return !upper;
  return info.kind == ParameterKind::kPhotocurrent && !upper;
}

// Marks parameters that the data limit on one side only.
void MarkOpenEnds(std::vector<Estimate>* estimates) {
  for (Estimate& e : *estimates) {
    if (!e.free() || !e.identifiable || e.interval == IntervalMethod::kNone) continue;
    const bool low = e.low_95 <= e.bounds.lower && !IsNaturalEnd(e.info, /*upper=*/false);
    const bool high = e.high_95 >= e.bounds.upper && !IsNaturalEnd(e.info, /*upper=*/true);
    const bool unsettled = e.interval == IntervalMethod::kUnsettled;
    if (!low && !high && !unsettled) continue;
    e.identifiable = false;
    if (unsettled) {
      e.reason = "an end of its interval was not found";
    } else if (low && high) {
      e.reason = "the data allow its whole range";
    } else if (e.info.kind == ParameterKind::kPhotocurrent ||
               e.info.kind == ParameterKind::kPlain) {
      e.reason = "this junction does not limit the current, so only a lower limit is known";
    } else {
      e.reason = fmt::format("only {} limit is known: the data allow it to the end of its range",
                             low ? "an upper" : "a lower");
    }
  }
}

// Sum of both junctions' voltages under the reference light at open circuit.
double OpenCircuit(const TwoJunctionProblem& problem, const std::vector<double>& p) {
  return TwoJunctionVoltage(problem.thermal_voltage_V,
                            JunctionsAtReference(problem, p.data()).data(), 0);
}

// The point with the saturation current of junction `j` moved so that the open-circuit voltage is
// `voc_V`. Along a profile, one junction takes the voltage that the other one loses.
FitPoint Compensated(const TwoJunctionModel& model, const TwoJunctionProblem& problem, int j,
                     double voc_V, FitPoint at) {
  const int i = JunctionSaturation(j);
  const FitParameter& parameter = model.shape().parameters[i];
  const double unit_V = problem.thermal_voltage_V * at.p[JunctionIdeality(j)];
  for (int k = 0; k < 3; ++k) {
    const double factor = std::exp((OpenCircuit(problem, at.p) - voc_V) / unit_V);
    at.p[i] = std::min(std::max(at.p[i] * factor, parameter.lower), parameter.upper);
  }
  return at;
}

// What the profiles of one fit share.
struct ProfileContext {
  const TwoJunctionModel& model;
  const TwoJunctionProblem& problem;
  const RefineEnd& best;
  std::vector<FitPoint> others;  // other optima inside the intervals
  double highest = 0;            // mean square at the ends of the intervals
  StopToken stop;
};

// The start with the parameter of a query fixed at `value`, as it is or with the open-circuit
// voltage of the best fit, whichever fits better.
FitPoint StartAt(const ProfileContext& context, const TwoJunctionModel& model, int parameter,
                 double value, FitPoint from) {
  const double voc_V = OpenCircuit(context.problem, context.best.p);
  from.p[parameter] = value;
  FitPoint lowest = from;
  double least = model.MeanSquare(from);
  for (int j = 0; j < 2; ++j) {
    if (parameter == JunctionSaturation(j)) continue;
    FitPoint moved = Compensated(model, context.problem, j, voc_V, from);
    const double mean_square = model.MeanSquare(moved);
    if (!(mean_square < least)) continue;
    least = mean_square;
    lowest = std::move(moved);
  }
  return lowest;
}

// The fit with one parameter fixed. Where the junctions are interchangeable, a refit that ends
// outside the interval may have stopped in a bend of that way: it is tried again from the best
// optimum.
RefineEnd RefitAt(const ProfileContext& context, int parameter, double value, const FitPoint& start,
                  const RefineOptions& how) {
  TwoJunctionModel model(context.problem);
  model.Fix(parameter, value);
  RefineEnd end = RefineModel(model, StartAt(context, model, parameter, value, start), how);
  const bool inside = end.mean_square <= context.highest;
  if (inside || end.stopped || !context.problem.ordered) return end;
  RefineEnd again =
      RefineModel(model, StartAt(context, model, parameter, value, context.best), how);
  return again.mean_square < end.mean_square ? again : end;
}

ProfileSide ProfileOf(const ProfileContext& context, ProfileQuery query) {
  query.local_optima = context.others;
  const auto refit = [&](double value, const FitPoint& start, double target, double tolerance) {
    RefineOptions how = ProfileOptions(context.stop);
    how.target = target;
    how.cutoff =
        context.best.mean_square + kFarOutside * (context.highest - context.best.mean_square);
    // The way along which the sum of squares stays low is long and bent: steps are short.
    how.function_tolerance = how.first_tolerance = 1e-2 * tolerance;
    return RefitAt(context, query.parameter, value, start, how);
  };
  return FindProfileSide(context.model, context.best, query, {refit, nullptr});
}

IntervalStep LastStepOf(const TwoJunctionOptions& options, const RefineEnd& best,
                        double current_scale_A) {
  const bool rounding = std::sqrt(best.mean_square) < 1e-11 * current_scale_A;
  switch (options.intervals) {
    case Intervals::kNone:
      return IntervalStep::kErrors;
    case Intervals::kSymmetric:
      return IntervalStep::kSymmetric;
    case Intervals::kProfile:
      break;
  }
  return rounding ? IntervalStep::kSymmetric : IntervalStep::kProfile;
}

IntervalReport IntervalsAt(const PreparedTwoJunctions& prepared, const TwoJunctionModel& model,
                           const TwoJunctionOptions& options, const TwoJunctionEnd& end,
                           const std::vector<double>& searched, const ProgressReporter& progress) {
  const int degrees = prepared.readings - prepared.free_parameters;
  const double variance = end.best.mean_square * prepared.readings / degrees;
  IntervalProblem problem;
  problem.estimates = MakeEstimates(prepared.problem.parameters, prepared.problem.lower,
                                    prepared.problem.upper, searched, end.best.p);
  problem.active = end.best.active;
  problem.rules = kTwoJunctionRules;
  problem.threads = options.threads;
  problem.last = LastStepOf(options, end.best, prepared.problem.current_scale_A);
  problem.spread = FindSpread(model, end.best, end.best.active, variance);
  problem.t.assign(problem.estimates.size(), StudentT95(degrees));
  problem.variance = variance;
  ProfileContext context{model, prepared.problem, end.best, {}, 0, progress.stop()};
  const double rise = problem.t[0] * problem.t[0] * variance / model.shape().points;
  context.highest = end.best.mean_square + rise;
  for (const FitPoint& other : end.other_optima) {
    if (model.MeanSquare(other) < context.highest) context.others.push_back(other);
  }
  // The share of each junction in the voltage is known through the shunts alone, if at all. All
  // parameters depend on it, and not linearly: no symmetric interval holds, so profile all.
  problem.several_optima = true;
  problem.profile = [&context](const ProfileQuery& query) { return ProfileOf(context, query); };
  return FindIntervals(std::move(problem), progress);
}

// Which junctions limit in at least one curve.
std::vector<bool> Limiting(const TwoJunctionProblem& problem, const std::vector<double>& p) {
  std::vector<bool> limits(2, false);
  for (std::size_t c = 0; c < problem.curves.size(); ++c) {
    const auto device = DeviceIn(problem, static_cast<int>(c), p.data());
    limits[device[JunctionPhotocurrent(0)] <= device[JunctionPhotocurrent(1)] ? 0 : 1] = true;
  }
  return limits;
}

// 1 or 2: the junction whose name ends the parameter's symbol; 0: of both.
int JunctionOf(const ParameterInfo& info) {
  const std::string symbol = info.symbol.substr(0, info.symbol.find('['));
  return symbol.back() == '1' ? 1 : symbol.back() == '2' ? 2 : 0;
}

// Symbols of parameters that are not identifiable, by the measurement that decides them.
struct OpenParameters {
  std::string saturation;  // of both junctions
  std::string junction[2];
  std::string common;
};

OpenParameters OpenOf(const std::vector<Estimate>& estimates) {
  OpenParameters open;
  for (const Estimate& e : estimates) {
    if (e.identifiable) continue;
    const int j = JunctionOf(e.info);
    const bool saturation = e.info.kind == ParameterKind::kSaturation;
    std::string& list = saturation ? open.saturation : j > 0 ? open.junction[j - 1] : open.common;
    list += (list.empty() ? "" : ", ") + e.info.symbol;
  }
  return open;
}

std::vector<std::string> Deciding(const TwoJunctionProblem& problem, const std::vector<double>& p,
                                  const std::vector<Estimate>& estimates) {
  const OpenParameters open = OpenOf(estimates);
  std::vector<std::string> sentences;
  if (problem.ordered) {
    sentences.push_back(
        "which junction is the top one: a curve under a second spectrum, with the light of one "
        "junction changed and the lights stated (--light CURVE=TOP:BOTTOM), decides");
  }
  const std::vector<bool> limits = Limiting(problem, p);
  for (int j = 0; j < 2; ++j) {
    if (open.junction[j].empty()) continue;
    sentences.push_back(
        limits[j] ? fmt::format("{}: curves under further spectra, or with less noise, decide",
                                open.junction[j])
                  : fmt::format("{}: a curve under a spectrum with so little light for junction "
                                "{} that it limits the current decides",
                                open.junction[j], j + 1));
  }
  if (!open.saturation.empty()) {
    sentences.push_back(fmt::format(
        "{}: without shunts only n1 ln Is1 + n2 ln Is2 shows, the open-circuit voltage of both; a "
        "curve with light for one junction alone (--light CURVE=1:0), whose open-circuit voltage "
        "is that junction's, decides",
        open.saturation));
  }
  if (!open.common.empty()) {
    sentences.push_back(
        fmt::format("{}: curves at two lights of the same spectrum decide", open.common));
  }
  return sentences;
}

}  // namespace

void JudgeTwoJunctions(const PreparedTwoJunctions& prepared, const TwoJunctionOptions& options,
                       const std::vector<double>& searched, const ProgressReporter& progress,
                       TwoJunctionEnd* end, TwoJunctionReport* report) {
  const TwoJunctionModel model(prepared.problem);
  for (int round = 0; round <= kRestarts; ++round) {
    IntervalReport found = IntervalsAt(prepared, model, options, *end, searched, progress);
    report->estimates = std::move(found.estimates);
    report->correlations = std::move(found.correlations);
    report->condition = found.condition;
    if (found.better.empty() || round == kRestarts || progress.stop().requested()) break;
    const auto lowest = std::min_element(
        found.better.begin(), found.better.end(), [&](const auto& a, const auto& b) {
          return model.MeanSquare({a, {}}) < model.MeanSquare({b, {}});
        });
    RefineOptions how;
    how.stop = progress.stop();
    RefineEnd lower = RefineModel(model, {*lowest, {}}, how);
    if (!(lower.mean_square < end->best.mean_square)) break;
    end->best = std::move(lower);
  }
  MarkOpenEnds(&report->estimates);
  report->decided_by = Deciding(prepared.problem, end->best.p, report->estimates);
}

}  // namespace lyrefit
