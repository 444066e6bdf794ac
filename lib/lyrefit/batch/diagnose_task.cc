#include <memory>
#include <utility>
#include <vector>

#include "lyrefit/base/append.h"
#include "lyrefit/batch/column.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/report/documents.h"

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

}  // namespace lyrefit
