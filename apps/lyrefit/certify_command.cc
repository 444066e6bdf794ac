#include "certify_command.h"

#include "interrupt.h"
#include "lyrefit/report/certificate_plot.h"
#include "lyrefit/report/certificate_text.h"
#include "lyrefit/report/json.h"
#include "output.h"
#include "study_flags.h"

namespace lyrefit {
namespace {

constexpr char kCertifyFooter[] =
    "Examples:\n"
    "  lyrefit certify data/rtc_france\n"
    "  lyrefit certify module.csv --cells 60 --temperature-C 47 --n-lower 0.5 --n-upper 4\n"
    "\n"
    "Exit codes: 0 fine, 1 bad input or options, 2 something could not be certified.";

bool AllCertified(const Certificate& certificate) {
  bool all = certificate.floor.certified && !certificate.interrupted;
  for (const ModelCertificate& model : certificate.models) all = all && model.certified;
  return all;
}

}  // namespace

CertifyCommand::CertifyCommand(CommandLine* line)
    : verb_(line->AddVerb("certify", "Prove how low the measured-current RMSE of a curve can go")) {
  AddCurveFlags(verb_, &curve_);
  verb_
      ->AddOption("--models", &models_,
                  "models to certify beside the floor (default " + models_ + ")")
      .Type("LIST")
      .Group("Proof");
  AddEnumFlag(verb_, "--constants", "values of k and q", &options_.constants).Group("Proof");
  AddTableFlags(verb_, kCertifyOptionTable, "Proof", &options_);
  AddReportFlags(verb_, "certificate", "dual certificate", &output_);
  verb_->Footer(kCertifyFooter);
}

Expected<void> CertifyCommand::Write(const Certificate& certificate) const {
  if (!output_.json_file.empty()) {
    if (auto written = WriteOutput(output_.json_file, CertificateJson(certificate)); !written) {
      return written;
    }
  }
  if (!output_.plot_file.empty()) {
    if (auto drawn = PlotCertificate(certificate, output_.plot_file); !drawn) return drawn;
  }
  if (!verb_->TextWanted()) return {};
  return WriteOutput("-",
                     output_.brief ? BriefCertificate(certificate) : CertificateText(certificate));
}

int CertifyCommand::Run() {
  if (curve_.list_columns) return PrintColumns({curve_.file}, curve_.reading);
  const auto models = ParseModels(models_);
  if (!models) return Refuse(models.error());
  options_.models = *models;
  if (auto checked = verb_->CheckFiles(); !checked) return Refuse(checked.error());
  const Expected<IvCurve> curve = ReadFlaggedCurve(curve_);
  if (!curve) return Refuse(curve.error());
  const InterruptGuard guard;
  const Expected<Certificate> certificate = Certify(*curve, options_, TerminalObserver());
  if (!certificate) return Refuse(certificate.error());
  if (auto written = Write(*certificate); !written) return Refuse(written.error());
  if (certificate->interrupted) return kExitInterrupted;
  return AllCertified(*certificate) ? kExitFine : kExitNotUsable;
}

}  // namespace lyrefit
