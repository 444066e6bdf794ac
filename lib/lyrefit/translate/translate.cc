#include "lyrefit/translate/translate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lyrefit/base/append.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/curve/plausibility.h"
#include "lyrefit/translate/extended_model.h"
#include "lyrefit/translate/key_point_noise.h"
#include "lyrefit/translate/prepare.h"
#include "lyrefit/translate/recommend.h"
#include "lyrefit/translate/translation_budget.h"

namespace lyrefit {
namespace {

struct Named {
  Procedure procedure;
  const char* title;
};
constexpr Named kProcedures[] = {{Procedure::kIec1, "IEC 60891 procedure 1"},
                                 {Procedure::kIec2, "IEC 60891 procedure 2"},
                                 {Procedure::kIec3, "IEC 60891 procedure 3"},
                                 {Procedure::kIec4, "IEC 60891 procedure 4"},
                                 {Procedure::kDeSoto, "De Soto"},
                                 {Procedure::kPvsyst, "PVsyst"},
                                 {Procedure::kExtended, "extended model"}};

bool MovesBeyondVoc(Procedure procedure) {
  return procedure == Procedure::kIec1 || procedure == Procedure::kIec4;
}

// The current beyond open circuit, as positive A, that the readings need for the target's open
// circuit, and the largest one that they have.
struct Reach {
  double needed_A = 0;
  double there_A = 0;
};
Reach ReachOf(const PreparedCurve& curve, const TranslationInputs& inputs, double isc_A) {
  const double gain = curve.target.irradiance_W_m2 / EquivalentIrradiance(inputs);
  const std::vector<double>& current_A = curve.points.current_A;
  return {isc_A * (gain - 1), -*std::min_element(current_A.begin(), current_A.end())};
}

TranslatedResult Compute(const Named& named, const Preparation& made, const KeyPoints& source) {
  TranslatedResult result;
  result.procedure = named.procedure;
  result.title = named.title;
  const PreparedCurve& curve = made.curve;
  const TranslationInputs& inputs = made.inputs.values;
  if (named.procedure == Procedure::kExtended && curve.models.empty()) {
    result.why_not = made.why_no_model;
    return result;
  }
  const auto key = TranslatedKeyPoints(named.procedure, curve, inputs);
  const auto points = TranslatedPoints(named.procedure, curve, inputs);
  if (!key || !points) {
    result.why_not = key ? points.error().message : key.error().message;
    return result;
  }
  result.key_points = *key;
  result.curve = *points;
  // The equations can be evaluated, but their result may be none to believe.
  if (named.procedure == Procedure::kIec4 && !made.inputs.crystalline_silicon) {
    result.why_not = "it is for crystalline silicon";
    return result;
  }
  if (!MovesBeyondVoc(named.procedure)) return result;
  const Reach reach = ReachOf(curve, inputs, source.short_circuit_current_A);
  const double missing = reach.needed_A - reach.there_A;
  if (!(missing > 0)) return result;
  result.extrapolated = missing / key->short_circuit_current_A;
  if (missing < 0.9 * key->max_power_current_A) return result;
  result.why_not = fmt::format(
      "it needs readings down to {:.3g} A, beyond open circuit; the last one is at {:.3g} A",
      -reach.needed_A, -reach.there_A);
  return result;
}

// With budgets: with draws for the recommended result, linear only for the others where requested.
TranslationReport WithBudgets(TranslationReport report, const Preparation& made,
                              const TranslateOptions& options, const Observer& observer) {
  TranslationDoubts doubts;
  doubts.noise = NoiseOfCurve(made.curve, options.uncertainty.seed);
  for (std::size_t i = 0; i < report.results.size(); ++i) {
    TranslatedResult& result = report.results[i];
    const bool best = static_cast<int>(i) == report.recommended;
    if (!result.computed() || !(best || options.all_budgets)) continue;
    UncertaintyOptions sizes = options.uncertainty;
    if (!best) sizes.draws = 0;
    auto budget =
        TranslationBudget(result.procedure, made.curve, made.inputs, doubts, sizes, observer);
    if (!budget) {
      report.warnings.push_back(result.title + ": no uncertainty: " + budget.error().message);
      continue;
    }
    result.budget = std::move(*budget);
  }
  return report;
}

constexpr double kAssumedGamma_percent = 25;  // expanded, k = 2, among modules of a technology

bool IsStandard(const TranslationTarget& target) {
  const TranslationTarget standard;
  return target.irradiance_W_m2 == standard.irradiance_W_m2 &&
         target.temperature_C == standard.temperature_C;
}

Expected<TranslationReport> WithFieldTest(TranslationReport report, const Preparation& made,
                                          const TranslateOptions& options,
                                          const Observer& observer) {
  if (!options.field_test.rated_W) return report;
  if (!IsStandard(report.target)) {
    report.warnings.push_back("a rating is held against Pmax at 1000 W/m2 and 25 C: say --to STC");
    return report;
  }
  const TranslatedResult* best = report.Recommended();
  if (best == nullptr || best->budget.outputs.size() <= kMaxPowerOutput) return report;
  FieldMeasurement measurement;
  measurement.measured = KeyPointsBy(KeyPointMethod::kInterpolated, made.curve.points);
  measurement.inputs = made.inputs.values;
  measurement.doubt = PlausibilityProblem(report.curve).value_or("");
  FieldTestOptions test = options.field_test;
  if (!test.power_coefficient_percent_K) {
    test.power_coefficient_percent_K = made.inputs.usual_gamma_percent_K;
    test.power_coefficient_percent = kAssumedGamma_percent;
    report.assumptions.push_back(fmt::format(
        "nobody stated gamma: {:.2f} %/K +- {:g} % of it (k = 2), as {} has it",
        *test.power_coefficient_percent_K, test.power_coefficient_percent, made.inputs.usual_of));
  }
  TRY(report.field_test, JudgeFieldTest(best->budget.outputs[kMaxPowerOutput], measurement, test,
                                        options.uncertainty, observer));
  return report;
}

TranslationReport WithDiagnosis(TranslationReport report, const Preparation& made) {
  if (!made.diagnosis) return report;
  report.diagnosis = made.diagnosis;
  report.verdict = made.diagnosis->verdict.sentence;
  for (const Cause& cause : made.diagnosis->verdict.causes) report.causes.push_back(cause.id);
  report.interrupted = made.diagnosis->interrupted;
  if (made.curve.models.empty()) return report;
  report.kept = made.curve.models.front()->kept;
  report.removed = made.curve.models.front()->removed;
  return report;
}

// Warns of the procedure whose Pmax is farthest outside the interval of the recommended one.
std::optional<std::string> WarnOfSpread(const TranslatedResult& best,
                                        const std::vector<TranslatedResult>& results) {
  if (best.budget.outputs.size() <= kMaxPowerOutput) return std::nullopt;
  const double power = best.key_points.max_power_W;
  double farthest = best.budget.outputs[kMaxPowerOutput].expanded_uncertainty;
  const TranslatedResult* other = nullptr;
  for (const TranslatedResult& result : results) {
    const double off = std::fabs(result.key_points.max_power_W - power);
    if (!result.computed() || !(off > farthest)) continue;
    farthest = off;
    other = &result;
  }
  if (other == nullptr) return std::nullopt;
  return fmt::format(
      "{} gives {:.4g} W, {:+.0f} % off and outside the stated interval: the choice of "
      "the procedure "
      "decides, and its reason is all there is for it",
      other->title, other->key_points.max_power_W,
      100 * (other->key_points.max_power_W / power - 1));
}

// Warns outside the conditions at which the procedures' own errors were measured.
std::optional<std::string> WarnOfRange(const TranslationReport& report) {
  constexpr double kDimmest_W_m2 = 150, kBrightest_W_m2 = 1250, kColdest_C = 5, kHottest_C = 70;
  const auto within = [&](double g, double t_C) {
    return g >= kDimmest_W_m2 && g <= kBrightest_W_m2 && t_C >= kColdest_C && t_C <= kHottest_C;
  };
  const double source_C = report.inputs.values.temperature_C;
  if (within(report.equivalent_irradiance_W_m2, source_C) &&
      within(report.target.irradiance_W_m2, report.target.temperature_C)) {
    return std::nullopt;
  }
  return fmt::format(
      "from {:.0f} W/m2, {:.0f} C to {:.0f} W/m2, {:.0f} C: how wrong procedures are was measured "
      "from {:g} to {:g} W/m2 and {:g} to {:g} C, beyond it the stated uncertainty is too small",
      report.equivalent_irradiance_W_m2, source_C, report.target.irradiance_W_m2,
      report.target.temperature_C, kDimmest_W_m2, kBrightest_W_m2, kColdest_C, kHottest_C);
}

// Those of the readings first, then those that the report has.
std::vector<std::string> FindWarnings(const TranslationReport& report, const Preparation& made) {
  std::vector<std::string> warnings = made.doubts;
  Append(report.warnings, &warnings);
  Append(made.warnings, &warnings);
  const TranslatedResult* best = report.Recommended();
  if (best == nullptr) return warnings;
  for (const auto& warning : {WarnOfRange(report), WarnOfSpread(*best, report.results)}) {
    if (warning) warnings.push_back(*warning);
  }
  constexpr double kMuch = 0.02;
  if (best->extrapolated > kMuch) {
    warnings.push_back(fmt::format(
        "the last {:.0f} % of the current at the target lie beyond the readings: the fitted diode "
        "stands in, and Voc is its own",
        100 * best->extrapolated));
  }
  Append(best->budget.warnings, &warnings);
  return warnings;
}

// Completes the curve by the layout, and the modules in series of the field test by the curve.
void TakeLayout(IvCurve* curve, TranslateOptions* options) {
  int& modules = options->field_test.modules;
  if (modules > 0) curve->notes.modules_in_series = modules;
  FillLayout(options->layout, curve);
  for (IvCurve& other : options->further) FillLayout(options->layout, &other);
  modules = curve->notes.modules_in_series.value_or(1);
}

}  // namespace

Expected<TranslationReport> TranslateCurve(const IvCurve& given, const TranslateOptions& asked,
                                           const Observer& observer) {
  const Instant start = Now();
  IvCurve curve = given;
  TranslateOptions options = asked;
  TakeLayout(&curve, &options);
  TRY(ValidateTranslateOptions(options));
  TRY(const Preparation made, Prepare(curve, options, observer));
  TranslationReport report;
  report.version = Version();
  report.curve = curve;
  report.target = options.target;
  report.method = options.key_points;
  report.seed = options.uncertainty.seed;
  report.uncertainty = options.uncertainty;
  report.notes = options.notes;
  report.inputs = made.inputs;
  report.doubts = made.doubts;
  report.read_temperature_C = made.inputs.values.temperature_C - made.inputs.cell_correction_K;
  report.assumptions = SentencesOf(curve.assumptions);
  Append(made.inputs.assumptions, &report.assumptions);
  report.equivalent_irradiance_W_m2 = EquivalentIrradiance(made.inputs.values);
  report.source =
      KeyPointsBy(options.key_points, TruePoints(made.curve.points, made.inputs.values));
  for (const Named& named : kProcedures) {
    const auto& wanted = options.procedures;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), named.procedure) == wanted.end())
      continue;
    report.results.push_back(Compute(named, made, report.source));
  }
  const Recommendation best = Recommend(made, report.results);
  report.recommended = best.result;
  report.reason = best.reason;
  report = WithDiagnosis(std::move(report), made);
  bool stopped = false;
  const Observer heard = [&](const Progress& progress) {
    stopped = stopped || StopRequested(observer, progress);
    return stopped ? ObserverAction::kStop : ObserverAction::kContinue;
  };
  report = WithBudgets(std::move(report), made, options, heard);
  TRY(report, WithFieldTest(std::move(report), made, options, heard));
  report.interrupted = report.interrupted || stopped;
  ConditionFacts facts;
  facts.diagnosis = made.diagnosis ? &*made.diagnosis : nullptr;
  facts.uncertainty = options.uncertainty;
  facts.target = options.target;
  if (best.result >= 0) facts.procedure = report.results[best.result].procedure;
  report.checklist = CheckConditions(curve, facts, options.checklist);
  report.warnings = FindWarnings(report, made);
  report.non_default_options = NonDefaults(asked, kTranslateOptionTable);
  report.seconds = SecondsSince(start);
  return report;
}

}  // namespace lyrefit
