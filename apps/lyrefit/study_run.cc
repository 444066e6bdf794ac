#include "interrupt.h"
#include "lyrefit/base/try.h"
#include "lyrefit/report/page.h"
#include "lyrefit/study/report/compare_csv.h"
#include "lyrefit/study/report/compare_json.h"
#include "study_flags.h"

namespace lyrefit {

Expected<int> RunStudy(const VerbLine& verb, const StudyFlags& flags,
                       const std::vector<ComparedAlgorithm>& algorithms,
                       Document (*document)(const Comparison&),
                       const std::vector<StudyPicture>& pictures) {
  CompareOptions options = flags.options;
  if (!options.with.empty()) {
    options.force_effects = verb.Forced();
    if (!verb.Given("--objective")) options.objective = Objective::kSolvedCurrent;
  }
  TRY(verb.CheckFiles());
  TRY(const auto curves, ReadStudyCurves(flags));
  const InterruptGuard guard;
  TRY(const Comparison comparison,
      Compare(curves, algorithms, options, TerminalObserver({"compare"})));
  PrintRemarks(comparison.remarks);
  TRY(WriteWanted(flags.output.json_file, [&] { return CompareJson(comparison); }));
  TRY(WriteWanted(flags.output.csv_file, [&] { return CompareCsv(comparison); }));
  for (const StudyPicture& picture : pictures) {
    if (picture.path.empty() || comparison.problems.empty()) continue;
    TRY(picture.draw(comparison, picture.path));
  }
  TRY(WriteWanted(flags.output.html_file,
                  [&] { return DrawPage(document(comparison), CompareJson(comparison)); }));
  TRY(WriteText(verb, [&] { return DrawText(document(comparison)); }));
  if (comparison.interrupted) return kExitInterrupted;
  return comparison.journal_lacks_runs ? kExitBadInput : kExitFine;
}

}  // namespace lyrefit
