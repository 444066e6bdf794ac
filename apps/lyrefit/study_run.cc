#include "interrupt.h"
#include "lyrefit/report/compare_csv.h"
#include "lyrefit/report/compare_json.h"
#include "lyrefit/report/plot.h"
#include "output.h"
#include "study_flags.h"

namespace lyrefit {
namespace {

Expected<void> CheckTargets(const StudyFlags& flags, const std::vector<StudyPicture>& pictures) {
  if (flags.json_file == "-" && flags.csv_file == "-") {
    return Fail("--json and --csv cannot both go to standard output");
  }
  for (const std::string& file : {flags.json_file, flags.csv_file}) {
    if (auto writable = CheckWritable(file); !writable) return writable;
  }
  for (const StudyPicture& picture : pictures) {
    if (picture.path.empty()) continue;
    if (auto drawable = CheckPlot(picture.path); !drawable) return drawable;
    if (auto writable = CheckWritable(picture.path); !writable) return writable;
  }
  return {};
}

Expected<void> Write(const StudyFlags& flags, const Comparison& comparison,
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
  if (flags.json_file == "-" || flags.csv_file == "-") return {};
  return WriteOutput("-", text(comparison));
}

}  // namespace

int RunStudy(const StudyFlags& flags, const std::vector<Contender>& contenders,
             const std::function<std::string(const Comparison&)>& text,
             const std::vector<StudyPicture>& pictures) {
  CompareOptions options = flags.options;
  options.polish = !flags.no_polish;
  const auto models = ParseModels(flags.models);
  if (!models) return Refuse(models.error());
  options.models = *models;
  if (auto checked = CheckTargets(flags, pictures); !checked) return Refuse(checked.error());
  const auto curves = ReadStudyCurves(flags);
  if (!curves) return Refuse(curves.error());
  const InterruptGuard guard;
  const auto comparison = Compare(*curves, contenders, options, TerminalObserver());
  ClearProgressLine();
  if (!comparison) return Refuse(comparison.error());
  if (auto written = Write(flags, *comparison, text, pictures); !written) {
    return Refuse(written.error());
  }
  return kExitFine;
}

}  // namespace lyrefit
