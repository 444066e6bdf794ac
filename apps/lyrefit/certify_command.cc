#include "certify_command.h"

#include "interrupt.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/report/certificate_json.h"
#include "lyrefit/report/certificate_plot.h"
#include "lyrefit/report/certificate_text.h"
#include "lyrefit/report/plot.h"
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
  bool all = certificate.floor.gap <= kCertifiedGap && !certificate.interrupted;
  for (const ModelCertificate& model : certificate.models) all = all && model.certified;
  return all;
}

}  // namespace

CertifyCommand::CertifyCommand(CLI::App* app)
    : command_(app->add_subcommand("certify",
                                   "Prove how low the measured-current RMSE of a curve can go")) {
  command_
      ->add_option("CURVE", curve_file_, "CSV, TSV, ivcurves JSON or IV_Swinger file, or a folder")
      ->required();
  command_->add_option("--curve", curve_index_, "which curve of a file that holds several")
      ->type_name("INDEX")
      ->group("Conditions");
  AddConditionFlags(command_, &conditions_);
  command_
      ->add_option("--models", models_,
                   "models to certify beside the floor (default " + models_ + ")")
      ->type_name("LIST")
      ->group("Proof");
  AddEnumFlag(command_, "--constants", "values of k and q", &options_.constants)->group("Proof");
  AddTableFlags(command_, kCertifyOptionTable, "Proof", &options_);
  command_
      ->add_option("--json", json_file_, "the certificate as JSON; - for standard output, alone")
      ->type_name("FILE")
      ->group("Output");
  command_->add_option("--plot", plot_file_, "the dual certificate as a picture, .svg or .png")
      ->type_name("FILE")
      ->group("Output");
  command_->add_flag("--brief", brief_, "one line instead of the whole report")->group("Output");
  command_->add_flag("--quiet", quiet_, "no text report")->group("Output");
  command_->footer(kCertifyFooter);
}

Expected<IvCurve> CertifyCommand::Curve() const {
  ReadOptions read;
  read.curve = curve_index_;
  Expected<IvCurve> curve = ReadCurve(curve_file_, read);
  if (!curve) return curve;
  if (auto applied = ApplyConditionFlags(conditions_, &*curve); !applied) {
    return tl::unexpected(applied.error());
  }
  return curve;
}

Expected<void> CertifyCommand::CheckTargets() const {
  if (auto writable = CheckWritable(json_file_); !writable) return writable;
  if (plot_file_.empty()) return {};
  if (auto drawable = CheckPlot(plot_file_); !drawable) return drawable;
  return CheckWritable(plot_file_);
}

Expected<void> CertifyCommand::Write(const Certificate& certificate) const {
  if (!json_file_.empty()) {
    if (auto written = WriteOutput(json_file_, CertificateJson(certificate)); !written) {
      return written;
    }
  }
  if (!plot_file_.empty()) {
    if (auto drawn = PlotCertificate(certificate, plot_file_); !drawn) return drawn;
  }
  if (quiet_ || json_file_ == "-") return {};
  return WriteOutput("-", brief_ ? BriefCertificate(certificate) : CertificateText(certificate));
}

int CertifyCommand::Run() {
  const auto models = ParseModels(models_);
  if (!models) return Refuse(models.error());
  options_.models = *models;
  if (auto checked = CheckTargets(); !checked) return Refuse(checked.error());
  const Expected<IvCurve> curve = Curve();
  if (!curve) return Refuse(curve.error());
  const InterruptGuard guard;
  const Expected<Certificate> certificate = Certify(*curve, options_, TerminalObserver());
  ClearProgressLine();
  if (!certificate) return Refuse(certificate.error());
  if (auto written = Write(*certificate); !written) return Refuse(written.error());
  return AllCertified(*certificate) ? kExitFine : kExitNotUsable;
}

}  // namespace lyrefit
