#include "verbs.h"

// The verbs of the program built by cmake/quickstart.sh: those needed for a first fit, which take
// half of the full compile time.
namespace lyrefit {

std::vector<const Verb*> ProgramVerbs() {
  return {&kFitVerb, &kSimulateVerb, &kHelpVerb, &kCompletionVerb, &kManVerb};
}

const char kLeftOut[] =
    "This program was built for a first fit: it has the verbs fit and simulate. All verbs, in the\n"
    "folder of the sources:  cmake --build build  (then build/apps/lyrefit/lyrefit)\n";

}  // namespace lyrefit
