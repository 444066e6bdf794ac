#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/append.h"
#include "lyrefit/batch/column.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/translate/translate.h"
#include "lyrefit/translate/translation_documents.h"

namespace lyrefit {
namespace {

struct DiagnoseRow {
  const Diagnosis& diagnosis;
  Cause cause;  // the main one
};

template <class Named>
ResultCell IdsCell(const std::vector<Named>& all) {
  std::vector<std::string> ids;
  ids.reserve(all.size());
  for (const Named& one : all) ids.push_back(one.id);
  return ListCell(ids);
}

ColumnList<DiagnoseRow> DiagnoseColumns() {
  using Of = const DiagnoseRow&;
  ColumnList<DiagnoseRow> columns = CauseColumns<DiagnoseRow>(
      "",
      {"what the model gets wrong, a fault of the device before one of the measurement: its id; "
       "else "
       "the first of device_findings, which also goes before single wrong readings; empty: nothing",
       "what it belongs to: device; or a measurement to be repeated: sweep, instrument, "
       "conditions; "
       "or unknown",
       "that this cause, and no other, is there"},
      &DiagnoseRow::cause);
  Append({{"causes", "", "ids of all causes, the most certain first",
           [](Of of) { return IdsCell(of.diagnosis.verdict.causes); }},
          {"below_floor", "", "ids of what is there too but too small to act on",
           [](Of of) { return IdsCell(of.diagnosis.verdict.below_floor); }},
          {"unexplained", "",
           "something is there that no known cause fits; where no cause is named, the model misses "
           "more than it misses of healthy modules",
           [](Of of) { return of.diagnosis.verdict.unexplained; }},
          {"lack_of_fit_percent", "%",
           "of the readings from the model beyond noise, root mean square in percent of Isc",
           [](Of of) { return 100 * of.diagnosis.verdict.lack_of_fit.value; }},
          {"power_effect_percent", "%",
           "of the cause on Pmax: what the model gets wrong without it, in percent; of a device "
           "finding what it costs",
           [](Of of) { return 100 * of.cause.power_effect.value; }},
          {"recoverable_power_W", "W",
           "what the device would give more without the cause; empty where only a lower limit is "
           "known",
           [](Of of) { return of.cause.recoverable_power_W.value; }},
          {"recoverable_power_W_low_95", "W", "its 95 % interval, or that lower limit",
           [](Of of) { return of.cause.recoverable_power_W.low_95; }},
          {"recoverable_power_W_high_95", "W", "its 95 % interval",
           [](Of of) { return of.cause.recoverable_power_W.high_95; }},
          {"device_findings", "",
           "of leak, ideality, series_resistance what lies above healthy devices, the largest loss "
           "first",
           [](Of of) { return IdsCell(of.diagnosis.device_findings); }},
          {"verdict", "", "the diagnosis in one sentence",
           [](Of of) { return of.diagnosis.verdict.sentence; }},
          {"warnings", "", "in plain words, with '; ' between them",
           [](Of of) { return ListCell(of.diagnosis.warnings, "; "); }}},
         &columns);
  return columns;
}

}  // namespace

BatchTaskType DiagnoseTask(const DiagnoseOptions& asked) {
  DiagnoseOptions options = asked;
  options.threads = 1;
  options.held_out = false;
  const ColumnList<DiagnoseRow> columns = DiagnoseColumns();
  BatchTaskType task;
  task.name = "diagnose";
  task.columns = HeadsOf(columns);
  task.options = NonDefaults(options, kDiagnoseOptionTable);
  task.run = [options, columns](const BatchCurve& curve, std::uint64_t seed,
                                const Observer& observer) {
    DiagnoseOptions own = options;
    own.seed = seed;
    Expected<Diagnosis> diagnosis = Diagnose(*curve.curve, own, observer);
    if (!diagnosis) return TaskResult{RowStatus::kBroken, diagnosis.error().message, {}, false};
    const FitReport& extended = diagnosis->extended;
    TaskResult result{
        extended.usable ? RowStatus::kFine : RowStatus::kNotUsable, extended.not_usable_because,
        CellsOf(columns, DiagnoseRow{*diagnosis, MainCause(*diagnosis)}), diagnosis->interrupted};
    result.failed = !extended.usable || diagnosis->verdict.found ||
                    diagnosis->verdict.unexplained || !diagnosis->device_findings.empty();
    diagnosis->seconds = kUnknown;  // a page must not depend on the time used
    result.page = [diagnosis = std::make_shared<const Diagnosis>(std::move(*diagnosis))](
                      const PageOptions& page) {
      return DrawPage(DiagnosisDocument(*diagnosis), DiagnosisJson(*diagnosis), page);
    };
    return result;
  };
  return task;
}

namespace {

struct FieldRow {
  explicit FieldRow(const TranslationReport& of)
      : report(of),
        test(of.field_test.value_or(FieldTest())),
        best(of.Recommended()),
        cause(of.diagnosis ? MainCause(*of.diagnosis) : Cause()) {}

  // `q`: in the order of KeyPointQuantities.
  UncertainOutput Output(std::size_t q) const {
    const bool has = best != nullptr && q < best->budget.outputs.size();
    return has ? best->budget.outputs[q] : UncertainOutput();
  }

  const TranslationReport& report;
  FieldTest test;
  const TranslatedResult* best;
  Cause cause;
};

ResultCell TitlesCell(const Checklist& checklist, Condition state) {
  std::vector<std::string> titles;
  for (const CheckedCondition& one : checklist.conditions) {
    if (one.state == state) titles.push_back(one.title);
  }
  return ListCell(titles, "; ");
}

ColumnList<FieldRow> FieldColumns() {
  using Of = const FieldRow&;
  ColumnList<FieldRow> columns = {
      {"zone", "",
       "power at standard conditions against the least that the rating allows: pass, pass within "
       "uncertainty, undecided (a probability from 20 to 80 %), fail within uncertainty, fail; "
       "doubtful where that cannot be judged",
       [](Of of) { return of.report.field_test ? ToText(of.test.zone) : ""; }},
      {"performance_factor", "", "measured over predicted maximum power",
       [](Of of) { return of.test.performance_factor; }},
      {"performance_factor_low", "", "its interval, k = 2",
       [](Of of) { return of.test.performance_low; }},
      {"performance_factor_high", "", "its interval, k = 2",
       [](Of of) { return of.test.performance_high; }},
      {"wrong_decision_probability", "",
       "that the true power is on the other side of the limit than what the zone says",
       [](Of of) { return of.test.probability_wrong; }},
      {"lowest_power_W", "W", "the least that rating and tolerance allow",
       [](Of of) { return of.test.lowest_W; }},
      {"cell_temperature_C", "C",
       "of the cells, as used: what was read, and how much warmer than the sensor they are",
       [](Of of) { return of.report.inputs.values.temperature_C; }},
      {"procedure", "", "that carried the curve to standard conditions",
       [](Of of) { return of.best == nullptr ? "" : of.best->title; }},
  };
  std::size_t q = 0;
  for (const auto& [name, unit] : std::vector<std::pair<std::string, std::string>>{
           {"Isc", "A"}, {"Voc", "V"}, {"Imp", "A"}, {"Vmp", "V"}, {"Pmax", "W"}, {"FF", ""}}) {
    const std::string end = unit.empty() ? "" : "_" + unit;
    columns.emplace_back(fmt::format("{}_stc{}", name, end), unit, name + " at 1000 W/m2 and 25 C",
                         [q](Of of) { return of.Output(q).value; });
    columns.emplace_back(fmt::format("{}_stc_U{}", name, end), unit,
                         "its expanded uncertainty, k = 2",
                         [q](Of of) { return of.Output(q).expanded_uncertainty; });
    ++q;
  }
  Append({{"conditions_met", "", "conditions of the checklist that are met",
           [](Of of) { return of.report.checklist.met; }},
          {"conditions_not_met", "", "those that are not, with '; ' between them",
           [](Of of) { return TitlesCell(of.report.checklist, Condition::kNotMet); }},
          {"conditions_not_known", "", "those of which nothing is known",
           [](Of of) { return TitlesCell(of.report.checklist, Condition::kNotKnown); }}},
         &columns);
  Append(
      CauseColumns<FieldRow>(
          "",
          {"what is wrong with the curve, a fault of the device before one of the measurement: its "
           "id; leak, ideality, low_ideality, series_resistance or fill_factor where that lies out "
           "of "
           "the range of healthy devices",
           "what it belongs to: device; or a measurement to be repeated: sweep, instrument, "
           "conditions; or unknown",
           "that this cause, and no other, is there"},
          &FieldRow::cause),
      &columns);
  Append(
      {{"recoverable_power_W", "W",
        "what the string would give more without the cause, in the light of the sweep; empty where "
        "only a lower limit is known",
        [](Of of) { return of.cause.recoverable_power_W.value; }},
       {"recoverable_power_W_low_95", "W", "its 95 % interval, or that lower limit",
        [](Of of) { return of.cause.recoverable_power_W.low_95; }},
       {"recoverable_power_W_high_95", "W", "its 95 % interval",
        [](Of of) { return of.cause.recoverable_power_W.high_95; }},
       {"below_rating_W", "W", "rated power less the power at standard conditions",
        [](Of of) { return of.test.rated_W - of.test.standard_W; }},
       {"causes", "", "ids of all causes, the most certain first",
        [](Of of) { return ListCell(of.report.causes); }},
       {"verdict", "", "the diagnosis in one sentence", [](Of of) { return of.report.verdict; }},
       {"field_test", "", "the field test in one sentence", [](Of of) { return of.test.sentence; }},
       {"warnings", "", "in plain words, with '; ' between them",
        [](Of of) { return ListCell(of.report.warnings, "; "); }}},
      &columns);
  return columns;
}

// Uses the rating beside the curve, if the options state none.
void TakeRating(const BatchCurve& curve, FieldTestOptions* options) {
  const std::optional<double> rated_W = RatedPowerBeside(curve);
  if (options->rated_W || !rated_W) return;
  options->rated_W = *rated_W;
  options->modules = options->strings = 1;
}

}  // namespace

TranslateOptions BatchTranslateOptions() {
  TranslateOptions options;
  options.uncertainty.draws = 1000;
  return options;
}

BatchTaskType FieldTestTask(const TranslateOptions& asked) {
  TranslateOptions options = asked;
  options.target = TranslationTarget();
  options.diagnosis.threads = options.uncertainty.threads = 1;
  options.diagnosis.held_out = false;
  options.all_budgets = false;
  const ColumnList<FieldRow> columns = FieldColumns();
  BatchTaskType task;
  task.name = "field-test";
  task.columns = HeadsOf(columns);
  task.options = NonDefaults(options, kTranslateOptionTable);
  task.run = [options, columns](const BatchCurve& curve, std::uint64_t seed,
                                const Observer& observer) {
    TranslateOptions own = options;
    own.diagnosis.seed = own.uncertainty.seed = seed;
    TakeRating(curve, &own.field_test);
    auto report = TranslateCurve(*curve.curve, own, observer);
    if (!report) return TaskResult{RowStatus::kBroken, report.error().message, {}, false};
    const bool usable = report->Recommended() != nullptr;
    TaskResult result{usable ? RowStatus::kFine : RowStatus::kNotUsable,
                      usable ? std::string() : report->reason, CellsOf(columns, FieldRow(*report)),
                      report->interrupted};
    if (usable && report->field_test && report->field_test->zone == Zone::kDoubtful) {
      result.status = RowStatus::kDoubtful;
      result.reason = report->field_test->doubt;
    }
    const bool fails = report->field_test && !IsPass(report->field_test->zone) &&
                       report->field_test->zone != Zone::kUndecided;
    result.failed = !usable || fails || !report->causes.empty();
    report->seconds = kUnknown;  // a page must not depend on the time used
    result.page = [report = std::make_shared<const TranslationReport>(std::move(*report))](
                      const PageOptions& page) {
      return DrawPage(TranslationDocument(*report), TranslationJson(*report), page);
    };
    return result;
  };
  return task;
}

}  // namespace lyrefit
