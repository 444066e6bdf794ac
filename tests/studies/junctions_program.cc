#include "lyrefit/base/try.h"
#include "studies/junctions.h"
#include "studies/programs.h"
#include "studies/watch.h"

namespace lyrefit {

Expected<int> RunJunctions(ProgramFlags flags) {
  JunctionsOptions options;
  TRY(TakeTable(kJunctionsOptionTable, &flags, &options));
  TRY(CheckNothingLeft(flags));
  if (!flags.files.empty()) return Fail("the tandems are made: no curve is read");
  const JunctionsReport report = CountJunctions(options, Watch);
  fmt::print("{}", JunctionsText(options, report));
  return report.sets < options.sets ? kExitInterrupted : 0;
}

}  // namespace lyrefit
