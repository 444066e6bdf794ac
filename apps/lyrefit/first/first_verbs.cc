#include "verbs.h"

// The verbs of the program built by cmake/quickstart.sh: fit alone, which takes a small part of the
// full compile time.
namespace lyrefit {

std::vector<const Verb*> ProgramVerbs() {
  return {&kFitVerb, &kHelpVerb, &kCompletionVerb, &kManVerb};
}

const char kLeftOut[] =
    "This program was built for a first fit: it has the verb fit, for curves one by one. All "
    "verbs, in\n"
    "the folder of the sources:  cmake --build build  (then build/apps/lyrefit/lyrefit)\n";

}  // namespace lyrefit
