#include "interrupt.h"
#include "lyrefit/study/report/compare_csv.h"
#include "lyrefit/study/report/compare_json.h"
#include "output.h"
#include "study_flags.h"

namespace lyrefit {
namespace {

Expected<void> Write(const Verb& verb, const StudyFlags& flags, const Comparison& comparison,
                     const std::function<std::string(const Comparison&)>& text,
                     const std::vector<StudyPicture>& pictures) {
  if (!flags.json_file.empty()) {
    auto written = WriteOutput(flags.json_file, CompareJson(comparison));
    if (!written) return written;
  }
  if (!flags.csv_file.empty()) {
    auto written = WriteOutput(flags.csv_file, CompareCsv(comparison));
    if (!written) return written;
  }
  for (const StudyPicture& picture : pictures) {
    if (picture.path.empty() || comparison.problems.empty()) continue;
    if (auto drawn = picture.draw(comparison, picture.path); !drawn) return drawn;
  }
  if (!verb.TextWanted()) return {};
  return WriteOutput("-", text(comparison));
}

}  // namespace

int RunStudy(const Verb& verb, const StudyFlags& flags, const std::vector<Contender>& contenders,
             const std::function<std::string(const Comparison&)>& text,
             const std::vector<StudyPicture>& pictures) {
  CompareOptions options = flags.options;
  options.polish = !flags.no_polish;
  const auto models = ParseModels(flags.models);
  if (!models) return Refuse(models.error());
  options.models = *models;
  auto with = ParseWith(flags.with);
  if (!with) return Refuse(with.error());
  options.with = std::move(*with);
  options.force_effects = verb.Forced() && !options.with.empty();
  if (!options.with.empty() && !verb.Given("--objective")) {
    options.objective = Objective::kSolvedCurrent;
  }
  if (auto checked = verb.CheckFiles(); !checked) return Refuse(checked.error());
  const auto curves = ReadStudyCurves(flags);
  if (!curves) return Refuse(curves.error());
  const InterruptGuard guard;
  const auto comparison = Compare(*curves, contenders, options, TerminalObserver({"compare"}));
  if (!comparison) return Refuse(comparison.error());
  PrintRemarks(comparison->remarks);
  if (auto written = Write(verb, flags, *comparison, text, pictures); !written) {
    return Refuse(written.error());
  }
  return comparison->interrupted ? kExitInterrupted : kExitFine;
}

}  // namespace lyrefit
