#include "lyrefit/batch/row_cause.h"

#include "lyrefit/batch/batch_task.h"

namespace lyrefit {
namespace {

// A parameter of the device out of range, in the words of a row.
struct FindingWords {
  const char* finding;
  bool low;  // below its limit rather than above
  const char* id;
  const char* title;
  const char* about;
};

constexpr FindingWords kFindingWords[] = {
    {"fill_factor", true, "fill_factor", "fill factor below that of healthy devices", "device"},
    {"leak", false, "leak", "leak above that of healthy devices", "device"},
    {"ideality", false, "ideality", "ideality above that of healthy devices", "device"},
    {"ideality", true, "low_ideality", "ideality below that of any junction", "conditions"},
    {"series_resistance", false, "series_resistance",
     "series resistance above that of healthy devices", "device"},
};

}  // namespace

Cause RowCause(const Diagnosis& diagnosis) {
  Cause cause;
  if (!diagnosis.verdict.causes.empty()) {
    cause = diagnosis.verdict.causes.front();
    cause.group = AboutOf(cause.id);
  } else if (!diagnosis.device_findings.empty()) {
    const DeviceFinding& finding = diagnosis.device_findings.front();
    const bool low = finding.value.value < finding.healthy_limit;
    for (const FindingWords& words : kFindingWords) {
      if (words.finding != finding.id || words.low != low) continue;
      cause.id = words.id;
      cause.title = words.title;
      cause.group = words.about;
    }
    cause.sentence = "it " + finding.sentence;
    cause.power_effect.value = finding.power_loss;
  }
  return cause;
}

}  // namespace lyrefit
