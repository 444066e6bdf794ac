#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <mutex>

#include "batch_request.h"
#include "interrupt.h"
#include "lyrefit/base/try.h"
#include "plant/plan_task.h"
#include "plant/plant_page.h"
#include "verbs.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

constexpr char kCellTask[] = "cell";
constexpr char kNeighboursAlone[] = "neighbours";  // of --plan
constexpr char kTrendTask[] = "trend";

constexpr char kBatchFooter[] =
    "Examples:\n"
    "  lyrefit batch plant_folder --task diagnose --out results\n"
    "  lyrefit batch strings.jsonl --model dd --fix n2=2 --out results --threads 8\n"
    "  lyrefit batch strings.jsonl --out results --resume\n"
    "  lyrefit batch strings.jsonl --out shards --shard 3/40 && lyrefit merge shards --out "
    "results\n"
    "  lyrefit batch substrate1.txt substrate2.txt --task cell --out results\n"
    "  lyrefit batch today_folder --task field-test --module module.json --before "
    "last_year_results "
    "--out results\n"
    "  lyrefit batch folder_of_devices --task trend --out trends --html trends.html\n"
    "  lyrefit batch today_folder --task diagnose --reference last_year_folder --out results\n"
    "  lyrefit batch strings.csv --plan plan.csv --out results --html plant.html\n"
    "\n"
    "Writes results.csv, results.jsonl and results.schema.json into DIR: a row a curve, always, "
    "in\n"
    "the order of the input, with status (fine, doubtful, not usable, broken) and reason. In a "
    "folder\n"
    "tree the paths are the identities: site/inverter/combiner/string. A run that was stopped or "
    "killed\n"
    "goes on with --resume, which begins anew where there is nothing to go on with.\n"
    "\n"
    "Exit codes: 0 every curve has its row; 1 bad input or options, or the rows cannot be written; "
    "2\n"
    "not one curve is fine; 130 stopped by Ctrl-C.";

Expected<void> ReadShard(const std::string& text, Shard* shard) {
  const char* const end = text.data() + text.size();
  const auto k = std::from_chars(text.data(), end, shard->k);
  const bool slash = k.ec == std::errc() && k.ptr != end && *k.ptr == '/';
  const auto of = slash ? std::from_chars(k.ptr + 1, end, shard->of) : k;
  const bool whole = slash && of.ec == std::errc() && of.ptr == end;
  if (whole && shard->k >= 1 && shard->k <= shard->of) return {};
  return Fail("expected K/N with K from 1 to N, such as 3/40, found '" + text + "'");
}

void DeclareBatch(VerbLine* verb, BatchRequest* request) {
  verb->AddOption("INPUT", &request->inputs,
                  "many curves: one a row (JSON Lines, CSV), a long table, a JSON list, a folder "
                  "tree whose paths are the identities; - for standard input")
      .Required()
      .Reads();
  verb->AddOption("--task", &request->task, "what is done with each: " + BatchTaskNames())
      .Type("NAME")
      .OneOf(BatchTaskNames())
      .Group("Batch");
  AddNamedFlags(verb, kBatchOptionTable, {"seed", "threads"}, &request->options);
  AddTableFlags(verb, kPlantOptionTable, &request->comparisons);
  AddTableFlags(verb, kBatchOptionTable, &request->options);
  AddSharedTaskFlags(verb, request);
  verb->AddReader(
          "--shard",
          [request](const std::string& text) { return ReadShard(text, &request->options.shard); },
          "the K-th of N parts of the input, for several machines; merge puts them together")
      .Type("K/N")
      .Group("Batch");
  verb->AddOption("--reference", &request->reference_inputs,
                  "reference sweeps of the same strings, of the shapes of INPUT: each curve is "
                  "compared with those of its own id, or in its folder ID/")
      .Reads()
      .Group("Against its own history");
  verb->AddOption("--before", &request->comparisons.before,
                  "earlier results of the same plant and task field-test, a folder or its "
                  "results.jsonl: each string is compared with its own earlier figures")
      .Type("RESULTS")
      .Reads()
      .Group("Against its own history");
  AddTableFlags(verb, kReferenceOptionTable, &request->reference);
  verb->AddOption("--plan", &request->plan,
                  "names faults that change a string and not the shape of its curve: missing, "
                  "shorted or reversed modules, other types, cables, dirt, sensors, exchanged "
                  "strings. By a plan, CSV or JSON: id, modules_in_series, strings_in_parallel, "
                  "module (a data sheet); or by the combiner alone: neighbours")
      .Type("FILE|neighbours")
      .Group("Against the plan");
  AddTableFlags(verb, kReadOptionTable, &request->reading.reading);
  AddTableFlags(verb, kConditionOptionTable, &request->conditions);
  verb->AddSwitch("--override", &request->override,
                  "the conditions given here replace what the files state; else they fill in what "
                  "no file states")
      .Group("Conditions");
  for (const BatchTask& task : BatchTasks()) task.declare(verb, request);
  verb->AddOption("--html", &request->html_file, "the plant on one page, HTML").Writes();
  verb->AddOption("--plant", &request->plant, "its name on that page; else that of the input")
      .Type("NAME");
  verb->AddOption("--out", &request->options.folder, "where the results go").WritesFolder();
  verb->AddSwitch("--resume", &request->resume, "go on with a run that was stopped or killed")
      .Group("Output");
  verb->AddQuietSwitch();
}

const BatchTask* FindTask(const std::string& name) {
  for (const BatchTask& task : BatchTasks()) {
    if (task.name == name) return &task;
  }
  return nullptr;
}

// Results in an input folder would be read as curves, now or in the next run.
Expected<void> CheckOutside(const BatchRequest& request) {
  std::error_code error;
  const fs::path out = fs::weakly_canonical(request.options.folder, error);
  for (const auto* inputs : {&request.inputs, &request.reference_inputs}) {
    for (const std::string& input : *inputs) {
      if (!fs::is_directory(input, error)) continue;
      const fs::path folder = fs::canonical(input, error);
      const auto ends = std::mismatch(folder.begin(), folder.end(), out.begin(), out.end());
      if (ends.first != folder.end()) continue;
      return Fail("--out lies inside of " + input +
                      ", where every table is read as a curve: name a folder elsewhere",
                  request.options.folder);
    }
  }
  return {};
}

Expected<void> CheckRequest(const VerbLine& verb, const BatchRequest& request) {
  if (request.options.folder.empty()) return Fail("--out is required: a folder for the results");
  if (FindTask(request.task) == nullptr) {
    return Fail("--task: expected one of " + BatchTaskNames() + ", found '" + request.task + "'");
  }
  const BatchTask& own = *FindTask(request.task);
  for (const BatchTask& task : BatchTasks()) {
    if (task.name == request.task || std::string(task.name) == own.takes) continue;
    const std::string flag = task.given(verb);
    if (!flag.empty()) return Fail(flag + " is for --task " + task.name);
  }
  if (!request.html_file.empty() && request.options.shard.of > 1) {
    return Fail("--html is for a whole run: give it to merge");
  }
  if (request.resume && verb.Forced()) return Fail("only one of --resume and --force");
  TRY(CheckOutside(request));
  return verb.CheckFiles();
}

// Reads the plan and how the modules of the sheet are built.
Expected<void> ReadLayouts(BatchRequest* request) {
  if (!request->plan.empty() && request->plan != kNeighboursAlone) {
    TRY(request->read_plan, ReadPlantPlan(request->plan));
  }
  if (request->module_file.empty() || request->task == kTrendTask) return {};
  TRY(request->layout, ReadDeviceLayout(request->module_file));
  const int modules = request->translate.field_test.modules;
  if (modules > 0) request->layout.modules_in_series = modules;
  return {};
}

// How many strings a plan names; the rows come from several threads.
struct PlanCount {
  std::mutex lock;
  std::int64_t strings = 0;
  std::int64_t named = 0;
  std::string not_named;  // the first by its id that the plan does not name
};

const PlannedString* FindInPlan(const BatchRequest& request, const std::string& id,
                                PlanCount* count) {
  if (!request.read_plan) return nullptr;
  const PlannedString* const line = request.read_plan->Find(id);
  const std::lock_guard<std::mutex> guard(count->lock);
  ++count->strings;
  if (line != nullptr) {
    ++count->named;
  } else if (count->not_named.empty() || id < count->not_named) {
    count->not_named = id;
  }
  return line;
}

// Says which strings a plan does not name. Error: it names none.
Expected<void> CheckPlan(const BatchRequest& request, const PlanCount& count) {
  if (!request.read_plan || count.named == count.strings) return {};
  if (count.named == 0) {
    return Fail(fmt::format("no id fits a string: the first string is '{}', the first id of the "
                            "plan '{}'",
                            count.not_named, request.read_plan->lines().front().id),
                request.plan);
  }
  PrintRemarks({fmt::format("{} names {} of {} strings; '{}' is the first that it does not name",
                            request.plan, count.named, count.strings, count.not_named)});
  return {};
}

// Adds what flags, plan and sheet say to the curve of an id.
Expected<void> Prepare(const BatchRequest& request, const std::string& id, PlanCount* count,
                       IvCurve* curve) {
  ConditionOptions conditions = Filling(request);
  const bool dark = curve->irradiance_known && curve->conditions.irradiance_W_m2 <= 0;
  // The light of a cell is that of its lit sweeps.
  if (request.task == kCellTask && dark) conditions.irradiance_W_m2.reset();
  TRY(ApplyConditionFlags(conditions, curve));
  const PlannedString* const line = FindInPlan(request, id, count);
  FillLayout(line == nullptr ? request.layout : LayoutOf(*line, request.layout), curve);
  return {};
}

BatchOptions Settled(const VerbLine& verb, const BatchRequest& request, PlanCount* count) {
  BatchOptions options = request.options;
  options.additions = PlantAdditions(request.comparisons);
  if (request.resume) options.start = BatchStart::kResume;
  if (verb.Forced()) options.start = BatchStart::kReplace;
  options.prepare = [request, count](const std::string& id, IvCurve* curve) {
    return Prepare(request, id, count, curve);
  };
  options.reading = NonDefaults(request.reading.reading, kReadOptionTable);
  AppendNonDefaults(request.conditions, kConditionOptionTable, &options.reading);
  if (request.override) options.reading.push_back({"override", "true", ""});
  const DeviceLayout& layout = request.layout;
  if (!layout.source.empty()) {
    options.reading.push_back(
        {"module",
         fmt::format("{}, {}, {}", layout.module_cells.value_or(0),
                     layout.module_diodes.value_or(0), layout.modules_in_series.value_or(0)),
         ""});
  }
  return options;
}

// The task with the comparison with the plan, if one is given.
BatchTaskType WithPlanOf(const BatchRequest& request, BatchTaskType task) {
  return request.plan.empty() ? task : WithPlan(std::move(task), request.read_plan);
}

Expected<BatchTaskType> MakeTask(const VerbLine& verb, const BatchRequest& request) {
  TRY(BatchTaskType alone, FindTask(request.task)->make(verb, request));
  BatchTaskType task = WithPlanOf(request, std::move(alone));
  if (request.reference_inputs.empty()) return task;
  BatchReadOptions reading = request.reading;
  reading.shard = {};
  reading.reading.keep_limited = request.task == "diagnose";
  TRY(const auto source, OpenBatch(request.reference_inputs, reading));
  ConditionOptions module = Filling(request);  // without the conditions of today's sweep
  module.irradiance_W_m2.reset();
  module.temperature_C.reset();
  TRY(auto sweeps, ReadReferences(source.get(), [module](IvCurve* curve) {
        return ApplyConditionFlags(module, curve);
      }));
  return WithHistory(std::move(task), std::move(sweeps), request.reference);
}

// The name of --plant, else that of the input.
std::string PlantName(const BatchRequest& request) {
  if (!request.plant.empty()) return request.plant;
  fs::path input = request.inputs.front();
  if (input.filename().empty()) input = input.parent_path();
  const std::string name = input.stem().string();
  return name.empty() || name == "-" ? "Plant" : name;
}

int ExitCode(const BatchSummary& summary) {
  if (summary.interrupted) return kExitInterrupted;
  const auto fine = summary.statuses.find(ToText(RowStatus::kFine));
  const bool none = summary.rows > 0 && !summary.was_complete && fine == summary.statuses.end();
  return none ? kExitNotUsable : kExitFine;
}

Expected<int> RunBatchVerb(VerbLine& verb, BatchRequest& request) {
  TRY(CheckRequest(verb, request));
  TRY(ReadLayouts(&request));
  PlanCount count;
  const BatchOptions options = Settled(verb, request, &count);
  BatchReadOptions reading = request.reading;
  reading.shard = options.shard;
  reading.reading.keep_limited = request.task == "diagnose";
  reading.reading.whole_cells = request.task == kCellTask;
  reading.reading.whole_files = request.task == kTrendTask;
  const InterruptGuard guard;
  TRY(const BatchTaskType task, MakeTask(verb, request));
  TRY(const auto source, OpenBatch(request.inputs, reading));
  TRY(const BatchSummary summary,
      RunBatch(source.get(), task, options,
               TerminalObserver({"batch", "Ctrl-C keeps the rows that are done for --resume"})));
  PrintRemarks(source->Remarks());
  TRY(CheckPlan(request, count));
  if (!request.html_file.empty() && !summary.interrupted) {
    TRY(WritePlantPage(options.folder, request.html_file, PlantName(request)));
  }
  TRY(WriteText(verb, [&] { return BatchText(summary); }));
  return ExitCode(summary);
}

}  // namespace

const Verb kBatchVerb = {"batch", "Fit or diagnose many curves, a row of results each",
                         kBatchFooter,
                         "results.csv, results.jsonl and results.schema.json into the folder --out",
                         Declare<BatchRequest, DeclareBatch, RunBatchVerb>};

}  // namespace lyrefit
