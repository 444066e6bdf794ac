#include "lyrefit/fit/intervals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/parallel.h"
#include "lyrefit/fit/statistics.h"
#include "lyrefit/law/device_effects.h"
#include "lyrefit/law/quote.h"
#include "lyrefit/refine/coarsen.h"
#include "lyrefit/refine/curve_model.h"
#include "lyrefit/refine/error_model.h"
#include "lyrefit/refine/other_optima.h"
#include "lyrefit/refine/profile.h"
#include "lyrefit/refine/reporting_model.h"
#include "lyrefit/refine/spread.h"

namespace lyrefit {
namespace {

constexpr double kStrongCorrelation = 0.9;

// Largest half-width of a symmetric interval, relative to the value (of a saturation current, of
// its logarithm). Beyond it the nonlinearity of the model makes the interval invalid.
constexpr double kLinearReach = 0.3;

// `p` with the parameters of all effects at their neutral values: absence of the effect for its
// strength, the start value for the others.
std::vector<double> Neutral(const Device& device, std::vector<double> p) {
  if (device.effects == nullptr) return p;
  auto next = p.begin() + device.effects->law.base_size();
  for (const EffectUse& use : device.effects->uses) {
    for (const EffectParameter& info : use.effect->parameters) *next++ = info.neutral;
  }
  return p;
}

// Data shared by the steps of interval estimation.
struct IntervalWork {
  const IntervalInput& input;
  std::vector<Estimate>& estimates;
  const int size;
  const std::vector<double> quoted;   // the end, in reporting units
  const std::vector<double> neutral;  // neutral values of effects, in reporting units
  int degrees = 1;
  std::vector<double> t = {};        // Student's t of each estimate
  std::vector<double> stretch = {};  // factor on t by the errors
  RefineProblem coarse = {};
  RefineEnd coarse_end = {};
  std::vector<FitPoint> local_optima = {};  // other optima that fit as well
  std::vector<double> better = {};
};

IntervalWork WorkOn(const IntervalInput& input, std::vector<Estimate>* estimates) {
  const Device& device = input.problem.device;
  IntervalWork work{input,
                    *estimates,
                    static_cast<int>(estimates->size()),
                    Reported(device, input.end.p),
                    Reported(device, Neutral(device, input.end.p)),
                    std::max(input.readings - input.free_parameters, 1)};
  for (int i = 0; i < work.size; ++i) {
    work.t.push_back(StudentT95(input.degrees.empty() ? work.degrees : input.degrees[i]));
  }
  return work;
}

// A profile compares sums of squares, which has no meaning if the residuals are only rounding.
bool ResidualsAreNoise(const IntervalInput& input) {
  return std::sqrt(input.end.mean_square) > 1e-11 * input.problem.current_scale_A;
}

// Variance of a residual of weight 1. `degrees` counts all readings, also on coarsened data.
double VarianceOf(int degrees, const RefineProblem& problem, const RefineEnd& end) {
  if (problem.errors != nullptr) return problem.noise_A * problem.noise_A;  // of the error model
  return end.mean_square * static_cast<double>(problem.voltage_V.size()) / degrees;
}

Spread SpreadOfModel(const IntervalInput& input, int degrees, const FitModel& model,
                     const FitPoint& point, const std::vector<bool>& held) {
  if (input.errors != nullptr) {
    return FindSpread(model, point, held,
                      [&](const RowMatrix& rows) { return CovarianceTimes(*input.errors, rows); });
  }
  return FindSpread(model, point, held, VarianceOf(degrees, input.problem, input.end));
}

Spread SpreadOfQuoted(const IntervalWork& work, std::vector<bool> held) {
  const EffectSpan effects = SpanOf(work.input.problem.device);
  const CurveModel internal(work.input.problem);
  const ReportingModel model(internal, effects);
  const std::vector<bool> flat = FindFlatSettings(model, effects, {work.quoted, {}});
  for (int i = 0; i < work.size; ++i) held[i] = held[i] || flat[i];
  return SpreadOfModel(work.input, work.degrees, model, {work.quoted, {}}, held);
}

// Ratio of the standard errors under `errors` to those of the fit itself. The parameters at bounds
// are freed for it. A parameter without a finite ratio gets the largest of the others.
void FindStretch(IntervalWork* work) {
  work->stretch.assign(work->size, 1);
  if (work->input.errors == nullptr) return;
  std::vector<bool> fixed(work->size);
  for (int i = 0; i < work->size; ++i) fixed[i] = !work->estimates[i].free();
  IntervalInput plain = work->input;
  plain.errors = nullptr;
  const Spread own = SpreadOfQuoted(WorkOn(plain, &work->estimates), fixed);
  const Spread under = SpreadOfQuoted(*work, fixed);
  double largest = 1;
  for (int i = 0; i < work->size; ++i) {
    work->stretch[i] = under.standard_error[i] / own.standard_error[i];
    if (std::isfinite(work->stretch[i])) largest = std::max(largest, work->stretch[i]);
  }
  for (double& stretch : work->stretch) stretch = std::isfinite(stretch) ? stretch : largest;
}

Spread UnknownSpread(int size) {
  Spread unknown;
  unknown.standard_error.assign(size, kUnknown);
  unknown.correlation = Eigen::MatrixXd::Zero(size, size);
  return unknown;
}

void MarkBounds(IntervalWork* work) {
  for (int i = 0; i < work->size; ++i) {
    Estimate& e = work->estimates[i];
    if (!e.free()) continue;
    if (work->quoted[i] <= e.bounds.lower) e.at_bound = BoundSide::kLower;
    if (work->quoted[i] >= e.bounds.upper) e.at_bound = BoundSide::kUpper;
  }
}

void SetSymmetric(IntervalWork* work, int i) {
  Estimate& e = work->estimates[i];
  const double reach = work->t[i] * e.standard_error;
  if (!std::isfinite(reach)) return;
  e.interval = IntervalMethod::kSymmetric;
  const ParameterRange range = RangeAround(e.info.kind, work->quoted[i], reach);
  e.low_95 = std::max(range.low, e.bounds.lower);
  e.high_95 = std::min(range.high, e.bounds.upper);
}

bool Coarsened(const IntervalInput& input, const RefineProblem& coarse) {
  return coarse.points.size < input.problem.points.size;
}

RefineOptions HowToRefine(const IntervalInput& input) {
  RefineOptions how;
  how.stop = input.progress.stop();
  return how;
}

// An optimum that is better on coarsened data is accepted only if it is better on all points.
void TakeIfBetter(IntervalWork* work, const std::vector<double>& p) {
  if (p.empty()) return;
  constexpr double kLower = 1e-7;  // relative
  RefineEnd end;
  end.p = p;
  end.mean_square = MeanSquare(work->input.problem, p);
  if (Coarsened(work->input, work->coarse))
    end = Refine(work->input.problem, p, HowToRefine(work->input));
  const double lowest = work->better.empty() ? work->input.end.mean_square * (1 - kLower)
                                             : MeanSquare(work->input.problem, work->better);
  if (end.mean_square < lowest) work->better = end.p;
}

// Cheap solver options for hundreds of refits.
RefineOptions BrieflySmall(const StopToken& stop) {
  RefineOptions how;
  how.small = true;
  how.let_in = false;
  how.max_rounds = 10;
  how.max_iterations = how.first_iterations = 200;
  how.stop = stop;
  return how;
}

void FindMoreOptima(IntervalWork* work) {
  const EffectSpan effects = SpanOf(work->input.problem.device);
  if (effects.effects == nullptr) return;
  const double points = static_cast<double>(work->input.problem.voltage_V.size());
  double reach = 0;
  for (int i = 0; i < work->size; ++i) reach = std::max(reach, work->t[i] * work->stretch[i]);
  const double rise =
      reach * reach * VarianceOf(work->degrees, work->input.problem, work->input.end) / points;
  OptimumQuery query{work->input.end.mean_square + rise, BrieflySmall(work->input.progress.stop())};
  query.how.cutoff = query.highest;
  work->local_optima = FindOtherOptima(CurveModel(work->input.problem), effects, work->input.end,
                                       work->input.ends, query);
  for (const FitPoint& local_optimum : work->local_optima) TakeIfBetter(work, local_optimum.p);
}

bool OfEffect(const IntervalInput& input, int i) { return SpanOf(input.problem.device).Has(i); }

bool BendsWithOthers(const IntervalInput& input, int i) {
  if (!OfEffect(input, i)) return false;
  const DeviceEffects& device_effects = *input.problem.device.effects;
  return OneOfSeveral(device_effects, i - device_effects.law.base_size());
}

bool NeedsProfile(const IntervalWork& work, int i) {
  const Estimate& e = work.estimates[i];
  if (!e.free()) return false;
  const bool any_at_bound =
      std::any_of(work.estimates.begin(), work.estimates.end(),
                  [](const Estimate& other) { return other.at_bound != BoundSide::kNone; });
  if (any_at_bound || e.interval == IntervalMethod::kNone || BendsWithOthers(work.input, i))
    return true;
  if (!work.local_optima.empty()) return true;
  if (e.low_95 <= e.bounds.lower || e.high_95 >= e.bounds.upper) return true;
  return work.t[i] * e.standard_error > kLinearReach * std::fabs(work.quoted[i]);
}

std::vector<ProfileQuery> Queries(const IntervalWork& work, bool saturation_currents) {
  std::vector<ProfileQuery> queries;
  for (int i = 0; i < work.size; ++i) {
    const bool saturation = work.estimates[i].info.kind == ParameterKind::kSaturation;
    if (saturation != saturation_currents || !NeedsProfile(work, i)) continue;
    if (work.estimates[i].interval == IntervalMethod::kProfile) continue;
    for (const bool upper : {false, true}) {
      queries.push_back({i, upper, work.t[i] * work.stretch[i],
                         VarianceOf(work.degrees, work.coarse, work.coarse_end),
                         work.estimates[i].standard_error / work.stretch[i],
                         /*end_at_better=*/!work.input.final && !Coarsened(work.input, work.coarse),
                         work.local_optima});
    }
  }
  return queries;
}

// `better` of the result is in internal units.
ProfileSide SideOf(IntervalWork* work, ProfileQuery query) {
  const StopToken& stop = work->input.progress.stop();
  if (!OfEffect(work->input, query.parameter)) {
    return FindProfileSide(work->coarse, work->coarse_end, query, stop);
  }
  const EffectSpan effects = SpanOf(work->coarse.device);
  const CurveModel internal(work->coarse);
  const ReportingModel model(internal, effects);
  RefineEnd best = work->coarse_end;
  best.p = Reported(effects, std::move(best.p));
  for (FitPoint& other : query.local_optima) other.p = Reported(effects, std::move(other.p));
  ProfileSide side = FindProfileSide(model, best, query, BrieflySmall(stop));
  side.better = Inner(effects, std::move(side.better));
  return side;
}

// Coarsens the data and finds the optimum on them.
void PrepareCoarse(IntervalWork* work) {
  if (!work->coarse_end.p.empty()) return;
  work->coarse = Coarsen(work->input.problem);
  work->coarse_end = Coarsened(work->input, work->coarse)
                         ? Refine(work->coarse, work->input.end.p, HowToRefine(work->input))
                         : work->input.end;
}

void ProfileWhereNeeded(IntervalWork* work, bool saturation_currents) {
  PrepareCoarse(work);
  const std::vector<ProfileQuery> queries = Queries(*work, saturation_currents);
  const int count = static_cast<int>(queries.size());
  if (count == 0) return;
  std::vector<ProfileSide> sides(count);
  std::vector<char> done(count, 0);
  work->input.progress.BeginSilently("intervals", count);
  ParallelFor(count, work->input.threads, [&](int q) {
    if (work->input.progress.Step()) return;
    sides[q] = SideOf(work, queries[q]);
    done[q] = sides[q].settled || !work->input.progress.stop().requested() ? 1 : 0;
  });
  for (int q = 0; q + 1 < count; q += 2) {
    if (!done[q] || !done[q + 1]) continue;
    Estimate& e = work->estimates[queries[q].parameter];
    const bool settled = sides[q].settled && sides[q + 1].settled;
    e.interval = settled ? IntervalMethod::kProfile : IntervalMethod::kUnsettled;
    e.low_95 = sides[q].value;
    e.high_95 = sides[q + 1].value;
    for (const ProfileSide* side : {&sides[q], &sides[q + 1]}) TakeIfBetter(work, side->better);
  }
}

// Marks diodes that the data allow to be absent as not identifiable; their n may then have any
// value.
void MarkAbsentDiodes(IntervalWork* work) {
  for (int d = 0; d < DiodeCount(work->input.problem.device); ++d) {
    Estimate& is = work->estimates[SaturationCurrentIndex(d)];
    Estimate& n = work->estimates[IdealityIndex(d)];
    const bool absent = work->input.end.p[SaturationCurrentIndex(d)] <= 0;
    const bool may_be_absent =
        is.interval == IntervalMethod::kProfile && is.low_95 <= 0 && !is.fixed;
    if (!absent && !may_be_absent) continue;
    is.identifiable = false;
    is.reason =
        absent ? "the best fit has no such diode" : "the data allow this diode to be absent";
    if (n.fixed) continue;
    n.identifiable = false;
    n.reason = fmt::format("{} may be 0", is.info.symbol);
    n.interval = IntervalMethod::kProfile;
    n.low_95 = n.bounds.lower;
    n.high_95 = n.bounds.upper;
    if (absent) n.at_bound = BoundSide::kNone;
  }
}

// Whether the interval of a parameter of an effect ends at a bound. The neutral value as a bound
// does not count: there the effect is absent, which is a valid result.
bool LeavesAnEndOpen(const IntervalWork& work, int i) {
  const Estimate& e = work.estimates[i];
  if (!OfEffect(work.input, i)) return false;
  const double neutral = work.neutral[i];
  return (e.low_95 <= e.bounds.lower && e.bounds.lower != neutral) ||
         (e.high_95 >= e.bounds.upper && e.bounds.upper != neutral);
}

void MarkUnidentifiable(IntervalWork* work) {
  for (int i = 0; i < work->size; ++i) {
    Estimate& e = work->estimates[i];
    if (!e.free() || !e.identifiable) continue;
    const bool profiled =
        e.interval == IntervalMethod::kProfile || e.interval == IntervalMethod::kUnsettled;
    if (profiled && e.low_95 <= e.bounds.lower && e.high_95 >= e.bounds.upper) {
      e.identifiable = false;
      e.reason = "the data allow its whole range";
    } else if (profiled && LeavesAnEndOpen(*work, i)) {
      e.identifiable = false;
      e.reason = fmt::format("only {} limit is known: the data allow it to the end of its range",
                             e.low_95 <= e.bounds.lower ? "an upper" : "a lower");
    } else if (e.info.kind == ParameterKind::kShunt && e.high_95 >= e.bounds.upper) {
      e.identifiable = false;
      e.reason = "no shunt is visible: only a lower limit is known";
    } else if (e.interval == IntervalMethod::kNone && e.at_bound == BoundSide::kNone) {
      e.identifiable = false;
      e.reason = "the data do not fix it: another parameter takes its place exactly";
    }
  }
}

void FindCorrelations(IntervalWork* work, const Spread& spread,
                      std::vector<Correlation>* correlations) {
  for (int i = 0; i < work->size; ++i) {
    for (int j = i + 1; j < work->size; ++j) {
      const double value = spread.correlation(i, j);
      if (std::fabs(value) <= kStrongCorrelation) continue;
      correlations->push_back(
          {work->estimates[i].info.symbol, work->estimates[j].info.symbol, value});
    }
  }
  std::stable_sort(correlations->begin(), correlations->end(), [](const auto& a, const auto& b) {
    return std::fabs(a.value) > std::fabs(b.value);
  });
}

std::vector<double> FindAll(IntervalWork* work, std::vector<Correlation>* correlations,
                            double* condition) {
  MarkBounds(work);
  if (work->input.method == Intervals::kNone) return {};
  Spread spread = SpreadOfQuoted(*work, work->input.end.held);
  // If a direction is undetermined, linear standard errors are unreliable for all parameters;
  // profiles are used.
  if (spread.open.cols() > 0) spread = UnknownSpread(work->size);
  *condition = spread.condition;
  for (int i = 0; i < work->size; ++i) {
    work->estimates[i].standard_error = spread.standard_error[i];
    if (work->estimates[i].free()) SetSymmetric(work, i);
  }
  FindStretch(work);
  FindCorrelations(work, spread, correlations);
  if (work->input.method == Intervals::kProfile && ResidualsAreNoise(work->input)) {
    FindMoreOptima(work);
    ProfileWhereNeeded(work, /*saturation_currents=*/true);
    MarkAbsentDiodes(work);
    ProfileWhereNeeded(work, /*saturation_currents=*/false);
  }
  MarkUnidentifiable(work);
  return work->better;
}

}  // namespace

std::vector<double> StandardErrors(const IntervalInput& input) {
  std::vector<Estimate> estimates(input.problem.device.size());
  return SpreadOfQuoted(WorkOn(input, &estimates), input.end.held).standard_error;
}

std::vector<double> FindIntervals(const IntervalInput& input, std::vector<Estimate>* estimates,
                                  std::vector<Correlation>* correlations, double* condition) {
  IntervalWork work = WorkOn(input, estimates);
  return FindAll(&work, correlations, condition);
}

}  // namespace lyrefit
