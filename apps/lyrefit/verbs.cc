#include "verbs.h"

namespace lyrefit {

std::vector<const Verb*> ProgramVerbs() {
  return {&kInspectVerb, &kFitVerb,         &kSimulateVerb,   &kCertifyVerb, &kCompareVerb,
          &kBudgetVerb,  &kSensitivityVerb, &kDataSheetVerb,  &kAuditVerb,   &kDiagnoseVerb,
          &kCellVerb,    &kTrendVerb,       &kTranslateVerb,  &kPackVerb,    &kBatchVerb,
          &kMergeVerb,   &kHelpVerb,        &kCompletionVerb, &kManVerb};
}

const char kLeftOut[] = "";

}  // namespace lyrefit
