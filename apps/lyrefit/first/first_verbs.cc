#include "verbs.h"

// The verbs of the program built by cmake/quickstart.sh: fit, and inspect, which says what a file
// holds. They take a small part of the full compile time.
namespace lyrefit {

std::vector<const Verb*> ProgramVerbs() {
  return {&kFitVerb, &kInspectVerb, &kHelpVerb, &kCompletionVerb, &kManVerb};
}

const char kLeftOut[] =
    "This program was built for a first fit: it has the verbs fit, for curves one by one, and "
    "inspect.\n"
    "All verbs, in the folder of the sources:  cmake --build build  (then "
    "build/apps/lyrefit/lyrefit)\n";

}  // namespace lyrefit
