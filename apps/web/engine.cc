#include "engine.h"

#include <string>
#include <utility>

#include "look.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/certify/floor.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/page.h"
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

Expected<ordered_json> RunFit(const PageRequest& request) {
  TRY(const FitForm form, ReadFitForm(request.form));
  TRY(IvCurve curve, ReadCurve(request.file, form.file.reading));
  TRY(ApplyConditions(form.file.conditions, &curve));
  const Observer observer = ProgressObserver();
  TRY(FitReport report, FitWithFloor(curve, form.options, form.automatic, observer));
  ordered_json answer;
  answer["usable"] = report.usable;
  answer["summary"] = BriefReport(report);
  answer["report_json"] = JsonReport(report);
  answer["page_html"] =
      DrawPage(FitDocument(report), JsonReport(report, JsonPoints::kAll), InPage());
  answer["text"] = FullReport(report);
  answer["csv"] = FitsCsv({{request.file, std::move(report)}});
  return answer;
}

Expected<ordered_json> RunDiagnose(const PageRequest& request) {
  TRY(DiagnoseForm form, ReadDiagnoseForm(request.form));
  form.file.reading.keep_limited = true;  // a limit of the instrument is a finding
  TRY(const CurveSet set, ReadStated(request.file, form.file));
  Expected<Diagnosis> found = Diagnose(set, form.options, ProgressObserver());
  if (!found && found.error().file.empty()) found.error().file = request.file;
  TRY(const Diagnosis diagnosis, std::move(found));
  ordered_json answer;
  answer["usable"] = diagnosis.extended.usable;
  answer["summary"] = BriefDiagnosis(diagnosis);
  answer["report_json"] = DiagnosisJson(diagnosis);
  answer["page_html"] = DrawPage(DiagnosisDocument(diagnosis), DiagnosisJson(diagnosis), InPage());
  answer["text"] = DiagnosisText(diagnosis);
  answer["csv"] = CausesCsv({StemOf(request.file)}, {diagnosis});
  return answer;
}

Expected<ordered_json> Run(const std::string& json) {
  TRY(const PageRequest request, ReadRequest(json));
  if (request.verb == "about") {
    return ordered_json{{"version", Version()}, {"forms", DescribeForms()}};
  }
  if (request.file.empty()) return Fail("file: expected the name of a measurement");
  if (request.verb == "look") return LookAt(request);
  if (request.verb == "fit") return RunFit(request);
  if (request.verb == "diagnose") return RunDiagnose(request);
  return Fail("verb: expected about, look, fit or diagnose, found '" + request.verb + "'");
}

ordered_json ErrorJson(const Error& error) {
  return {{"error", error.ToString()},
          {"message", error.message},
          {"file", error.file},
          {"line", error.line},
          {"column", error.column}};
}

}  // namespace
}  // namespace lyrefit

const char* lyrefit_run(const char* request) {
  static std::string answer;
  const lyrefit::Expected<nlohmann::ordered_json> done = lyrefit::Run(request);
  answer = lyrefit::Text(done ? *done : lyrefit::ErrorJson(done.error()));
  return answer.c_str();
}
