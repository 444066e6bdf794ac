#include <memory>
#include <utility>
#include <vector>

#include "lyrefit/batch/batch_task.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"

namespace lyrefit {
namespace {

std::vector<ResultColumn> DiagnoseColumns() {
  constexpr CellType kText = CellType::kText;
  constexpr CellType kNumber = CellType::kNumber;
  return {
      {"cause", "", kText,
       "what the model gets wrong, a fault of the device before one of the measurement: its id; "
       "else "
       "the first of device_findings, which also goes before single wrong readings; empty: "
       "nothing"},
      {"cause_title", "", kText, "the same in a few words"},
      {"cause_about", "", kText,
       "what it belongs to: device; or a measurement to be repeated: sweep, instrument, "
       "conditions; "
       "or unknown"},
      {"cause_sentence", "", kText, "the same for a technician, with its size"},
      {"equivalents", "", kText, "ids that these readings cannot tell from it"},
      {"separate_by", "", kText, "measurements that would, with '; ' between them"},
      {"action", "", kText, "the next thing to do about it"},
      {"probability", "", kNumber, "that this cause, and no other, is there"},
      {"causes", "", kText, "ids of all causes, the most certain first"},
      {"below_floor", "", kText, "ids of what is there too but too small to act on"},
      {"unexplained", "", CellType::kTruth,
       "something is there that no known cause fits; where no cause is named, the model misses "
       "more than it misses of healthy modules"},
      {"lack_of_fit_percent", "%", kNumber,
       "of the readings from the model beyond noise, root mean square in percent of Isc"},
      {"power_effect_percent", "%", kNumber,
       "of the cause on Pmax: what the model gets wrong without it, in percent; of a device "
       "finding what it costs"},
      {"recoverable_power_W", "W", kNumber,
       "what the device would give more without the cause; empty where only a lower limit is "
       "known"},
      {"recoverable_power_W_low_95", "W", kNumber, "its 95 % interval, or that lower limit"},
      {"recoverable_power_W_high_95", "W", kNumber, "its 95 % interval"},
      {"device_findings", "", kText,
       "of leak, ideality, series_resistance what lies above healthy devices, the largest loss "
       "first"},
      {"verdict", "", kText, "the diagnosis in one sentence"},
      {"warnings", "", kText, "in plain words, with '; ' between them"},
  };
}

std::vector<std::string> Ids(const std::vector<Cause>& causes) {
  std::vector<std::string> ids;
  ids.reserve(causes.size());
  for (const Cause& cause : causes) ids.push_back(cause.id);
  return ids;
}

std::vector<ResultCell> DiagnoseCells(const Diagnosis& diagnosis) {
  const Verdict& verdict = diagnosis.verdict;
  const Cause cause = MainCause(diagnosis);
  std::vector<std::string> findings;
  for (const DeviceFinding& finding : diagnosis.device_findings) findings.push_back(finding.id);
  return {TextCell(cause.id),
          TextCell(cause.title),
          TextCell(cause.group),
          TextCell(cause.sentence),
          ListCell(cause.equivalents),
          ListCell(cause.separate_by, "; "),
          TextCell(cause.action),
          NumberCell(cause.probability),
          ListCell(Ids(verdict.causes)),
          ListCell(Ids(verdict.below_floor)),
          verdict.unexplained,
          NumberCell(100 * verdict.lack_of_fit.value),
          NumberCell(100 * cause.power_effect.value),
          NumberCell(cause.recoverable_power_W.value),
          NumberCell(cause.recoverable_power_W.low_95),
          NumberCell(cause.recoverable_power_W.high_95),
          ListCell(findings),
          TextCell(verdict.sentence),
          ListCell(diagnosis.warnings, "; ")};
}

}  // namespace

BatchTaskType DiagnoseTask(const DiagnoseOptions& asked) {
  DiagnoseOptions options = asked;
  options.threads = 1;
  options.held_out = false;
  BatchTaskType task;
  task.name = "diagnose";
  task.columns = DiagnoseColumns();
  task.options = NonDefaults(options, kDiagnoseOptionTable);
  task.run = [options](const BatchCurve& curve, std::uint64_t seed, const Observer& observer) {
    DiagnoseOptions own = options;
    own.seed = seed;
    Expected<Diagnosis> diagnosis = Diagnose(*curve.curve, own, observer);
    if (!diagnosis) return TaskResult{RowStatus::kBroken, diagnosis.error().message, {}, false};
    const FitReport& extended = diagnosis->extended;
    TaskResult result{extended.usable ? RowStatus::kFine : RowStatus::kNotUsable,
                      extended.not_usable_because, DiagnoseCells(*diagnosis),
                      diagnosis->interrupted};
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
