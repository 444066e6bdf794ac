#pragma once

#include <vector>

#include "command_line.h"

namespace lyrefit {

// The verbs, each in a file of its own: NAME_command.cc.
extern const Verb kFitVerb;
extern const Verb kSimulateVerb;
extern const Verb kCertifyVerb;
extern const Verb kCompareVerb;
extern const Verb kBudgetVerb;
extern const Verb kSensitivityVerb;
extern const Verb kDataSheetVerb;
extern const Verb kAuditVerb;
extern const Verb kCoverageVerb;
extern const Verb kDiagnoseVerb;
extern const Verb kTranslateVerb;
extern const Verb kPackVerb;
extern const Verb kBatchVerb;
extern const Verb kMergeVerb;
// About lyrefit itself.
extern const Verb kHelpVerb;
extern const Verb kCompletionVerb;
extern const Verb kManVerb;

// The verbs of this program, in the order of --help: all of them (verbs.cc), or those of the program
// that cmake/quickstart.sh builds (first_verbs.cc).
std::vector<const Verb*> ProgramVerbs();
// What this program leaves out and how to get it; empty where it has every verb.
extern const char kLeftOut[];

}  // namespace lyrefit
