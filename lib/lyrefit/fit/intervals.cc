#include "lyrefit/fit/intervals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/parallel.h"
#include "lyrefit/fit/quoted_model.h"
#include "lyrefit/fit/statistics.h"
#include "lyrefit/law/extension.h"
#include "lyrefit/law/quote.h"
#include "lyrefit/refine/curve_model.h"
#include "lyrefit/refine/error_model.h"
#include "lyrefit/refine/profile.h"
#include "lyrefit/refine/spread.h"
#include "lyrefit/refine/thin.h"

namespace lyrefit {
namespace {

constexpr double kStrongCorrelation = 0.9;

// How far a symmetric interval may reach, in parts of the value (of a saturation current, in its
// logarithm), before the curve of the model makes it false.
constexpr double kLinearReach = 0.3;

// `p` with every effect's parameters where they start or the effect is not there.
std::vector<double> Neutral(const Device& device, std::vector<double> p) {
  if (device.extension == nullptr) return p;
  auto next = p.begin() + device.extension->law.base_size();
  for (const EffectUse& use : device.extension->uses) {
    for (const EffectParameter& info : use.effect->parameters) *next++ = info.neutral;
  }
  return p;
}

class IntervalFinder {
 public:
  IntervalFinder(const IntervalInput& input, std::vector<Estimate>* estimates)
      : input_(input),
        estimates_(*estimates),
        size_(static_cast<int>(estimates->size())),
        quoted_(Reported(input.problem.device, input.end.p)),
        neutral_(Reported(input.problem.device, Neutral(input.problem.device, input.end.p))) {
    const int points = static_cast<int>(input.problem.voltage_V.size());
    degrees_ = std::max(points - input.free_parameters, 1);
    for (int i = 0; i < size_; ++i) {
      t_.push_back(StudentT95(input.degrees.empty() ? degrees_ : input.degrees[i]));
    }
  }

  std::vector<double> Run(std::vector<Correlation>* correlations, double* condition) {
    MarkBounds();
    if (input_.method == Intervals::kNone) return {};
    Spread spread = SpreadOfQuoted(input_.end.held);
    // Where a direction is open, one curve's straight lines say little of the others: profiles do.
    if (spread.open.cols() > 0) spread = Unknown();
    *condition = spread.condition;
    for (int i = 0; i < size_; ++i) {
      estimates_[i].standard_error = spread.standard_error[i];
      if (estimates_[i].free()) Symmetric(i);
    }
    FindStretch();
    FindCorrelations(spread, correlations);
    if (input_.method == Intervals::kProfile && ResidualsAreNoise()) {
      FindOtherValleys();
      ProfileWhereNeeded(/*saturation_currents=*/true);
      MarkAbsentDiodes();
      ProfileWhereNeeded(/*saturation_currents=*/false);
    }
    MarkUnidentifiable();
    return better_;
  }

  std::vector<double> StandardErrors() const {
    return SpreadOfQuoted(input_.end.held).standard_error;
  }

 private:
  // A profile measures residuals against residuals: with none but rounding it has nothing to
  // measure.
  bool ResidualsAreNoise() const {
    return std::sqrt(input_.end.mean_square) > 1e-11 * input_.problem.current_scale_A;
  }

  Spread SpreadOfQuoted(std::vector<bool> held) const {
    if (input_.problem.device.extension == nullptr) {
      return SpreadOfModel(CurveModel(input_.problem), input_.end, held);
    }
    const std::vector<bool> flat = FindFlat(input_.problem, quoted_);
    for (int i = 0; i < size_; ++i) held[i] = held[i] || flat[i];
    return SpreadOfModel(QuotedModel(input_.problem), {quoted_, {}}, held);
  }

  Spread SpreadOfModel(const FitModel& model, const FitPoint& point,
                       const std::vector<bool>& held) const {
    if (input_.errors != nullptr) {
      return FindSpread(model, point, held, [this](const RowMatrix& rows) {
        return CovarianceTimes(*input_.errors, rows);
      });
    }
    return FindSpread(model, point, held, Variance(input_.problem, input_.end));
  }

  // By how much the errors stretch what the fit itself would say; of a parameter at its bound by
  // how much they would if it were not there, or at most stretch the others.
  void FindStretch() {
    stretch_.assign(size_, 1);
    if (input_.errors == nullptr) return;
    std::vector<bool> fixed(size_);
    for (int i = 0; i < size_; ++i) fixed[i] = !estimates_[i].free();
    IntervalInput plain = input_;
    plain.errors = nullptr;
    const Spread own = IntervalFinder(plain, &estimates_).SpreadOfQuoted(fixed);
    const Spread under = SpreadOfQuoted(fixed);
    double largest = 1;
    for (int i = 0; i < size_; ++i) {
      stretch_[i] = under.standard_error[i] / own.standard_error[i];
      if (std::isfinite(stretch_[i])) largest = std::max(largest, stretch_[i]);
    }
    for (double& stretch : stretch_) stretch = std::isfinite(stretch) ? stretch : largest;
  }

  Spread Unknown() const {
    Spread unknown;
    unknown.standard_error.assign(size_, kUnknown);
    unknown.correlation = Eigen::MatrixXd::Zero(size_, size_);
    return unknown;
  }

  // Of a residual of weight 1; few points stand for many, and count as them.
  double Variance(const RefineProblem& problem, const RefineEnd& end) const {
    if (problem.errors != nullptr) return problem.noise_A * problem.noise_A;  // as it is believed
    return end.mean_square * static_cast<double>(problem.voltage_V.size()) / degrees_;
  }

  void MarkBounds() {
    for (int i = 0; i < size_; ++i) {
      Estimate& e = estimates_[i];
      if (!e.free()) continue;
      if (quoted_[i] <= e.bounds.lower) e.at_bound = BoundSide::kLower;
      if (quoted_[i] >= e.bounds.upper) e.at_bound = BoundSide::kUpper;
    }
  }

  void Symmetric(int i) {
    Estimate& e = estimates_[i];
    const double reach = t_[i] * e.standard_error;
    if (!std::isfinite(reach)) return;
    e.interval = IntervalMethod::kSymmetric;
    const ParameterRange range = RangeAround(e.info.kind, quoted_[i], reach);
    e.low_95 = std::max(range.low, e.bounds.lower);
    e.high_95 = std::min(range.high, e.bounds.upper);
  }

  bool NeedsProfile(int i) const {
    const Estimate& e = estimates_[i];
    if (!e.free()) return false;
    const bool any_at_bound =
        std::any_of(estimates_.begin(), estimates_.end(),
                    [](const Estimate& other) { return other.at_bound != BoundSide::kNone; });
    if (any_at_bound || e.interval == IntervalMethod::kNone || BendsWithOthers(i)) return true;
    if (!valleys_.empty()) return true;
    if (e.low_95 <= e.bounds.lower || e.high_95 >= e.bounds.upper) return true;
    return t_[i] * e.standard_error > kLinearReach * std::fabs(quoted_[i]);
  }

  std::vector<ProfileQuery> Queries(bool saturation_currents) const {
    std::vector<ProfileQuery> queries;
    for (int i = 0; i < size_; ++i) {
      const bool saturation = estimates_[i].info.kind == ParameterKind::kSaturation;
      if (saturation != saturation_currents || !NeedsProfile(i)) continue;
      if (estimates_[i].interval == IntervalMethod::kProfile) continue;
      for (const bool upper : {false, true}) {
        queries.push_back({i, upper, t_[i] * stretch_[i], Variance(few_, few_end_),
                           estimates_[i].standard_error / stretch_[i],
                           /*end_at_better=*/!input_.final && !Thinned(), valleys_});
      }
    }
    return queries;
  }

  void FindOtherValleys() {
    if (input_.problem.device.extension == nullptr) return;
    const double points = static_cast<double>(input_.problem.voltage_V.size());
    double reach = 0;
    for (int i = 0; i < size_; ++i) reach = std::max(reach, t_[i] * stretch_[i]);
    const double rise = reach * reach * Variance(input_.problem, input_.end) / points;
    valleys_ = FindValleys(input_.problem, input_.end, input_.ends, input_.end.mean_square + rise,
                           input_.watch->stop());
    for (const FitPoint& valley : valleys_) TakeIfBetter(valley.p);
  }

  void ProfileWhereNeeded(bool saturation_currents) {
    PrepareFew();
    const std::vector<ProfileQuery> queries = Queries(saturation_currents);
    const int count = static_cast<int>(queries.size());
    if (count == 0) return;
    std::vector<ProfileSide> sides(count);
    std::vector<char> done(count, 0);
    input_.watch->Begin("intervals", count);
    ParallelFor(count, input_.threads, [&](int q) {
      if (input_.watch->Next()) return;
      sides[q] = SideOf(queries[q]);
      done[q] = sides[q].settled || !input_.watch->stopped() ? 1 : 0;
    });
    for (int q = 0; q + 1 < count; q += 2) {
      if (!done[q] || !done[q + 1]) continue;
      Estimate& e = estimates_[queries[q].parameter];
      const bool settled = sides[q].settled && sides[q + 1].settled;
      e.interval = settled ? IntervalMethod::kProfile : IntervalMethod::kUnsettled;
      e.low_95 = sides[q].value;
      e.high_95 = sides[q + 1].value;
      for (const ProfileSide* side : {&sides[q], &sides[q + 1]}) TakeIfBetter(side->better);
    }
  }

  bool OfEffect(int i) const {
    const Extension* extension = input_.problem.device.extension.get();
    return extension != nullptr && i >= extension->law.base_size();
  }

  bool BendsWithOthers(int i) const {
    if (!OfEffect(i)) return false;
    const Extension& extension = *input_.problem.device.extension;
    return OneOfSeveral(extension, i - extension.law.base_size());
  }

  ProfileSide SideOf(const ProfileQuery& query) {
    const auto stop = input_.watch->stop();
    return OfEffect(query.parameter) ? FindQuotedSide(few_, few_end_, query, stop)
                                     : FindProfileSide(few_, few_end_, query, stop);
  }

  bool Thinned() const { return few_.points.size < input_.problem.points.size; }

  // The few points that stand for many, and the optimum on them.
  void PrepareFew() {
    if (!few_end_.p.empty()) return;
    few_ = Thin(input_.problem);
    few_end_ = Thinned() ? Refine(few_, input_.end.p, HowToRefine()) : input_.end;
  }

  RefineOptions HowToRefine() const {
    RefineOptions how;
    how.stop = input_.watch->stop();
    return how;
  }

  // What is better on few points must be better on all.
  void TakeIfBetter(const std::vector<double>& p) {
    if (p.empty()) return;
    constexpr double kLower = 1e-7;  // relative
    RefineEnd end;
    end.p = p;
    end.mean_square = MeanSquare(input_.problem, p);
    if (Thinned()) end = Refine(input_.problem, p, HowToRefine());
    const double lowest = better_.empty() ? input_.end.mean_square * (1 - kLower)
                                          : MeanSquare(input_.problem, better_);
    if (end.mean_square < lowest) better_ = end.p;
  }

  // A diode that the data allow to be absent says nothing about its n.
  void MarkAbsentDiodes() {
    for (int d = 0; d < DiodeCount(input_.problem.device); ++d) {
      Estimate& is = estimates_[SaturationCurrentIndex(d)];
      Estimate& n = estimates_[IdealityIndex(d)];
      const bool absent = input_.end.p[SaturationCurrentIndex(d)] <= 0;
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

  // An effect's parameter may lie as far out as it is allowed to. Where that is where the effect is
  // not there, it is an answer.
  bool LeavesAnEndOpen(int i) const {
    const Estimate& e = estimates_[i];
    if (!OfEffect(i)) return false;
    const double neutral = neutral_[i];
    return (e.low_95 <= e.bounds.lower && e.bounds.lower != neutral) ||
           (e.high_95 >= e.bounds.upper && e.bounds.upper != neutral);
  }

  void MarkUnidentifiable() {
    for (int i = 0; i < size_; ++i) {
      Estimate& e = estimates_[i];
      if (!e.free() || !e.identifiable) continue;
      const bool profiled =
          e.interval == IntervalMethod::kProfile || e.interval == IntervalMethod::kUnsettled;
      if (profiled && e.low_95 <= e.bounds.lower && e.high_95 >= e.bounds.upper) {
        e.identifiable = false;
        e.reason = "the data allow its whole range";
      } else if (profiled && LeavesAnEndOpen(i)) {
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

  void FindCorrelations(const Spread& spread, std::vector<Correlation>* correlations) {
    for (int i = 0; i < size_; ++i) {
      for (int j = i + 1; j < size_; ++j) {
        const double value = spread.correlation(i, j);
        if (std::fabs(value) <= kStrongCorrelation) continue;
        correlations->push_back({estimates_[i].info.symbol, estimates_[j].info.symbol, value});
      }
    }
    std::stable_sort(correlations->begin(), correlations->end(), [](const auto& a, const auto& b) {
      return std::fabs(a.value) > std::fabs(b.value);
    });
  }

  const IntervalInput& input_;
  std::vector<Estimate>& estimates_;
  const int size_;
  const std::vector<double> quoted_;   // the end, as it is reported
  const std::vector<double> neutral_;  // of effects' parameters, likewise
  int degrees_ = 1;
  std::vector<double> t_;        // Student's, of each estimate
  std::vector<double> stretch_;  // of t, by the errors
  RefineProblem few_;
  RefineEnd few_end_;
  std::vector<FitPoint> valleys_;  // what fits as well
  std::vector<double> better_;
};

}  // namespace

std::vector<double> StandardErrors(const IntervalInput& input) {
  std::vector<Estimate> estimates(input.problem.device.size());
  return IntervalFinder(input, &estimates).StandardErrors();
}

std::vector<double> FindIntervals(const IntervalInput& input, std::vector<Estimate>* estimates,
                                  std::vector<Correlation>* correlations, double* condition) {
  return IntervalFinder(input, estimates).Run(correlations, condition);
}

}  // namespace lyrefit
