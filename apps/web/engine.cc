#include "engine.h"

#include <string>
#include <utility>
#include <vector>

#include "look.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/certify/floor.h"
#include "lyrefit/devices/describe_cell.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/devices/stated_sheet.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/read/read_cell.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/page.h"
#include "lyrefit/translate/translate.h"
#include "lyrefit/translate/translation_documents.h"
#include "request.h"

namespace lyrefit {
namespace {

using nlohmann::ordered_json;

constexpr double kBetweenProgress_s = 0.1;

// Dumps JSON; invalid UTF-8, which file names may have, becomes U+FFFD.
std::string Text(const ordered_json& json) {
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

Observer ProgressObserver() {
  return [started = Now(), said = -kBetweenProgress_s,
          stage = std::string()](const Progress& progress) mutable {
    const double now = SecondsSince(started);
    if (now - said < kBetweenProgress_s && stage == progress.stage) {
      return ObserverAction::kContinue;
    }
    said = now;
    stage = progress.stage;
    double part = progress.part;
    if (part == 0 && progress.iterations > 0) {
      part = static_cast<double>(progress.iteration) / static_cast<double>(progress.iterations);
    }
    const ordered_json json = {{"stage", progress.stage}, {"part", part}, {"note", progress.note}};
    lyrefit_progress(Text(json).c_str());
    return ObserverAction::kContinue;
  };
}

// Forms of a result: the record, its page, its text and its table.
struct Result {
  bool usable = false;
  std::string name;
  std::string summary;
  Document document;
  std::string json;
  std::string json_of_page;  // empty: the same
  std::string text;
  std::string csv;
};

ordered_json Answer(const Result& result) {
  const std::string& of_page = result.json_of_page.empty() ? result.json : result.json_of_page;
  return {{"usable", result.usable},
          {"name", result.name},
          {"summary", result.summary},
          {"report_json", result.json},
          {"page_html", DrawPage(result.document, of_page, InPage())},
          {"text", result.text},
          {"csv", result.csv}};
}

Expected<IvCurve> ReadStatedCurve(const std::string& file, const ReadingForm& form) {
  TRY(IvCurve curve, ReadCurve(file, form.reading));
  TRY(ApplyConditions(form.conditions, &curve));
  return curve;
}

Expected<ordered_json> RunFit(const PageRequest& request) {
  TRY(const FitForm form, ReadFitForm(request.form));
  TRY(const IvCurve curve, ReadStatedCurve(request.file, form.file));
  TRY(FitReport report, FitWithFloor(curve, form.options, form.automatic, ProgressObserver()));
  Result result = {report.usable,       StemOf(request.file),
                   BriefReport(report), FitDocument(report),
                   JsonReport(report),  JsonReport(report, JsonPoints::kAll),
                   FullReport(report),  ""};
  result.csv = FitsCsv({{request.file, std::move(report)}});
  return Answer(result);
}

Expected<ordered_json> RunDiagnose(const PageRequest& request) {
  TRY(DiagnoseForm form, ReadDiagnoseForm(request.form));
  form.file.reading.keep_limited = true;  // a limit of the instrument is a finding
  TRY(const CurveSet set, ReadStated(request.file, form.file));
  Expected<Diagnosis> found = Diagnose(set, form.options, ProgressObserver());
  if (!found && found.error().file.empty()) found.error().file = request.file;
  TRY(const Diagnosis diagnosis, std::move(found));
  const std::string name = StemOf(request.file);
  return Answer({diagnosis.extended.usable, name, BriefDiagnosis(diagnosis),
                 DiagnosisDocument(diagnosis), DiagnosisJson(diagnosis), "",
                 DiagnosisText(diagnosis), CausesCsv({name}, {diagnosis})});
}

// Reads the further curves of a translation with the options of the first one, of whose conditions
// the number of cells alone is theirs.
Expected<std::vector<IvCurve>> ReadFurther(const TranslateForm& form) {
  constexpr std::size_t kMost = 2;
  if (form.further.size() > kMost) {
    return Fail("with-curve: procedure 3 takes at most two further curves");
  }
  ReadingForm reading;
  reading.reading = form.file.reading;
  reading.reading.curve.reset();
  reading.conditions.cells = form.file.conditions.cells;
  std::vector<IvCurve> further;
  for (const std::string& file : form.further) {
    TRY(IvCurve curve, ReadStatedCurve(file, reading));
    further.push_back(std::move(curve));
  }
  return further;
}

Expected<ordered_json> RunTranslate(const PageRequest& request) {
  TRY(TranslateForm form, ReadTranslateForm(request.form));
  if (!form.module.empty()) TRY(ReadModule(form.module, &form.options));
  TRY(const IvCurve curve, ReadStatedCurve(request.file, form.file));
  TRY(form.options.further, ReadFurther(form));
  TRY(const TranslationReport report, TranslateCurve(curve, form.options, ProgressObserver()));
  return Answer({report.Recommended() != nullptr, StemOf(request.file), BriefTranslation(report),
                 TranslationDocument(report), TranslationJson(report), "", TranslationText(report),
                 TranslationCsv(report)});
}

Expected<ordered_json> RunCell(const PageRequest& request) {
  TRY(CellForm form, ReadCellForm(request.form));
  if (request.files.empty()) return Fail("files: expected the names of a cell's measurements");
  std::optional<double>& light = form.file.conditions.irradiance_W_m2;
  TRY(CurveSet cell, ReadCell(request.files, form.file.reading, light));
  if (cell.curves.size() > 1) light.reset();  // of each that states none
  TRY(ApplyStated(form.file, request.files.front(), &cell));
  TRY(const CellReport report, DescribeCell(cell, form.options, ProgressObserver()));
  return Answer({report.Usable(), report.name, BriefCell(report), CellDocument(report),
                 CellJson(report), "", CellText(report), CellCsv(report)});
}

Expected<ordered_json> RunSheet(const PageRequest& request) {
  TRY(const StatedSheet stated, ReadSheetForm(request.form));
  TRY(const FittedSheet sheet, FitStatedSheet(stated));
  const DataSheetFit& fit = sheet.fit;
  ordered_json answer = Answer({fit.Solved(), sheet.module.name, "", DataSheetDocument(fit),
                                DataSheetJson(fit), "", DataSheetText(fit), DataSheetCsv(fit)});
  if (const Expected<std::string> pvlib = PvlibText(sheet)) answer["pvlib_json"] = *pvlib;
  return answer;
}

Expected<ordered_json> Run(const std::string& json) {
  TRY(const PageRequest request, ReadRequest(json));
  if (request.verb == "about") {
    return ordered_json{{"version", Version()}, {"forms", DescribeForms()}};
  }
  if (request.verb == "cell") return RunCell(request);
  if (request.verb == "datasheet") return RunSheet(request);
  if (request.file.empty()) return Fail("file: expected the name of a measurement");
  if (request.verb == "look") return LookAt(request);
  if (request.verb == "fit") return RunFit(request);
  if (request.verb == "diagnose") return RunDiagnose(request);
  if (request.verb == "translate") return RunTranslate(request);
  return Fail("verb: expected about, look, fit, diagnose, translate, cell or datasheet, found '" +
              request.verb + "'");
}

}  // namespace
}  // namespace lyrefit

const char* lyrefit_run(const char* request) {
  static std::string answer;
  const lyrefit::Expected<nlohmann::ordered_json> done = lyrefit::Run(request);
  answer = lyrefit::Text(done ? *done : lyrefit::ErrorJson(done.error()));
  return answer.c_str();
}
