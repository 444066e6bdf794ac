#include "bounds_flag.h"
#include "flags.h"
#include "interrupt.h"
#include "lyrefit/base/try.h"
#include "lyrefit/certify/certificate_documents.h"
#include "lyrefit/certify/certify.h"
#include "lyrefit/certify/floor.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/json.h"
#include "lyrefit/report/page.h"
#include "lyrefit/report/plots.h"
#include "verbs.h"

namespace lyrefit {
namespace {

constexpr char kCertifyFooter[] =
    "Examples:\n"
    "  lyrefit certify data/rtc_france\n"
    "  lyrefit certify data/pwp201 --bounds literature\n"
    "  lyrefit certify module.csv --cells 60 --temperature-C 47 --n-lower 0.5 --n-upper 4\n"
    "\n"
    "Exit codes: 0 fine, 1 bad input or options, 2 something could not be certified.";

struct CertifyRequest {
  CurveFlags curve;
  CertifyOptions options;
  std::string bounds;  // value of --bounds; empty: use the single ranges
  ReportFlags output;
};

void DeclareCertify(VerbLine* verb, CertifyRequest* request) {
  AddCurveFlags(verb, &request->curve);
  AddTableFlags(verb, kCertifyOptionTable, &request->options);
  AddBoundsFlag(verb, "Proof", "the single ranges", &request->bounds);
  AddReportFlags(verb, "certificate", "the floor and the models as a table, a row each",
                 "dual certificate", &request->output);
}

bool AllCertified(const Certificate& certificate) {
  bool all = certificate.floor.certified && !certificate.interrupted;
  for (const ModelCertificate& model : certificate.models) all = all && model.certified;
  return all;
}

Expected<int> RunCertify(VerbLine& verb, CertifyRequest& request) {
  const ReportFlags& output = request.output;
  if (request.curve.list_columns) {
    return PrintInspections({request.curve.file}, request.curve.reading);
  }
  TRY(verb.CheckFiles());
  TRY(const IvCurve curve, ReadFlaggedCurve(request.curve));
  CertifyOptions options = request.options;
  if (!request.bounds.empty()) {
    TRY(const BoundsSpec spec, FlaggedBounds(request.bounds, request.curve.file));
    TRY(options, CertifyWithin(spec, curve, request.options));
  }
  const InterruptGuard guard;
  TRY(const Certificate certificate, Certify(curve, options, TerminalObserver()));
  TRY(WriteWanted(output.json_file, [&] { return CertificateJson(certificate); }));
  TRY(WriteWanted(output.csv_file, [&] { return CertificateCsv(certificate); }));
  TRY(DrawWanted(output.plot_file,
                 [&](const std::string& file) { return PlotCertificate(certificate, file); }));
  TRY(WriteWanted(output.html_file, [&] {
    return DrawPage(CertificateDocument(certificate), CertificateJson(certificate));
  }));
  TRY(WriteText(verb, [&] {
    return output.brief ? BriefCertificate(certificate) : CertificateText(certificate);
  }));
  if (certificate.interrupted) return kExitInterrupted;
  return AllCertified(certificate) ? kExitFine : kExitNotUsable;
}

}  // namespace

const Verb kCertifyVerb = {"certify",
                           "Prove how low the RMSE of a curve can go",
                           kCertifyFooter,
                           "the certificate as text, --json, --csv, --plot and --html",
                           Declare<CertifyRequest, DeclareCertify, RunCertify>,
                           VerbKind::kPromised};

}  // namespace lyrefit
