#include "two_junction_run.h"

#include <fmt/format.h>

#include <utility>

#include "interrupt.h"
#include "lyrefit/base/try.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/devices/fit_two_junctions.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/page.h"
#include "lyrefit/report/plots.h"
#include "output.h"

namespace lyrefit {
namespace {

// Flags of a fit that two junctions do not have.
constexpr const char* kNotOfTwo[] = {"--model",  "--with",      "--family",     "--objective",
                                     "--bounds", "--floor",     "--noise",      "--loss",
                                     "--starts", "--no-polish", "--csv",        "--pvlib",
                                     "--pan",    "--leave-out", "--loss-scale", "--kernel"};

// The curves of all files in one set.
Expected<CurveSet> ReadAll(const std::vector<std::string>& files, const CurveFlags& flagged) {
  std::vector<CurveSet> sets;
  for (const std::string& file : files) {
    TRY(CurveSet set, ReadMeasurementOrInput(file, flagged.reading));
    TRY(ApplyConditionFlags(flagged.conditions, &set));
    sets.push_back(std::move(set));
  }
  return GatherCurves(std::move(sets));
}

Expected<void> WriteJunctions(const VerbLine& verb, const TwoJunctionReport& report,
                              const ReportFlags& output) {
  TRY(WriteWanted(output.json_file, [&] { return TwoJunctionJson(report); }));
  TRY(DrawWanted(output.plot_file, [&](const std::string& file) {
    return PlotTwoJunctions(report, file, output.marks());
  }));
  TRY(WriteWanted(output.html_file,
                  [&] { return DrawPage(TwoJunctionDocument(report), TwoJunctionJson(report)); }));
  return WriteText(verb, [&] {
    return output.brief ? BriefTwoJunctions(report) : TwoJunctionText(report, LengthWanted(verb));
  });
}

}  // namespace

void AddJunctionFlags(VerbLine* verb, JunctionFlags* flags) {
  verb->AddOption("--junctions", &flags->junctions,
                  "junctions in series, of one diode and a light each: 2 is a tandem, fitted to "
                  "all CURVEs together (default 1)")
      .Between(1, 2)
      .Group("Model")
      .Experimental();
  AddTableFlags(verb, kTwoJunctionOptionTable, &flags->options);
}

Expected<void> CheckJunctionFlags(const VerbLine& verb, const JunctionFlags& flags) {
  if (flags.junctions == 1) {
    if (!verb.Given("--light")) return {};
    return Fail("--light is about the junctions of a tandem: it needs --junctions 2");
  }
  for (const char* const name : kNotOfTwo) {
    if (verb.Has(name) && verb.Given(name)) {
      return Fail(fmt::format("{} is for one junction, not for --junctions 2", name));
    }
  }
  return {};
}

Expected<int> RunTwoJunctions(const VerbLine& verb, const std::vector<std::string>& files,
                              const CurveFlags& flagged, const JunctionFlags& flags,
                              const FitOptions& fit, const ReportFlags& output) {
  TRY(verb.CheckFiles());
  TRY(const CurveSet set, ReadAll(files, flagged));
  const InterruptGuard guard;
  TRY(const TwoJunctionReport report,
      FitTwoJunctions(set, WithOptionsOf(fit, flags.options), TerminalObserver()));
  TRY(WriteJunctions(verb, report, output));
  if (report.interrupted) return kExitInterrupted;
  return report.usable ? kExitFine : kExitNotUsable;
}

}  // namespace lyrefit
