#include "fit_command.h"

#include <fmt/format.h>

#include "family_run.h"
#include "interrupt.h"
#include "lyrefit/report/json_report.h"
#include "lyrefit/report/plot.h"
#include "lyrefit/report/text_report.h"
#include "output.h"

namespace lyrefit {
namespace {

constexpr char kFitFooter[] =
    "Examples:\n"
    "  lyrefit fit data/rtc_france --model sd\n"
    "  lyrefit fit module.csv --cells 36 --temperature-C 45 --model auto --plot module.svg\n"
    "  lyrefit fit cell.csv --model dd --fix n2=2 --bound Rs=0:0.1 --json -\n"
    "  lyrefit fit folder_of_curves --family desoto --pvlib module.json --plot module.svg\n"
    "  lyrefit fit sweeps.csv --family auto --irradiance-accuracy 2% --leave-out 17,18\n"
    "  lyrefit fit sweeps.csv --family auto --fit-curves 30 --against module.json\n"
    "\n"
    "Exit codes: 0 fine, 1 bad input or options, 2 the fit is not usable.";

}  // namespace

FitCommand::FitCommand(CommandLine* line)
    : verb_(line->AddVerb("fit", "Fit diode-model parameters to a measured I-V curve")) {
  AddCurveFlags(verb_, &curve_);
  AddModelFlags();
  AddSearchFlags();
  AddPolishFlags();
  AddFamilyFlags(verb_, &family_);
  AddReportFlags(verb_, "report", "fit", &output_);
  verb_->Footer(kFitFooter);
}

void FitCommand::AddModelFlags() {
  const auto parse_model = [this](const std::string& text) -> Expected<void> {
    const std::optional<Model> model = FromText<Model>(text);
    auto_model_ = text == "auto";
    if (!model && !auto_model_) {
      return Fail("expected one of " + AllTexts<Model>() + ", auto, found '" + text + "'");
    }
    options_.model = model.value_or(Model::kSingleDiode);
    return {};
  };
  verb_
      ->AddReader("--model", parse_model,
                  "number of diodes: sd, dd, td, or auto, which lets the data decide (default sd)")
      .Type("NAME")
      .Group("Model");
  AddEnumFlag(verb_, "--objective", "which residual is squared", &options_.objective)
      .Group("Model");
  AddEnumFlag(verb_, "--constants", "values of k and q", &options_.constants).Group("Model");
  AddBoundsFlags(verb_, "Model", &bounds_);
  AddListFlag(verb_, "--fix", "holds a parameter, n2=2; once for each", &fix_list_)
      .Type("P=VALUE")
      .Group("Model");
}

void FitCommand::AddSearchFlags() {
  AddEnumFlag(verb_, "--algorithm", "how to search", &options_.search.algorithm).Group("Search");
  AddTableFlags(verb_, kSearchOptionTable, "Search", &options_.search);
}

void FitCommand::AddPolishFlags() {
  verb_->AddSwitch("--no-polish", &no_polish_, "answer with the search's best bird")
      .Group("Polish");
  verb_
      ->AddSwitch("--floor", &options_.floor,
                  "also prove how low the measured-current RMSE can go within the bounds")
      .Group("Polish");
  AddEnumFlag(verb_, "--loss", "of the polish", &options_.loss).Group("Polish");
  verb_
      ->AddOption("--loss-scale", &options_.loss_scale,
                  "noise units beyond which a robust loss bends (default " +
                      NumberText(options_.loss_scale) + ")")
      .Type("NUMBER")
      .Group("Polish");
  AddEnumFlag(verb_, "--intervals", "95 % intervals", &options_.intervals).Group("Polish");
  verb_
      ->AddOption("--threads", &options_.threads,
                  "0: all cores; never changes a result (default 0)")
      .Between(0, 1024)
      .Type("N")
      .Group("Polish");
  std::string kernels;
  for (const Kernel& kernel : AvailableKernels()) {
    kernels += std::string(kernels.empty() ? "" : ", ") + kernel.name;
  }
  verb_
      ->AddOption("--kernel", &kernel_,
                  "instruction set of the heavy loops; never changes a result: " + kernels +
                      " (default: the fastest)")
      .Type("NAME")
      .Group("Polish");
}

Expected<void> FitCommand::SetBounds() {
  Expected<BoundsSpec> spec = BoundsFromFlags(bounds_, curve_.file);
  if (!spec) return tl::unexpected(spec.error());
  options_.bounds = std::move(*spec);
  return {};
}

Expected<void> FitCommand::SetFixed() {
  for (const std::string& text : fix_list_) {
    const auto assignment = ParseAssignment("--fix", text);
    if (!assignment) return tl::unexpected(assignment.error());
    options_.fixed[assignment->first] = assignment->second;
  }
  return {};
}

Expected<void> FitCommand::SetKernel() {
  if (kernel_.empty()) return {};
  std::string names;
  for (const Kernel& kernel : AvailableKernels()) {
    if (kernel_ == kernel.name) {
      options_.kernel = &kernel;
      return {};
    }
    names += (names.empty() ? "" : ", ") + std::string(kernel.name);
  }
  return Fail(fmt::format("--kernel: this processor runs {}, not '{}'", names, kernel_));
}

Expected<void> FitCommand::Write(const FitReport& report) const {
  if (!output_.json_file.empty()) {
    if (auto written = WriteOutput(output_.json_file, JsonReport(report)); !written) return written;
  }
  if (!output_.plot_file.empty()) {
    if (auto drawn = PlotFit(report, output_.plot_file); !drawn) return drawn;
  }
  if (!TextWanted(*verb_, output_)) return {};
  return WriteOutput("-", output_.brief ? BriefReport(report) : FullReport(report));
}

int FitCommand::RunFamilyFit() {
  if (auto_model_) {
    return Refuse(
        {"--model auto is for one curve: --family auto chooses among laws and diodes", {}});
  }
  if (auto fixed = SetFixed(); !fixed) return Refuse(fixed.error());
  const Expected<FamilyOptions> options =
      FamilyOptionsFromFlags(*verb_, family_, options_, bounds_.ranges);
  if (!options) return Refuse(options.error());
  return RunFamily(*verb_, curve_, family_, *options, output_);
}

int FitCommand::Run() {
  if (auto checked = CheckFamilyFlags(*verb_, family_); !checked) {
    return Refuse(checked.error());
  }
  if (family_.family) return RunFamilyFit();
  options_.polish = !no_polish_;
  for (const auto& checked : {SetBounds(), SetFixed(), SetKernel(), verb_->CheckFiles()}) {
    if (!checked) return Refuse(checked.error());
  }
  const Expected<IvCurve> curve = ReadFlaggedCurve(curve_);
  if (!curve) return Refuse(WhyNotOneCurve(curve_, curve.error()));
  if (output_.quiet) SilenceProgress();
  const InterruptGuard guard;
  const Expected<FitReport> report = auto_model_ ? FitAuto(*curve, options_, TerminalObserver())
                                                 : Fit(*curve, options_, TerminalObserver());
  if (!report) return Refuse(report.error());
  if (auto written = Write(*report); !written) return Refuse(written.error());
  if (report->interrupted) return kExitInterrupted;
  return report->usable ? kExitFine : kExitNotUsable;
}

}  // namespace lyrefit
