#include "batch_request.h"
#include "bounds_flag.h"
#include "effect_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/read_module.h"
#include "lyrefit/settings/bounds_file.h"
#include "model_flag.h"
#include "translation_flags.h"

namespace lyrefit {
namespace {

// Options of the diagnosis that a row can report: without the gain on held-out readings and without
// a plan.
const std::vector<std::string> kDiagnoseRows = {"base",          "effects",     "probability",
                                                "priors",        "setup",       "age",
                                                "floor-current", "floor-power", "largest-causes"};

// Flags declared by AddSharedTaskFlags and by the batch itself; its --plan is that of a plant.
bool IsShared(const std::string& flag) {
  return flag == "--seed" || flag == "--threads" || flag == "--noise" || flag == "--plan";
}

// The first given flag of a table.
template <class Options, class Table>
std::string GivenOf(const VerbLine& verb, const Table& table, const Options& usual) {
  std::string given;
  ForRows(table, [&](const OptionRow<Options>& row, const std::string&) {
    if (row.Is(OptionTrait::kNoFlag)) return;  // declared by the verb itself, such as --force
    const std::string flag = FlagName(row, usual);
    if (given.empty() && !IsShared(flag) && verb.Has(flag) && verb.Given(flag)) given = flag;
  });
  return given;
}

void DeclareFitFlags(VerbLine* verb, BatchRequest* request) {
  AddModelFlag(verb, &request->fit.model, &request->auto_model);
  AddNamedFlags(verb, kFitOptionTable, {"objective", "constants"}, &request->fit);
  AddBoundsFlag(verb, "Model", &request->bounds);
  AddTableFlags(verb, kFitOptionTable, &request->fit, "Model");
  AddTableFlags(verb, kFitOptionTable, &request->fit, "Search");
  AddTableFlags(verb, kSearchOptionTable, &request->fit.search);
  AddTableFlags(verb, kFitOptionTable, &request->fit);
}

std::string GivenFitFlag(const VerbLine& verb) {
  if (verb.Given("--bounds")) return "--bounds";
  const std::string flag = GivenOf(verb, kFitOptionTable, FitOptions());
  return flag.empty() ? GivenOf(verb, kSearchOptionTable, SearchOptions()) : flag;
}

Expected<BatchTaskType> MakeFit(const VerbLine& verb, const BatchRequest& request) {
  FitOptions options = request.fit;
  const auto ranges = options.bounds.overrides;
  TRY(options.bounds, NamedBounds(request.bounds, request.inputs.front()));
  for (const auto& [name, range] : ranges) options.bounds.overrides[name] = range;
  if (!options.with.empty()) {
    const SearchOptions usual = FitOptions::SearchBesideShapes();
    if (!verb.Given("--population")) options.search.population = usual.population;
    if (!verb.Given("--iterations")) options.search.iterations = usual.iterations;
    if (request.auto_model) {
      return Fail(
          "--model auto chooses among diodes alone: say which --model stands beside "
          "--with");
    }
  }
  return FitTask(options, request.auto_model);
}

void DeclareDiagnoseFlags(VerbLine* verb, BatchRequest* request) {
  AddNamedFlags(verb, kDiagnoseOptionTable, kDiagnoseRows, &request->diagnose);
}

std::string GivenDiagnoseFlag(const VerbLine& verb) {
  return GivenOf(verb, kDiagnoseOptionTable, DiagnoseOptions());
}

Expected<BatchTaskType> MakeDiagnose(const VerbLine& /*verb*/, const BatchRequest& request) {
  TRY(CheckEffects("--effects", request.diagnose.effects));
  return DiagnoseTask(request.diagnose);
}

// Draws of the propagation of uncertainty.
constexpr char kUncertaintyDraws[] = "--uncertainty-draws";

// All rows except the target, which is standard conditions.
const std::vector<std::string> kTranslateRows = {"procedures",      "key-points",
                                                 "lead-resistance", "rear-irradiance-Wm2",
                                                 "bifaciality",     "technology"};

void DeclareFieldTestFlags(VerbLine* verb, BatchRequest* request) {
  TranslateOptions& options = request->translate;
  AddNamedFlags(verb, kTranslateOptionTable, kTranslateRows, &options);
  AddTranslationFlags(verb, " of all strings", &request->coefficients_file, &request->module_file,
                      &options);
  const auto* const draws = FindRow(kUncertaintyOptionTable, "draws");
  verb->AddOption(kUncertaintyDraws, &options.uncertainty.draws, draws->doc)
      .Type("N")
      .Group("Uncertainty");
}

std::string GivenFieldTestFlag(const VerbLine& verb) {
  if (verb.Given("--coefficients")) return "--coefficients";
  const TranslateOptions usual;
  for (const std::string& flag : {GivenOf(verb, kTranslateOptionTable, usual),
                                  GivenOf(verb, kCoefficientTable, usual.coefficients),
                                  GivenOf(verb, kFieldTestOptionTable, usual.field_test),
                                  GivenOf(verb, kFieldNotesTable, usual.notes),
                                  GivenOf(verb, kChecklistOptionTable, usual.checklist)}) {
    if (!flag.empty()) return flag;
  }
  if (verb.Given(kUncertaintyDraws)) return kUncertaintyDraws;
  return GivenOf(verb, kUncertaintyOptionTable, usual.uncertainty);
}

Expected<BatchTaskType> MakeFieldTest(const VerbLine& /*verb*/, const BatchRequest& request) {
  TRY(CheckEffects("--effects", request.diagnose.effects));
  TranslateOptions options = request.translate;
  options.diagnosis = request.diagnose;
  if (!request.coefficients_file.empty()) {
    TRY(ReadCoefficients(request.coefficients_file, &options.coefficients));
  }
  if (!request.module_file.empty()) TRY(ReadModule(request.module_file, &options));
  TRY(ValidateTranslateOptions(options));  // also what the files state
  return FieldTestTask(options);
}

// All rows except the constants, whose flag belongs to a fit, and the threads of one cell.
const std::vector<std::string> kCellRows = {"fit", "largest-n", "ideal-n", "hysteresis",
                                            "superposition"};

void DeclareCellFlags(VerbLine* verb, BatchRequest* request) {
  AddNamedFlags(verb, kCellOptionTable, kCellRows, &request->cell);
  AddTableFlags(verb, kPixelOptionTable, &request->pixels);
}

std::string GivenCellFlag(const VerbLine& verb) {
  const std::string flag = GivenOf(verb, kCellOptionTable, CellOptions());
  return flag.empty() ? GivenOf(verb, kPixelOptionTable, PixelOptions()) : flag;
}

Expected<BatchTaskType> MakeCell(const VerbLine& verb, const BatchRequest& request) {
  for (const char* const flag : {"--noise", "--reference", "--plan", "--module"}) {
    if (verb.Given(flag)) return Fail(std::string(flag) + " is not for --task cell");
  }
  return CellTask(request.cell, request.pixels);
}

// All rows except the least light, whose flag belongs to a field test, and the threads of one device.
const std::vector<std::string> kTrendRows = {"reference-days", "false-alarms", "irradiance-drift",
                                             "temperature-drift"};
constexpr char kOperating[] = "--operating";

void DeclareTrendFlags(VerbLine* verb, BatchRequest* request) {
  AddNamedFlags(verb, kTrendOptionTable, kTrendRows, &request->trend);
  verb->AddSwitch(kOperating, &request->operating,
                  "the files are tables of operating points: time, irradiance, temperature, vmp, "
                  "imp; needs --module")
      .Group("Trend");
}

std::string GivenTrendFlag(const VerbLine& verb) {
  if (verb.Given(kOperating)) return kOperating;
  for (const std::string& row : kTrendRows) {
    if (verb.Given("--" + row)) return "--" + row;
  }
  return "";
}

Expected<BatchTaskType> MakeTrend(const VerbLine& verb, const BatchRequest& request) {
  for (const char* const flag : {"--noise", "--reference"}) {
    if (verb.Given(flag)) return Fail(std::string(flag) + " is not for --task trend");
  }
  TrendReadOptions reading;
  reading.reading = request.reading;
  if (!request.module_file.empty()) {
    const TrendSource source =
        request.operating ? TrendSource::kOperatingPoints : TrendSource::kSweeps;
    TRY(const NamedParameters module, ReadModuleParameters(request.module_file));
    TRY(reading.law, SeriesOfModule(module, source, request.conditions.bypass_diodes.value_or(0)));
  } else if (request.operating) {
    return Fail("--operating needs --module: operating points alone do not tell the law");
  }
  reading.prepare = [conditions = Filling(request)](IvCurve* curve) {
    return ApplyConditionFlags(conditions, curve);
  };
  return TrendTask(reading, request.trend);
}

}  // namespace

const std::vector<BatchTask>& BatchTasks() {
  static const std::vector<BatchTask> tasks = {
      {"fit", DeclareFitFlags, GivenFitFlag, MakeFit},
      {"diagnose", DeclareDiagnoseFlags, GivenDiagnoseFlag, MakeDiagnose},
      {"field-test", DeclareFieldTestFlags, GivenFieldTestFlag, MakeFieldTest, "diagnose"},
      {"cell", DeclareCellFlags, GivenCellFlag, MakeCell},
      {"trend", DeclareTrendFlags, GivenTrendFlag, MakeTrend},
  };
  return tasks;
}

std::string BatchTaskNames() {
  std::string names;
  for (const BatchTask& task : BatchTasks()) {
    names += (names.empty() ? "" : ", ") + std::string(task.name);
  }
  return names;
}

void AddSharedTaskFlags(VerbLine* verb, BatchRequest* request) {
  const auto read_noise = [request](const std::string& text) -> Expected<void> {
    const auto* const fit = FindRow(kFitOptionTable, "noise");
    const auto* const diagnose = FindRow(kDiagnoseOptionTable, "noise");
    TRY(std::get<OptionText<FitOptions>>(fit->field)
            .read(text, &request->fit, ProgramTextReaders()));
    return std::get<OptionText<DiagnoseOptions>>(diagnose->field)
        .read(text, &request->diagnose, ProgramTextReaders());
  };
  verb->AddReader("--noise", read_noise,
                  "errors of the readings: white, field, or a JSON file with their sizes (default "
                  "white of a fit, field of a diagnosis)")
      .Type("NAME|FILE")
      .Group("Batch");
}

}  // namespace lyrefit
