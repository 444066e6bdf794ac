#include "fit_command.h"

#include <fmt/format.h>

#include "family_run.h"
#include "fit_files.h"
#include "interrupt.h"
#include "lyrefit/report/json.h"
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
    "  lyrefit fit module.csv --cells 60 --temperature-C 45 --with shading:w=0.333\n"
    "  lyrefit fit roof/*.csv --cells 60 --temperature-C 45 --csv table.csv\n"
    "  lyrefit fit folder_of_curves --family desoto --pvlib module.json --plot module.svg\n"
    "  lyrefit fit sweeps.csv --family auto --irradiance-accuracy 2% --leave-out 17,18\n"
    "  lyrefit fit sweeps.csv --family auto --fit-curves 30 --against module.json\n"
    "\n"
    "Exit codes: 0 fine; 1 bad input or options, of several files some could not be fitted; 2 a "
    "fit\n"
    "is not usable.";

}  // namespace

FitCommand::FitCommand(CommandLine* line)
    : verb_(line->AddVerb("fit", "Fit diode-model parameters to a measured I-V curve")) {
  verb_
      ->AddOption("CURVE", &files_,
                  "table (CSV, text, most instruments' files) or JSON, a folder, or - for standard "
                  "input; several: a line each")
      .Required()
      .ReadsCurves();
  AddReadingFlags(verb_, &curve_);
  AddModelFlags();
  AddSearchFlags();
  AddPolishFlags();
  AddFamilyFlags(verb_, &family_);
  AddReportFlags(verb_, "report", "fit", &output_);
  AddFullJsonSwitch(verb_, &output_);
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
  AddWithFlag(verb_, "Model", &with_list_);
}

void FitCommand::AddSearchFlags() {
  AddEnumFlag(verb_, "--algorithm", "how to search", &options_.search.algorithm).Group("Search");
  AddBirdsFlag(verb_, &options_.birds);
  AddTableFlags(verb_, kSearchOptionTable, "Search", &options_.search);
}

void FitCommand::AddPolishFlags() {
  verb_->AddSwitch("--no-polish", &no_polish_, "answer with the search's best bird")
      .Group("Polish");
  verb_
      ->AddSwitch("--floor", &options_.floor,
                  "also prove how low the measured-current RMSE can go within the bounds")
      .Group("Polish");
  verb_
      ->AddOption("--noise", &noise_,
                  "errors of the readings that the polish weighs by: white, field (found from the "
                  "residuals), or a JSON file with their sizes (default white)")
      .Type("NAME|FILE")
      .Group("Polish")
      .Reads();
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

Expected<void> FitCommand::SetFixed() {
  for (const std::string& text : fix_list_) {
    const auto assignment = ParseAssignment("--fix", text);
    if (!assignment) return tl::unexpected(assignment.error());
    options_.fixed[assignment->first] = assignment->second;
  }
  auto with = ParseWith(with_list_);
  if (!with) return tl::unexpected(with.error());
  options_.with = std::move(*with);
  options_.force_effects = verb_->Forced() && !options_.with.empty();
  if (!options_.with.empty()) {
    const SearchOptions usual = FitOptions::SearchBesideShapes();
    if (!verb_->Given("--population")) options_.search.population = usual.population;
    if (!verb_->Given("--iterations")) options_.search.iterations = usual.iterations;
  }
  if (auto_model_ && !options_.with.empty()) {
    return Fail("--model auto chooses among diodes alone: say which --model stands beside --with");
  }
  return {};
}

Expected<void> FitCommand::SetErrors() {
  Expected<ErrorSpec> errors = ErrorsNamed(noise_);
  if (!errors) return Fail("--noise: " + errors.error().ToString());
  options_.errors = std::move(*errors);
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

Expected<FitReport> FitCommand::FitFile(const std::string& file, int threads,
                                        const Observer& observer) const {
  FitOptions options = options_;
  options.threads = threads;
  Expected<BoundsSpec> bounds = BoundsFromFlags(bounds_, file);
  if (!bounds) return tl::unexpected(bounds.error());
  options.bounds = std::move(*bounds);
  CurveFlags flags = curve_;
  flags.file = file;
  const Expected<IvCurve> curve = ReadFlaggedCurve(flags);
  if (!curve) return tl::unexpected(WhyNotOneCurve(flags, curve.error()));
  return auto_model_ ? FitAuto(*curve, options, observer) : Fit(*curve, options, observer);
}

Expected<void> FitCommand::Write(const std::vector<FittedFile>& fits) const {
  const bool one = files_.size() == 1;
  if (!output_.json_file.empty()) {
    const std::string json =
        one ? JsonReport(*fits.front().report, output_.points()) : FitsJson(fits, output_.points());
    if (auto written = WriteOutput(output_.json_file, json); !written) return written;
  }
  if (!family_.csv_file.empty()) {
    if (auto written = WriteOutput(family_.csv_file, FitsCsv(fits)); !written) return written;
  }
  if (!output_.plot_file.empty()) {
    if (auto drawn = PlotFit(*fits.front().report, output_.plot_file); !drawn) return drawn;
  }
  if (!verb_->TextWanted()) return {};
  std::string text;
  for (const FittedFile& fit : fits) {
    if (!fit.report) continue;
    text += one && !output_.brief ? FullReport(*fit.report) : BriefReport(*fit.report);
  }
  return WriteOutput("-", text);
}

int FitCommand::RunFamilyFit() {
  if (auto_model_) {
    return Refuse(
        {"--model auto is for one curve: --family auto chooses among laws and diodes", {}});
  }
  if (files_.size() > 1) {
    return Refuse({"--family takes one set of curves: put the files into a folder", {}});
  }
  curve_.file = files_.front();
  for (const auto& checked : {SetFixed(), SetErrors()}) {
    if (!checked) return Refuse(checked.error());
  }
  const Expected<FamilyOptions> options =
      FamilyOptionsFromFlags(*verb_, family_, options_, bounds_.ranges);
  if (!options) return Refuse(options.error());
  return RunFamily(*verb_, curve_, family_, *options, output_);
}

int FitCommand::RunOne() {
  const InterruptGuard guard;
  Expected<FitReport> report = FitFile(files_.front(), options_.threads, TerminalObserver());
  if (!report) return Refuse(report.error());
  const int exit_code = report->interrupted ? kExitInterrupted
                        : report->usable    ? kExitFine
                                            : kExitNotUsable;
  if (auto written = Write({{files_.front(), std::move(report)}}); !written) {
    return Refuse(written.error());
  }
  return exit_code;
}

Expected<void> FitCommand::CheckMany() const {
  for (const char* flag : {"--plot", "--curve"}) {
    if (verb_->Given(flag)) return Fail(std::string(flag) + " is for one CURVE");
  }
  return {};
}

// A file that cannot be fitted keeps no other from it.
int FitCommand::RunMany() {
  if (auto checked = CheckMany(); !checked) return Refuse(checked.error());
  const InterruptGuard guard;
  const std::vector<FittedFile> fits =
      FitFiles(files_, options_.threads, TerminalObserver({"fit"}),
               [this](const std::string& file, const Observer& observer) {
                 return FitFile(file, 1, observer);
               });
  int exit_code = kExitFine;
  bool interrupted = fits.size() < files_.size();
  for (const FittedFile& fit : fits) {
    if (!fit.report) {
      exit_code = Refuse(fit.report.error());
      continue;
    }
    interrupted = interrupted || fit.report->interrupted;
    if (!fit.report->usable && exit_code == kExitFine) {
      exit_code = kExitNotUsable;
    }
  }
  if (auto written = Write(fits); !written) return Refuse(written.error());
  return interrupted ? kExitInterrupted : exit_code;
}

int FitCommand::Run() {
  if (curve_.list_columns) return PrintColumns(files_, curve_.reading);
  if (auto checked = CheckFamilyFlags(*verb_, family_); !checked) {
    return Refuse(checked.error());
  }
  if (family_.family) return RunFamilyFit();
  options_.polish = !no_polish_;
  for (const auto& checked : {SetFixed(), SetErrors(), SetKernel(), verb_->CheckFiles()}) {
    if (!checked) return Refuse(checked.error());
  }
  return files_.size() == 1 ? RunOne() : RunMany();
}

}  // namespace lyrefit
