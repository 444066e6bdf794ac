#include "verbs.h"

namespace lyrefit {

std::vector<const Verb*> ProgramVerbs() {
  return {&kFitVerb,       &kSimulateVerb,   &kCertifyVerb,  &kCompareVerb, &kInspectVerb,
          &kDataSheetVerb, &kAuditVerb,      &kDiagnoseVerb, &kCellVerb,    &kTrendVerb,
          &kTranslateVerb, &kPackVerb,       &kBatchVerb,    &kMergeVerb,   &kCiteVerb,
          &kHelpVerb,      &kCompletionVerb, &kManVerb};
}

const char kLeftOut[] = "";

}  // namespace lyrefit
