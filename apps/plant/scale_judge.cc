#include "plant/scale_judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "lyrefit/base/append.h"
#include "lyrefit/base/constants.h"
#include "lyrefit/batch/column.h"

namespace lyrefit {
namespace {

// Errors of a whole combiner against its plan: a light sensor within 2.5 % with dirt and current
// classes; temperature within 1.5 K and a Voc of the data sheet within 0.6 %; what one diode through
// the data sheet misses at another light; cables.
constexpr ScaleVector kPlanErrors = {0.030, 0.0075, 0.025, 0.020, 0.15};
constexpr double kPlanDegrees = 30;

// Odds of exchanged strings to a fault of one, where both fit the plan of the other; and where more
// than one string fits it, of which one was exchanged.
constexpr double kExchangedOdds = 20;
constexpr double kUnclearOdds = 0.1;
constexpr double kExchangedFit = 0.01;  // least p-value of both

// A string with what is said of it.
struct Judged {
  ScaleVerdict verdict;
  ScaleVector deviation{};
  bool shared = false;  // of all strings of the combiner
  std::string partner;
};

ScaleContext ContextOf(const ScaleMember& member, const ScaleResidual& residual) {
  ScaleContext context;
  context.expected = residual.expected;
  context.cells = member.cells;
  context.temperature_K = member.temperature_C + kZeroCelsius_K;
  context.modules = member.modules;
  context.strings = member.strings;
  context.bypass_diodes = member.bypass_diodes;
  return context;
}

bool SamePlan(const ScaleMember& one, const ScaleMember& other) {
  return one.modules == other.modules && one.strings == other.strings &&
         one.module == other.module && one.cells == other.cells;
}

// What the logarithms of a string change by if it is built as `other`. Without data sheets the
// modules are of one type.
ScaleVector BuiltAs(const ScaleMember& other, const ScaleMember& one) {
  if (!one.IsPlanned() || !other.IsPlanned()) {
    ScaleVector shift{};
    const auto series = [](const ScaleMember& m) { return m.modules > 0 ? m.modules : m.cells; };
    shift[kScaleIsc] = std::log(std::max(other.strings, 1)) - std::log(std::max(one.strings, 1));
    shift[kScaleVoc] = std::log(series(other) / series(one));
    return shift;
  }
  const ScaleDevice device(other.planned, static_cast<int>(other.cells),
                           other.temperature_C + kZeroCelsius_K);
  ScaleVector logs = LogsOf(other.planned);
  const ScaleVector light = device.ByLight(one.irradiance_W_m2 / other.irradiance_W_m2);
  const ScaleVector warmth = device.ByWarmth(one.temperature_C - other.temperature_C);
  for (int q = 0; q < kScaleQuantities; ++q) logs[q] += light[q] + warmth[q];
  return Difference(logs, LogsOf(one.planned));
}

// Judges the strings of one combiner.
class GroupJudge {
 public:
  GroupJudge(const std::vector<ScaleMember>& group, const std::vector<ScaleResidual>& residuals,
             const ScaleErrors& errors, double level)
      : group_(group), residuals_(residuals), errors_(errors), level_(level) {}

  Judged Judge(std::size_t i) const {
    Judged judged = JudgeOwn(i);
    if (judged.verdict.cause != ScaleCause::kNone) return judged;
    if (!group_[i].IsPlanned() || residuals_[i].peers == 0) return judged;
    ScaleContext context = ContextOf(group_[i], residuals_[i]);
    context.shared = true;
    const ScaleErrors plan = {kPlanErrors, kPlanDegrees};
    const ScaleVector& common = residuals_[i].common;
    if (HealthyPValue(common, plan) >= level_) return judged;
    const ScaleVerdict verdict = JudgeScale(common, plan, HypothesesFor(context), level_);
    if (verdict.cause == ScaleCause::kNone) return judged;
    return {verdict, common, true, ""};
  }

 private:
  // Errors of a string without peers are those of the plan too.
  ScaleErrors ErrorsFor(std::size_t i) const {
    if (residuals_[i].peers > 0) return errors_;
    ScaleErrors errors = {kPlanErrors, kPlanDegrees};
    for (int q = 0; q < kScaleQuantities; ++q) {
      errors.sizes[q] = std::hypot(errors.sizes[q], errors_.sizes[q]);
    }
    return errors;
  }

  const ScaleVector& DeviationOf(std::size_t i) const {
    return residuals_[i].peers > 0 ? residuals_[i].deviation : residuals_[i].residual;
  }

  bool CanJudge(std::size_t i) const {
    return group_[i].IsMeasured() && group_[i].own_cause.empty() &&
           (residuals_[i].peers > 0 || group_[i].IsPlanned());
  }

  // Other strings of the combiner whose plan this one fits, and which fit the plan of this one.
  std::vector<std::size_t> PartnersOf(std::size_t i) const {
    std::vector<std::size_t> partners;
    for (std::size_t j = 0; j < group_.size(); ++j) {
      const bool other = j != i && CanJudge(j) && group_[j].IsPlanned() == group_[i].IsPlanned() &&
                         !SamePlan(group_[i], group_[j]) &&
                         HealthyPValue(DeviationOf(j), ErrorsFor(j)) < level_;
      if (!other) continue;
      const auto fits = [&](std::size_t one, std::size_t of) {
        const ScaleVector shift = BuiltAs(group_[of], group_[one]);
        return HealthyPValue(Difference(DeviationOf(one), shift), ErrorsFor(one)) > kExchangedFit;
      };
      if (fits(i, j) && fits(j, i)) partners.push_back(j);
    }
    return partners;
  }

  Judged JudgeOwn(std::size_t i) const {
    Judged judged;
    if (!CanJudge(i)) return judged;
    judged.deviation = DeviationOf(i);
    const ScaleErrors errors = ErrorsFor(i);
    judged.verdict.p_value = HealthyPValue(judged.deviation, errors);
    if (!(judged.verdict.p_value < level_)) return judged;
    std::vector<ScaleHypothesis> hypotheses = HypothesesFor(ContextOf(group_[i], residuals_[i]));
    const std::vector<std::size_t> partners = PartnersOf(i);
    if (!partners.empty()) {
      const std::size_t partner = partners.front();
      const bool clear = partners.size() == 1 && PartnersOf(partner).size() == 1;
      ScaleHypothesis exchanged;
      exchanged.cause = ScaleCause::kExchangedStrings;
      exchanged.shift = BuiltAs(group_[partner], group_[i]);
      double sum = 0;
      for (const ScaleHypothesis& one : hypotheses) {
        if (one.cause != ScaleCause::kNone) sum += one.prior;
      }
      exchanged.prior = (clear ? kExchangedOdds : kUnclearOdds) * sum;
      hypotheses.push_back(exchanged);
      judged.partner = group_[partner].id;
    }
    judged.verdict = JudgeScale(judged.deviation, errors, hypotheses, level_);
    return judged;
  }

  const std::vector<ScaleMember>& group_;
  const std::vector<ScaleResidual>& residuals_;
  const ScaleErrors& errors_;
  const double level_;
};

double Percent(double logarithm) { return 100 * std::expm1(logarithm); }

// Watts that the string gives less than without its cause, at the light of the sweep.
double LostWatts(const Judged& judged, const ScaleMember& member) {
  const ScaleCause cause = judged.verdict.cause;
  const std::string about = TextOf(cause).about;
  if (about == "conditions" || cause == ScaleCause::kExchangedStrings ||
      cause == ScaleCause::kExtraModule) {
    return 0;
  }
  const bool any_form = cause == ScaleCause::kWrongModuleType;
  const ScaleVector& shift = any_form ? judged.deviation : judged.verdict.mean.shift;
  const double power = shift[kScaleIsc] + shift[kScaleVoc] + shift[kScaleFill];
  return member.measured.imp_A * member.measured.vmp_V * std::expm1(-power);
}

struct ScaleRow {
  ScaleRow(const Judged& found, const ScaleMember& of);

  const Judged& judged;
  const ScaleMember& member;
  Cause cause;  // without a name only its sentence

  bool Differs() const { return judged.verdict.cause != ScaleCause::kNone; }
  bool Named() const { return Differs() && judged.verdict.cause != ScaleCause::kSomethingElse; }
  std::string Sentence() const;
  std::vector<std::string> Equivalents() const;
  std::vector<std::string> Tests() const;
};

std::string ScaleRow::Sentence() const {
  const std::string& own = member.own_cause;
  if (!Differs()) {
    return own.empty() ? "" : "not judged by its scale, since the curve itself shows " + own;
  }
  const ScaleVerdict& verdict = judged.verdict;
  const ScaleSize size{verdict.mean.size,
                       verdict.mean.count,
                       verdict.mean.of,
                       Percent(judged.deviation[kScaleIsc]),
                       Percent(judged.deviation[kScaleVoc]),
                       judged.partner};
  return SentenceOf(verdict.cause, size, judged.shared);
}

std::vector<std::string> ScaleRow::Equivalents() const {
  std::vector<std::string> names;
  if (!Differs()) return names;
  for (const ScaleCause cause : judged.verdict.alternatives) names.push_back(ToText(cause));
  return names;
}

std::vector<std::string> ScaleRow::Tests() const {
  const ScaleVerdict& verdict = judged.verdict;
  std::vector<std::string> tests;
  if (!Differs() || verdict.alternatives.empty()) return tests;
  tests.emplace_back(TextOf(verdict.cause).separate);
  for (const ScaleCause alternative : verdict.alternatives) {
    const std::string test = TextOf(alternative).separate;
    if (std::find(tests.begin(), tests.end(), test) == tests.end()) tests.push_back(test);
  }
  return tests;
}

ScaleRow::ScaleRow(const Judged& found, const ScaleMember& of) : judged(found), member(of) {
  cause.sentence = Sentence();
  cause.equivalents = Equivalents();
  cause.separate_by = Tests();
  if (!Named()) return;
  const ScaleCauseText& words = TextOf(judged.verdict.cause);
  cause.id = ToText(judged.verdict.cause);
  cause.title = words.title;
  cause.group = words.about;
  cause.action = words.action;
  cause.probability = judged.verdict.probability;
  cause.recoverable_power_W.value = LostWatts(judged, member);
}

const ColumnList<ScaleRow>& JudgedColumns() {
  using Of = const ScaleRow&;
  static const ColumnList<ScaleRow> columns = [] {
    ColumnList<ScaleRow> all = CauseColumns<ScaleRow>(
        "plan_",
        {"the fault by which the string differs from its plan and its neighbours in scale, the "
         "most "
         "probable: missing_module, bypassed_substring, reversed_module, disconnected_string, "
         "wrong_module_type, extra_module, cable_resistance, uniform_soiling, light_sensor, "
         "temperature_sensor, exchanged_strings; none: nothing beyond the errors, or nothing that "
         "one of these explains",
         "what it belongs to: device; conditions, for a sensor; plan, for a list to be corrected",
         "of the cause, against all others"},
        &ScaleRow::cause);
    Append(
        {{"plan_lost_W", "W",
          "what the string gives less than without the cause, in the light of the sweep",
          [](Of of) { return of.cause.recoverable_power_W.value; }},
         {"plan_shared", "", "all strings of the combiner have it",
          [](Of of) { return of.Named() ? std::optional<bool>(of.judged.shared) : std::nullopt; }},
         {"plan_p", "", "p-value of the difference of a healthy string",
          [](Of of) {
            const bool known = std::isfinite(of.judged.deviation[kScaleVoc]);
            return known && of.member.own_cause.empty() ? of.judged.verdict.p_value : kUnknown;
          }},
         {"plan_Isc_percent", "%",
          "short-circuit current per light against the plan or the median of the combiner, what "
          "all "
          "its strings share taken off unless plan_shared",
          [](Of of) { return Percent(of.judged.deviation[kScaleIsc]); }},
         {"plan_Voc_percent", "%", "open-circuit voltage in the same way",
          [](Of of) { return Percent(of.judged.deviation[kScaleVoc]); }},
         {"plan_FF_percent", "%", "fill factor in the same way",
          [](Of of) { return Percent(of.judged.deviation[kScaleFill]); }},
         {"plan_Vmp_percent", "%", "voltage at maximum power in parts of Voc in the same way",
          [](Of of) { return Percent(of.judged.deviation[kScaleVmp]); }},
         {"plan_slope_percent", "%", "slope times Isc / Voc in the same way",
          [](Of of) { return Percent(of.judged.deviation[kScaleSlope]); }}},
        &all);
    return all;
  }();
  return columns;
}

}  // namespace

std::vector<ResultColumn> ScaleColumns() { return HeadsOf(JudgedColumns()); }

std::vector<std::vector<ResultCell>> ScaleCells(const std::vector<ScaleMember>& group,
                                                const std::vector<ScaleResidual>& residuals,
                                                const ScaleErrors& errors, double level) {
  const GroupJudge judge(group, residuals, errors, level);
  std::vector<std::vector<ResultCell>> cells;
  for (std::size_t i = 0; i < group.size(); ++i) {
    const Judged judged = judge.Judge(i);
    cells.push_back(CellsOf(JudgedColumns(), ScaleRow(judged, group[i])));
  }
  return cells;
}

}  // namespace lyrefit
