#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/batch/batch_task.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/translate/translate.h"
#include "lyrefit/translate/translation_documents.h"

namespace lyrefit {
namespace {

// Names and units in the order of KeyPointQuantities.
constexpr const char* kQuantities[] = {"Isc", "Voc", "Imp", "Vmp", "Pmax", "FF"};
constexpr const char* kUnits[] = {"A", "V", "A", "V", "W", ""};
constexpr std::size_t kQuantityCount = 6;

std::vector<ResultColumn> FieldColumns() {
  constexpr CellType kText = CellType::kText;
  constexpr CellType kNumber = CellType::kNumber;
  std::vector<ResultColumn> columns = {
      {"zone", "", kText,
       "power at standard conditions against the least that the rating allows: pass, pass within "
       "uncertainty, undecided (a probability from 20 to 80 %), fail within uncertainty, fail; "
       "doubtful where that cannot be judged"},
      {"performance_factor", "", kNumber, "measured over predicted maximum power"},
      {"performance_factor_low", "", kNumber, "its interval, k = 2"},
      {"performance_factor_high", "", kNumber, "its interval, k = 2"},
      {"wrong_decision_probability", "", kNumber,
       "that the true power is on the other side of the limit than what the zone says"},
      {"lowest_power_W", "W", kNumber, "the least that rating and tolerance allow"},
      {"cell_temperature_C", "C", kNumber,
       "of the cells, as used: what was read, and how much warmer than the sensor they are"},
      {"procedure", "", kText, "that carried the curve to standard conditions"},
  };
  for (std::size_t q = 0; q < kQuantityCount; ++q) {
    const std::string name = kQuantities[q];
    const std::string unit = *kUnits[q] == '\0' ? "" : std::string("_") + kUnits[q];
    columns.push_back(
        {fmt::format("{}_stc{}", name, unit), kUnits[q], kNumber, name + " at 1000 W/m2 and 25 C"});
    columns.push_back({fmt::format("{}_stc_U{}", name, unit), kUnits[q], kNumber,
                       "its expanded uncertainty, k = 2"});
  }
  for (ResultColumn column : std::vector<ResultColumn>{
           {"conditions_met", "", CellType::kWhole, "conditions of the checklist that are met"},
           {"conditions_not_met", "", kText, "those that are not, with '; ' between them"},
           {"conditions_not_known", "", kText, "those of which nothing is known"},
           {"cause", "", kText,
            "what is wrong with the curve, a fault of the device before one of the measurement: "
            "its id; "
            "leak, ideality, low_ideality, series_resistance or fill_factor where that lies out of "
            "the range of healthy devices"},
           {"cause_about", "", kText,
            "what that cause belongs to: device; or a measurement to be repeated: sweep, "
            "instrument, "
            "conditions; or unknown"},
           {"cause_title", "", kText, "the same in a few words"},
           {"cause_sentence", "", kText, "the same for a technician, with its size"},
           {"equivalents", "", kText, "ids that these readings cannot tell from it"},
           {"separate_by", "", kText, "measurements that would, with '; ' between them"},
           {"action", "", kText, "the next thing to do about it"},
           {"probability", "", kNumber, "that this cause, and no other, is there"},
           {"recoverable_power_W", "W", kNumber,
            "what the string would give more without the cause, in the light of the sweep; empty "
            "where only a lower limit is known"},
           {"recoverable_power_W_low_95", "W", kNumber, "its 95 % interval, or that lower limit"},
           {"recoverable_power_W_high_95", "W", kNumber, "its 95 % interval"},
           {"below_rating_W", "W", kNumber, "rated power less the power at standard conditions"},
           {"causes", "", kText, "ids of all causes, the most certain first"},
           {"verdict", "", kText, "the diagnosis in one sentence"},
           {"field_test", "", kText, "the field test in one sentence"},
           {"warnings", "", kText, "in plain words, with '; ' between them"}}) {
    columns.push_back(std::move(column));
  }
  return columns;
}

std::vector<std::string> Titles(const Checklist& checklist, Condition state) {
  std::vector<std::string> titles;
  for (const CheckedCondition& one : checklist.conditions) {
    if (one.state == state) titles.push_back(one.title);
  }
  return titles;
}

std::vector<ResultCell> FieldCells(const TranslationReport& report) {
  const FieldTest test = report.field_test.value_or(FieldTest());
  const bool judged = report.field_test.has_value();
  const TranslatedResult* const best = report.Recommended();
  std::vector<ResultCell> cells = {judged ? TextCell(ToText(test.zone)) : ResultCell(),
                                   NumberCell(test.performance_factor),
                                   NumberCell(test.performance_low),
                                   NumberCell(test.performance_high),
                                   NumberCell(test.probability_wrong),
                                   NumberCell(test.lowest_W),
                                   NumberCell(report.inputs.values.temperature_C),
                                   best == nullptr ? ResultCell() : TextCell(best->title)};
  for (std::size_t q = 0; q < kQuantityCount; ++q) {
    const bool has = best != nullptr && q < best->budget.outputs.size();
    const UncertainOutput output = has ? best->budget.outputs[q] : UncertainOutput();
    cells.push_back(NumberCell(output.value));
    cells.push_back(NumberCell(output.expanded_uncertainty));
  }
  cells.emplace_back(std::int64_t{report.checklist.met});
  cells.push_back(ListCell(Titles(report.checklist, Condition::kNotMet), "; "));
  cells.push_back(ListCell(Titles(report.checklist, Condition::kNotKnown), "; "));
  const Cause cause = report.diagnosis ? MainCause(*report.diagnosis) : Cause();
  cells.push_back(TextCell(cause.id));
  cells.push_back(TextCell(cause.group));
  cells.push_back(TextCell(cause.title));
  cells.push_back(TextCell(cause.sentence));
  cells.push_back(ListCell(cause.equivalents));
  cells.push_back(ListCell(cause.separate_by, "; "));
  cells.push_back(TextCell(cause.action));
  cells.push_back(NumberCell(cause.probability));
  cells.push_back(NumberCell(cause.recoverable_power_W.value));
  cells.push_back(NumberCell(cause.recoverable_power_W.low_95));
  cells.push_back(NumberCell(cause.recoverable_power_W.high_95));
  cells.push_back(NumberCell(test.rated_W - test.standard_W));
  cells.push_back(ListCell(report.causes));
  cells.push_back(TextCell(report.verdict));
  cells.push_back(TextCell(test.sentence));
  cells.push_back(ListCell(report.warnings, "; "));
  return cells;
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
  BatchTaskType task;
  task.name = "field-test";
  task.columns = FieldColumns();
  task.options = NonDefaults(options, kTranslateOptionTable);
  task.run = [options](const BatchCurve& curve, std::uint64_t seed, const Observer& observer) {
    TranslateOptions own = options;
    own.diagnosis.seed = own.uncertainty.seed = seed;
    TakeRating(curve, &own.field_test);
    auto report = TranslateCurve(*curve.curve, own, observer);
    if (!report) return TaskResult{RowStatus::kBroken, report.error().message, {}, false};
    const bool usable = report->Recommended() != nullptr;
    TaskResult result{usable ? RowStatus::kFine : RowStatus::kNotUsable,
                      usable ? std::string() : report->reason, FieldCells(*report),
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
