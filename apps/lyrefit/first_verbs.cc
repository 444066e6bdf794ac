#include "verbs.h"

// The verbs of the program that cmake/quickstart.sh builds: what a first fit needs, which is half of
// the whole to compile.
namespace lyrefit {

std::vector<const Verb*> ProgramVerbs() {
  return {&kFitVerb, &kSimulateVerb, &kHelpVerb, &kCompletionVerb, &kManVerb};
}

const char kLeftOut[] =
    "This program was built for a first fit: it has the verbs fit and simulate. All verbs, in the\n"
    "folder of the sources:  cmake --build build  (then build/apps/lyrefit/lyrefit)\n";

}  // namespace lyrefit
