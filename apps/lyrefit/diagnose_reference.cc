#include <fmt/format.h>

#include "diagnose_request.h"
#include "interrupt.h"
#include "lyrefit/base/try.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/page.h"
#include "lyrefit/report/plots.h"

namespace lyrefit {
namespace {

Expected<std::vector<IvCurve>> ReadSweeps(const DiagnoseRequest& request,
                                          const std::vector<std::string>& files,
                                          const ConditionOptions& conditions) {
  std::vector<IvCurve> sweeps;
  for (const std::string& file : files) {
    TRY(CurveSet set, ReadMeasurementOrInput(file, request.reading));
    TRY(ApplyConditionFlags(conditions, &set));
    for (IvCurve& curve : set.curves) {
      FillLayout(request.layout, &curve);
      sweeps.push_back(std::move(curve));
    }
  }
  return sweeps;
}

Expected<void> Write(const VerbLine& verb, const DiagnoseRequest& request,
                     const ReferenceComparison& comparison, const Diagnosis& diagnosis) {
  const ReportFlags& output = request.output;
  TRY(WriteWanted(output.json_file, [&] { return ReferenceJson(comparison, diagnosis); }));
  TRY(WriteWanted(output.csv_file, [&] { return CausesCsv({comparison.name}, {diagnosis}); }));
  TRY(WriteWanted(request.extend_file,
                  [&] { return JsonReport(diagnosis.extended, output.points()); }));
  TRY(DrawWanted(output.plot_file, [&](const std::string& file) {
    return PlotDiagnosis(diagnosis, file, output.marks());
  }));
  TRY(WriteWanted(output.html_file, [&] {
    return DrawPage(ReferenceDocument(comparison, diagnosis), ReferenceJson(comparison, diagnosis));
  }));
  return WriteText(verb, [&] {
    return output.brief
               ? BriefReference(comparison) + BriefDiagnosis(diagnosis)
               : ReferenceText(comparison) + "\n" + DiagnosisText(diagnosis, LengthWanted(verb));
  });
}

}  // namespace

void AddReferenceFlags(VerbLine* verb, DiagnoseRequest* request) {
  constexpr char kGroup[] = "Against its own history";
  verb->AddOption(
          "--reference", &request->reference_files,
          "reference sweeps of the same module or its neighbours, files or folders: CURVE is "
          "compared with them, and diagnosed without what they all have")
      .ReadsCurves()
      .Group(kGroup);
  verb->AddSwitch("--module", &request->module,
                  "all curves of CURVE are sweeps of one module: find the outliers; beside one "
                  "CURVE and a sheet: the sheet is of its module")
      .Group(kGroup);
  AddTableFlags(verb, kReferenceOptionTable, &request->reference);
}

Expected<void> CheckReferenceFlags(const DiagnoseRequest& request) {
  const bool module = request.module;
  if (!module && request.reference_files.empty()) return {};
  if (module && !request.reference_files.empty())
    return Fail("only one of --reference and --module");
  if (request.together || !request.answers_file.empty()) {
    return Fail("--together and --answers are not for --reference and --module");
  }
  if (module && !(request.output.plot_file.empty() && request.extend_file.empty())) {
    return Fail("--plot and --extend are not for --module");
  }
  if (!module && request.files.size() > 1) {
    return Fail("--reference compares one CURVE; for many sweeps of one module: --module");
  }
  return {};
}

Expected<int> RunModule(const VerbLine& verb, const DiagnoseRequest& request) {
  const ReportFlags& output = request.output;
  TRY(const auto sweeps, ReadSweeps(request, request.files, request.conditions));
  TRY(const OutlierSweeps outliers, FindOutlierSweeps(sweeps, request.reference));
  TRY(WriteWanted(output.json_file, [&] { return OutlierSweepsJson(outliers); }));
  TRY(WriteWanted(output.csv_file, [&] { return OutlierSweepsCsv(outliers); }));
  TRY(WriteWanted(output.html_file, [&] {
    return DrawPage(OutlierSweepsDocument(outliers), OutlierSweepsJson(outliers));
  }));
  TRY(WriteText(verb, [&] {
    return output.brief ? BriefOutlierSweeps(outliers) : OutlierSweepsText(outliers);
  }));
  return kExitFine;
}

Expected<int> RunReferences(const VerbLine& verb, const DiagnoseRequest& request) {
  TRY(auto sweep, ReadSweeps(request, request.files, request.conditions));
  if (request.options.setup != Setup::kUnknown) {
    for (IvCurve& curve : sweep) curve.notes.setup = request.options.setup;
  }
  if (sweep.size() != 1) {
    return Fail(
        fmt::format("--reference compares one sweep, this measurement has {} curves", sweep.size()),
        request.files.front());
  }
  ConditionOptions module = request.conditions;  // without the conditions of this sweep
  module.irradiance_W_m2.reset();
  module.temperature_C.reset();
  TRY(const auto reference, ReadSweeps(request, request.reference_files, module));
  TRY(const auto comparison, CompareWithReferences(sweep.front(), reference, request.reference));
  const InterruptGuard guard;
  TRY(const Diagnosis diagnosis,
      Diagnose(comparison.without_common, request.options, TerminalObserver()));
  TRY(Write(verb, request, comparison, diagnosis));
  if (diagnosis.interrupted) return kExitInterrupted;
  return diagnosis.extended.usable ? kExitFine : kExitNotUsable;
}

}  // namespace lyrefit
