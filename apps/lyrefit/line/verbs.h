#pragma once

#include <vector>

#include "command_line.h"

namespace lyrefit {

// The verbs, each defined in its own file NAME_command.cc.
extern const Verb kInspectVerb;
extern const Verb kFitVerb;
extern const Verb kSimulateVerb;
extern const Verb kCertifyVerb;
extern const Verb kCompareVerb;
extern const Verb kDataSheetVerb;
extern const Verb kAuditVerb;
extern const Verb kDiagnoseVerb;
extern const Verb kCellVerb;
extern const Verb kTrendVerb;
extern const Verb kTranslateVerb;
extern const Verb kPackVerb;
extern const Verb kBatchVerb;
extern const Verb kMergeVerb;
extern const Verb kCiteVerb;
// Verbs about lyrefit itself.
extern const Verb kHelpVerb;
extern const Verb kCompletionVerb;
extern const Verb kManVerb;

// The verbs of this program, in the order of --help: all of them (verbs.cc), or those of the
// program built by cmake/quickstart.sh (first_verbs.cc).
std::vector<const Verb*> ProgramVerbs();
// The verbs that this program lacks and how to get them; empty if it has every verb.
extern const char kLeftOut[];

}  // namespace lyrefit
