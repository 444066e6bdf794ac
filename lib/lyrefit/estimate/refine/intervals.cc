#include "lyrefit/estimate/refine/intervals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/parallel.h"

namespace lyrefit {
namespace {

constexpr double kStrongCorrelation = 0.9;

// Largest half-width of a symmetric interval, relative to the value (of a saturation current, of
// its logarithm). Beyond it the nonlinearity of the model makes the interval invalid.
constexpr double kLinearReach = 0.3;

bool IsSaturation(const Estimate& e) { return e.info.kind == ParameterKind::kSaturation; }

// Values of all parameters with those of effects at absence: its neutral value for the strength of
// an effect, the start value for the others.
std::vector<double> NeutralValues(const IntervalProblem& problem) {
  std::vector<double> p;
  p.reserve(problem.estimates.size());
  for (const Estimate& e : problem.estimates) p.push_back(e.refined);
  if (problem.effects.effects == nullptr) return p;
  auto next = p.begin() + problem.effects.first;
  for (const EffectUse& use : problem.effects.effects->uses) {
    for (const EffectParameter& info : use.effect->parameters) *next++ = info.neutral;
  }
  return Reported(problem.effects, std::move(p));
}

class Finder {
 public:
  Finder(IntervalProblem problem, const ProgressReporter& progress)
      : problem_(std::move(problem)),
        progress_(progress),
        size_(static_cast<int>(problem_.estimates.size())),
        neutral_(NeutralValues(problem_)) {
    found_.estimates = std::move(problem_.estimates);
  }

  IntervalReport Find() {
    MarkBounds();
    if (problem_.last == IntervalStep::kBounds) return std::move(found_);
    SetErrors();
    if (problem_.last >= IntervalStep::kSymmetric) {
      for (int i = 0; i < size_; ++i) SetSymmetric(i);
      FindCorrelations();
    }
    const bool profiles = problem_.last == IntervalStep::kProfile;
    if (profiles) ProfileWhereNeeded(/*saturation_currents=*/true);
    if (profiles || !problem_.rules.thorough) MarkAbsentDiodes();
    if (profiles) ProfileWhereNeeded(/*saturation_currents=*/false);
    MarkUnidentifiable();
    return std::move(found_);
  }

 private:
  Estimate& At(int i) { return found_.estimates[i]; }
  const Estimate& At(int i) const { return found_.estimates[i]; }
  double Stretch(int i) const { return problem_.stretch.empty() ? 1 : problem_.stretch[i]; }

  // The active bound of a parameter: the nearer one, on the parameter's scale.
  BoundSide SideOf(int i) const {
    const Estimate& e = At(i);
    if (!e.free() || !problem_.active[i]) return BoundSide::kNone;
    if (e.refined >= e.bounds.upper) return BoundSide::kUpper;
    if (e.refined <= e.bounds.lower) return BoundSide::kLower;
    if (e.info.kind == ParameterKind::kDarkShunt) {
      // The range of a dark shunt is relative to the shunt at the reference.
      return e.refined > 1.5 * At(e.info.with[0]).refined ? BoundSide::kUpper : BoundSide::kLower;
    }
    const auto scaled = [&](double value) {
      return IsConductance(e.info.kind) ? 1 / value : value;
    };
    const double to_lower = std::fabs(scaled(e.refined) - scaled(e.bounds.lower));
    const double to_upper = std::fabs(scaled(e.refined) - scaled(e.bounds.upper));
    return to_lower < to_upper ? BoundSide::kLower : BoundSide::kUpper;
  }

  void MarkBounds() {
    for (int i = 0; i < size_; ++i) At(i).at_bound = SideOf(i);
    // The ideality of a dropped diode is fixed at any value.
    for (int i = 0; i < size_; ++i) {
      if (!IsSaturation(At(i)) || !IsDropped(i)) continue;
      Estimate& n = At(At(i).info.with[0]);
      if (n.refined > n.bounds.lower && n.refined < n.bounds.upper) n.at_bound = BoundSide::kNone;
    }
  }

  // Whether the best fit has no diode of this saturation current. A fit of many curves gives it a
  // negligible one.
  bool IsDropped(int i) const {
    const Estimate& e = At(i);
    return e.refined <= 0 ||
           (problem_.active[i] && e.bounds.lower <= 0 && e.at_bound == BoundSide::kLower);
  }

  void SetErrors() {
    found_.condition = problem_.spread.condition;
    const bool unknown = problem_.rules.thorough && problem_.spread.open.cols() > 0;
    if (unknown) {
      problem_.spread.correlation.setZero();
      found_.condition = 1;
    }
    for (int i = 0; i < size_; ++i) {
      if (!unknown) At(i).standard_error = problem_.spread.standard_error[i];
    }
  }

  void SetSymmetric(int i) {
    Estimate& e = At(i);
    if (!e.free() || !std::isfinite(problem_.t[i] * e.standard_error)) return;
    e.interval = IntervalMethod::kSymmetric;
    const ParameterRange range =
        SymmetricRange(e.info.kind, e.refined, e.standard_error, problem_.t[i], e.bounds);
    e.low_95 = range.low;
    e.high_95 = range.high;
  }

  void FindCorrelations() {
    const auto symbol = [&](int i) {
      return i < size_ ? At(i).info.symbol : problem_.further[i - size_];
    };
    const int count = static_cast<int>(problem_.spread.correlation.rows());
    for (int i = 0; i < count; ++i) {
      for (int j = i + 1; j < count; ++j) {
        const double value = problem_.spread.correlation(i, j);
        if (std::fabs(value) <= kStrongCorrelation) continue;
        found_.correlations.push_back({symbol(i), symbol(j), value});
      }
    }
    std::stable_sort(found_.correlations.begin(), found_.correlations.end(),
                     [](const Correlation& a, const Correlation& b) {
                       return std::fabs(a.value) > std::fabs(b.value);
                     });
  }

  bool IsOneOfSeveral(int i) const {
    const EffectSpan& effects = problem_.effects;
    return effects.Has(i) && OneOfSeveral(*effects.effects, i - effects.first);
  }

  bool NeedsProfile(int i) const {
    const Estimate& e = At(i);
    const bool thorough = problem_.rules.thorough;
    if (!e.free() || e.interval == IntervalMethod::kProfile) return false;
    if (!thorough && IsSaturation(e) && problem_.active[i]) return false;
    if (problem_.several_optima || IsOneOfSeveral(i) || e.at_bound != BoundSide::kNone) return true;
    if (e.interval == IntervalMethod::kNone) return thorough;
    if (thorough && std::any_of(found_.estimates.begin(), found_.estimates.end(),
                                [](const auto& o) { return o.at_bound != BoundSide::kNone; })) {
      return true;
    }
    if (e.low_95 <= e.bounds.lower || e.high_95 >= e.bounds.upper) return true;
    // A value of either sign may be near 0.
    if (!thorough && e.bounds.lower < 0) return false;
    return problem_.t[i] * e.standard_error > kLinearReach * std::fabs(e.refined);
  }

  std::vector<ProfileQuery> Queries(bool saturation_currents) const {
    std::vector<ProfileQuery> queries;
    for (int i = 0; i < size_; ++i) {
      if (IsSaturation(At(i)) != saturation_currents || !NeedsProfile(i)) continue;
      for (const bool upper : {false, true}) {
        queries.push_back({i, upper, problem_.t[i] * Stretch(i), problem_.variance,
                           At(i).standard_error / Stretch(i), problem_.end_at_better});
      }
    }
    return queries;
  }

  void ProfileWhereNeeded(bool saturation_currents) {
    const std::vector<ProfileQuery> queries = Queries(saturation_currents);
    const int count = static_cast<int>(queries.size());
    if (count == 0) return;
    std::vector<ProfileSide> sides(count);
    std::vector<char> done(count, 0);
    progress_.BeginSilently("intervals", count);
    ParallelFor(count, problem_.threads, [&](int q) {
      if (progress_.Step()) return;
      sides[q] = problem_.profile(queries[q]);
      done[q] = sides[q].settled || !progress_.stop().requested() ? 1 : 0;
    });
    for (int q = 0; q + 1 < count; q += 2) {
      if (done[q] && done[q + 1]) SetProfile(queries[q].parameter, &sides[q], &sides[q + 1]);
    }
  }

  void SetProfile(int i, ProfileSide* low, ProfileSide* high) {
    Estimate& e = At(i);
    e.interval =
        low->settled && high->settled ? IntervalMethod::kProfile : IntervalMethod::kUnsettled;
    e.low_95 = std::max(low->value, e.bounds.lower);
    // The largest resistance of a fit is finite and counts as the bound.
    e.high_95 = high->at_bound && IsConductance(e.info.kind) ? e.bounds.upper : high->value;
    for (ProfileSide* side : {low, high}) {
      if (!side->better.empty()) found_.better.push_back(std::move(side->better));
    }
  }

  bool MayBeAbsent(int i) const {
    const Estimate& is = At(i);
    const bool profiled =
        is.interval == IntervalMethod::kProfile || is.interval == IntervalMethod::kUnsettled;
    return problem_.rules.judge_absent_diodes && is.low_95 <= 0 && profiled && !is.fixed;
  }

  // Marks diodes that the data allow to be absent as not identifiable; their n may then have any
  // value. Of several, each may be absent where another can take its place, but not all: the first
  // remains.
  void MarkAbsentDiodes() {
    int diodes = 0;
    bool remains = false;
    for (int i = 0; i < size_; ++i) {
      if (!IsSaturation(At(i))) continue;
      ++diodes;
      remains = remains || (!IsDropped(i) && !MayBeAbsent(i));
    }
    remains = remains || diodes < 2;
    for (int i = 0; i < size_; ++i) {
      Estimate& is = At(i);
      if (!IsSaturation(is)) continue;
      const bool absent = IsDropped(i);
      if (!absent && !remains) {
        remains = true;
        continue;
      }
      if (!absent && !MayBeAbsent(i)) continue;
      is.identifiable = false;
      is.reason =
          absent ? "the best fit has no such diode" : "the data allow this diode to be absent";
      Estimate& n = At(is.info.with[0]);
      if (n.fixed) continue;
      n.identifiable = false;
      n.reason = fmt::format("{} may be 0", is.info.symbol);
      if (absent) n.at_bound = BoundSide::kNone;
      if (problem_.last < IntervalStep::kProfile) continue;
      n.interval = IntervalMethod::kProfile;
      n.low_95 = n.bounds.lower;
      n.high_95 = n.bounds.upper;
    }
  }

  bool LeavesAnEndOpen(int i) const {
    const Estimate& e = At(i);
    if (!problem_.rules.judge_open_ends || !problem_.effects.Has(i)) return false;
    return (e.low_95 <= e.bounds.lower && e.bounds.lower != neutral_[i]) ||
           (e.high_95 >= e.bounds.upper && e.bounds.upper != neutral_[i]);
  }

  // Why a parameter is not identifiable; empty: it is.
  std::string WhyUnidentifiable(int i) const {
    const Estimate& e = At(i);
    const bool profiled =
        e.interval == IntervalMethod::kProfile || e.interval == IntervalMethod::kUnsettled;
    const bool low = e.low_95 <= e.bounds.lower, high = e.high_95 >= e.bounds.upper;
    if (profiled && low && high) return "the data allow its whole range";
    if (profiled && LeavesAnEndOpen(i)) {
      return fmt::format("only {} limit is known: the data allow it to the end of its range",
                         low ? "an upper" : "a lower");
    }
    if (IsConductance(e.info.kind) && high) return problem_.rules.no_shunt;
    const bool unknown = !std::isfinite(problem_.t[i] * e.standard_error) &&
                         (e.interval == IntervalMethod::kNone || !problem_.rules.thorough);
    return unknown && e.at_bound == BoundSide::kNone ? problem_.rules.undetermined : "";
  }

  void MarkUnidentifiable() {
    for (int i = 0; i < size_; ++i) {
      Estimate& e = At(i);
      if (!e.free() || !e.identifiable) continue;
      e.reason = WhyUnidentifiable(i);
      e.identifiable = e.reason.empty();
    }
  }

  IntervalProblem problem_;
  const ProgressReporter& progress_;
  const int size_;
  const std::vector<double> neutral_;
  IntervalReport found_;
};

}  // namespace

ParameterRange SymmetricRange(ParameterKind kind, double value, double standard_error, double t,
                              const ParameterBounds& bounds) {
  if (!std::isfinite(standard_error)) return {kUnknown, kUnknown};
  const ParameterRange range = RangeAround(kind, value, t * standard_error);
  return {std::max(range.low, bounds.lower), std::min(range.high, bounds.upper)};
}

std::vector<Estimate> MakeEstimates(const std::vector<ParameterInfo>& infos,
                                    const std::vector<double>& lower,
                                    const std::vector<double>& upper) {
  std::vector<Estimate> estimates(infos.size());
  for (std::size_t i = 0; i < infos.size(); ++i) {
    estimates[i].info = infos[i];
    estimates[i].bounds.lower = lower[i];
    estimates[i].bounds.upper = upper[i];
    estimates[i].fixed = lower[i] == upper[i];
  }
  return estimates;
}

std::vector<Estimate> WithValues(std::vector<Estimate> estimates,
                                 const std::vector<double>& searched,
                                 const std::vector<double>& refined) {
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    if (!searched.empty()) estimates[i].searched = searched[i];
    estimates[i].refined = refined[i];
  }
  return estimates;
}

IntervalReport FindIntervals(IntervalProblem problem, const ProgressReporter& progress) {
  return Finder(std::move(problem), progress).Find();
}

}  // namespace lyrefit
