#include "diagnose_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "effect_text.h"
#include "interrupt.h"
#include "lyrefit/report/diagnosis_plot.h"
#include "lyrefit/report/diagnosis_text.h"
#include "lyrefit/report/json.h"
#include "output.h"
#include "study_flags.h"

namespace lyrefit {
namespace {

constexpr char kDiagnoseFooter[] =
    "Examples:\n"
    "  lyrefit diagnose sweep.csv --cells 60 --temperature-C 45 --plot diagnosis.svg\n"
    "  lyrefit diagnose folder_of_curves --base dd --json diagnosis.json --extend model.json\n"
    "  lyrefit diagnose roof/*.csv --effects nonohmic_shunt,clip --answers answers.json\n"
    "  lyrefit diagnose today.csv --healthy last_year/*.csv\n"
    "  lyrefit diagnose folder_of_sweeps --module\n"
    "  lyrefit diagnose --explain nonohmic_shunt\n"
    "\n"
    "A measurement is one sweep, up and down sweeps, a lit and a dark curve, or curves over\n"
    "irradiance and temperature, in one file or folder. Of several files every one has a line.\n"
    "\n"
    "Exit codes: 0 fine, found or not; 1 bad input or options, of several files some could not be\n"
    "diagnosed; 2 a fit is not usable.";

// As the answers name it: "data/roof/sweep.csv" is "sweep".
std::string Stem(const std::string& file) {
  const std::filesystem::path path = std::filesystem::path(file).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).stem().string();
}

}  // namespace

DiagnoseCommand::DiagnoseCommand(CommandLine* line)
    : verb_(line->AddVerb("diagnose",
                          "Say what a diode model gets wrong in a measurement, and why")) {
  verb_->AddOption("CURVE", &files_, "files or folders, a measurement each; - for standard input")
      .ReadsCurves();
  verb_->AddSwitch("--together", &together_,
                   "all files are one measurement: lit and dark, up and down, a family");
  AddColumnFlags(verb_, &reading_, &list_columns_);
  AddConditionFlags(verb_, &conditions_);
  AddDiagnosisFlags();
  AddHealthyFlags();
  AddCatalogueFlags();
  AddReportFlags(verb_, "diagnosis", "diagnosis", &output_);
  AddFullJsonSwitch(verb_, &output_);
  verb_
      ->AddOption("--extend", &extend_file_,
                  "the model with its causes, fitted, as the JSON of fit; - for standard output, "
                  "alone")
      .Writes();
  verb_
      ->AddOption("--answers", &answers_file_,
                  "the bare answers by file as JSON, each cause with what it could be too; - for "
                  "standard output, alone")
      .Writes();
  verb_->Footer(kDiagnoseFooter);
}

void DiagnoseCommand::AddDiagnosisFlags() {
  const auto parse_base = [this](const std::string& text) -> Expected<void> {
    const std::optional<Model> model = FromText<Model>(text);
    if (!model || *model == Model::kTripleDiode) {
      return Fail("expected sd or dd, found '" + text + "'");
    }
    options_.base = *model;
    return {};
  };
  verb_
      ->AddReader("--base", parse_base,
                  "the model that is diagnosed: sd, or dd with n2 = 2 (default sd)")
      .Type("NAME")
      .Group("Diagnosis");
  verb_
      ->AddOption(
          "--noise", &noise_,
          "errors of the readings: white, each its own; field, beside it light that wanders "
          "and a module that departs from the model; or a JSON file with their sizes "
          "(default field)")
      .Type("NAME|FILE")
      .Group("Diagnosis")
      .Reads();
  verb_->AddOption("--effects", &effects_, "those to try (default: all that the data can show)")
      .Type("ID[,ID]")
      .Group("Diagnosis");
  AddTableFlags(verb_, kDiagnoseOptionRows, "Diagnosis", &options_);
  verb_
      ->AddSwitch("--no-held-out", &no_held_out_,
                  "do not measure the gain on readings that were not fitted")
      .Group("Diagnosis");
  verb_
      ->AddSwitch(
          "--plan", &options_.plan,
          "simulate which further measurement tells the first cause from what looks like it")
      .Group("Diagnosis");
  verb_
      ->AddOption("--threads", &options_.threads,
                  "0: all cores; never changes a result (default 0)")
      .Between(0, 1024)
      .Type("N")
      .Group("Diagnosis");
}

void DiagnoseCommand::AddCatalogueFlags() {
  verb_->AddSwitch("--list", &list_, "list the effects that are known").Group("Catalogue");
  verb_->AddOption("--explain", &explain_, "say all about one effect")
      .Type("EFFECT")
      .Group("Catalogue");
}

Expected<void> DiagnoseCommand::CheckFlags() {
  if (files_.empty()) return Fail("CURVE is required: a file or folder to diagnose");
  if (Several() && !(output_.plot_file.empty() && extend_file_.empty())) {
    return Fail("--plot and --extend are for one CURVE");
  }
  options_.held_out = !no_held_out_;
  options_.extend = !extend_file_.empty();
  Expected<ErrorSpec> errors = ErrorsNamed(noise_);
  if (!errors) return Fail("--noise: " + errors.error().ToString());
  options_.noise = std::move(*errors);
  if (!effects_.empty()) {
    auto ids = ParseList("--effects", effects_);
    if (!ids) return tl::unexpected(ids.error());
    options_.effects = std::move(*ids);
  }
  if (auto checked = CheckEffects("--effects", options_.effects); !checked) return checked;
  if (auto checked = CheckNames(); !checked) return checked;
  if (auto checked = CheckHealthyFlags(); !checked) return checked;
  return verb_->CheckFiles();
}

// Answers are told apart by their names.
Expected<void> DiagnoseCommand::CheckNames() const {
  if (answers_file_.empty()) return {};
  std::set<std::string> names;
  for (const std::string& file : files_) {
    if (!names.insert(Stem(file)).second) {
      return Fail(fmt::format("--answers: two files are named '{}'", Stem(file)), file);
    }
  }
  return {};
}

Expected<CurveSet> DiagnoseCommand::Read(const std::vector<std::string>& files) const {
  if (files.size() > 1) return ReadMeasurement(files, reading_);
  if (files.front() != "-") return ReadMeasurement(files.front(), reading_);
  Expected<IvCurve> curve = ReadCurveOrInput("-", reading_);
  if (!curve) return tl::unexpected(curve.error());
  return SetOfOne(std::move(*curve));
}

Expected<Diagnosis> DiagnoseCommand::DiagnoseFiles(const std::vector<std::string>& files) const {
  const std::string& file = files.front();
  Expected<CurveSet> set = Read(files);
  if (!set) return tl::unexpected(set.error());
  if (conditions_.irradiance_W_m2 && set->curves.size() > 1) {
    return Fail(fmt::format("--irradiance-Wm2 is for one curve, this measurement has {}",
                            set->curves.size()),
                file);
  }
  if (auto applied = ApplyConditionFlags(conditions_, &*set); !applied) {
    return tl::unexpected(applied.error());
  }
  Expected<Diagnosis> diagnosis = Diagnose(*set, options_, TerminalObserver());
  if (!diagnosis && diagnosis.error().file.empty()) diagnosis.error().file = file;
  return diagnosis;
}

Expected<void> DiagnoseCommand::WriteText(const std::vector<Diagnosis>& diagnoses) const {
  std::string text;
  for (const Diagnosis& diagnosis : diagnoses) {
    const bool brief = output_.brief || Several();
    text += brief ? BriefDiagnosis(diagnosis) : DiagnosisText(diagnosis);
  }
  return WriteOutput("-", text);
}

Expected<void> DiagnoseCommand::Write(const std::vector<std::string>& names,
                                      const std::vector<Diagnosis>& diagnoses) const {
  if (diagnoses.empty()) return {};
  const Diagnosis& first = diagnoses.front();
  if (!output_.json_file.empty()) {
    const std::string json = Several() ? DiagnosisJson(diagnoses) : DiagnosisJson(first);
    if (auto written = WriteOutput(output_.json_file, json); !written) return written;
  }
  if (!extend_file_.empty()) {
    auto written = WriteOutput(extend_file_, JsonReport(first.extended, output_.points()));
    if (!written) return written;
  }
  if (!answers_file_.empty()) {
    auto written = WriteOutput(answers_file_, AnswersJson(names, diagnoses));
    if (!written) return written;
  }
  if (!output_.plot_file.empty()) {
    if (auto drawn = PlotDiagnosis(first, output_.plot_file); !drawn) return drawn;
  }
  return verb_->TextWanted() ? WriteText(diagnoses) : Expected<void>();
}

int DiagnoseCommand::Run() {
  if (list_ || !explain_.empty()) {
    const Expected<std::string> text = list_ ? EffectList() : ExplainEffect(explain_);
    if (!text) return Refuse(text.error());
    const auto written = WriteOutput("-", *text);
    return written ? kExitFine : Refuse(written.error());
  }
  if (auto checked = CheckFlags(); !checked) return Refuse(checked.error());
  const InterruptGuard guard;
  if (module_) return RunModule();
  if (!healthy_files_.empty()) return RunHealthy();
  std::vector<std::string> names;
  std::vector<Diagnosis> diagnoses;
  int exit_code = kExitFine;
  std::vector<std::vector<std::string>> measurements;
  if (together_) measurements = {files_};
  for (const std::string& file : files_) {
    if (!together_) measurements.push_back({file});
  }
  for (const std::vector<std::string>& files : measurements) {
    Expected<Diagnosis> diagnosis = DiagnoseFiles(files);
    if (!diagnosis) {
      exit_code = Refuse(diagnosis.error());
      continue;
    }
    if (!diagnosis->extended.usable && exit_code == kExitFine) exit_code = kExitNotUsable;
    names.push_back(Stem(files.front()));
    diagnoses.push_back(std::move(*diagnosis));
    if (diagnoses.back().interrupted) break;
  }
  if (auto written = Write(names, diagnoses); !written) return Refuse(written.error());
  if (!diagnoses.empty() && diagnoses.back().interrupted) return kExitInterrupted;
  return exit_code;
}

}  // namespace lyrefit
