#include "family_run.h"

#include "interrupt.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/family/family_documents.h"
#include "lyrefit/family/fit_individually.h"
#include "lyrefit/model/pvlib_parameters.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/read_curve_set.h"
#include "lyrefit/read/write_pan.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/page.h"
#include "lyrefit/report/plots.h"
#include "output.h"

namespace lyrefit {
namespace {

// Reads the set and applies the flags to every curve.
Expected<CurveSet> ReadFlaggedSet(const CurveFlags& flags) {
  TRY(CurveSet set, ReadMeasurementOrInput(flags.file, flags.reading));
  TRY(ApplyConditionFlags(flags.conditions, &set));
  return set;
}

Expected<FamilyReport> FitSet(const CurveSet& set, Family family, const FamilyOptions& options) {
  switch (family) {
    case Family::kFree:
      return FitIndividually(set, options, TerminalObserver());
    case Family::kAuto:
      return FitFamilyAuto(set, options, TerminalObserver());
    case Family::kDeSoto:
    case Family::kPvsyst:
    case Family::kCec:
      break;
  }
  return FitFamily(set, options, TerminalObserver());
}

Expected<void> WritePvlib(const FamilyReport& report, const CurveSet& set,
                          const std::string& file) {
  const auto keywords = PvlibParameters(report.translation, report.refined);
  if (!keywords) return Fail("--pvlib: " + keywords.error().message);
  const std::string technology = set.curves.front().notes.technology;
  return WriteOutput(
      file, PvlibJson(report.name, report.translation.spec.law, *keywords,
                      CecRow(report.translation, report.refined, report.name, technology)));
}

Expected<void> WritePan(const FamilyReport& report, const CurveSet& set, const std::string& file) {
  const PanNotes notes = NotesOf(report.name, set.curves.front().notes);
  const auto text = PanText(report.translation, report.refined, notes);
  return text ? WriteOutput(file, *text) : Fail("--pan: " + text.error().message);
}

Expected<void> WriteSam(const FamilyReport& report, const CurveSet& set, const std::string& file) {
  const std::string technology = set.curves.front().notes.technology;
  const auto row = CecRow(report.translation, report.refined, report.name, technology);
  return row ? WriteOutput(file, CecLibraryCsv(*row)) : Fail("--sam: " + row.error().message);
}

// A PAN file implies the band gap of its technology: the fit takes that unless the user gives one.
FamilyOptions ForPan(FamilyOptions options, const CurveSet& set, const FamilyFlags& flags) {
  const bool given = options.fixed.count("EgRef") + options.fixed.count("Eg") > 0;
  if (flags.pan_file.empty() || given) return options;
  options.fixed["EgRef"] = PanBandgap_eV(set.curves.front().notes.technology);
  return options;
}

// Writes the outputs for pvlib, PVsyst and SAM last: they may fail, and all other files are then
// complete.
Expected<void> Write(const VerbLine& verb, const FamilyReport& report, const CurveSet& set,
                     const FamilyFlags& flags, const ReportFlags& output) {
  TRY(WriteWanted(output.json_file, [&] { return FamilyJson(report); }));
  TRY(WriteWanted(output.csv_file, [&] { return IndividualFitsCsv(report); }));
  TRY(DrawWanted(output.plot_file, [&](const std::string& file) {
    return PlotFamily(report, set, file, output.marks());
  }));
  TRY(WriteWanted(output.html_file,
                  [&] { return DrawPage(FamilyDocument(report, set), FamilyJson(report)); }));
  TRY(WriteText(verb, [&] {
    return output.brief ? BriefFamily(report) : FamilyText(report, LengthWanted(verb));
  }));
  if (!flags.pvlib_file.empty()) TRY(WritePvlib(report, set, flags.pvlib_file));
  if (!flags.pan_file.empty()) TRY(WritePan(report, set, flags.pan_file));
  return flags.sam_file.empty() ? Expected<void>() : WriteSam(report, set, flags.sam_file);
}

}  // namespace

Expected<int> RunFamily(const VerbLine& verb, const CurveFlags& flagged, const FamilyFlags& flags,
                        const FamilyOptions& options, const ReportFlags& output) {
  TRY(verb.CheckFiles());
  TRY(const CurveSet set, ReadFlaggedSet(flagged));
  const InterruptGuard guard;
  TRY(const FamilyReport report, FitSet(set, *flags.family, ForPan(options, set, flags)));
  TRY(Write(verb, report, set, flags, output));
  if (report.interrupted) return kExitInterrupted;
  return report.usable ? kExitFine : kExitNotUsable;
}

}  // namespace lyrefit
