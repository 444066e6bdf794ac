#include "lyrefit/batch/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "lyrefit/base/append.h"
#include "lyrefit/base/file.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/batch/addition.h"
#include "lyrefit/batch/checkpoint.h"
#include "lyrefit/batch/column.h"
#include "lyrefit/batch/count_rows.h"
#include "lyrefit/batch/pipeline.h"
#include "lyrefit/batch/row_text.h"
#include "lyrefit/batch/write_results.h"
#include "lyrefit/curve/plausibility.h"

namespace lyrefit {
namespace {

BatchJson OptionsJson(const BatchTaskType& task, const BatchOptions& options) {
  BatchJson json = {{"seed", options.seed}};
  for (const auto& addition : options.additions) addition->AddOptions(&json);
  if (options.pages != PagesOf::kNone) json["pages"] = ToText(options.pages);
  if (options.interactive_pages) json["interactive-pages"] = true;
  if (options.raw_csv) json["raw-csv"] = true;
  // An option that is given several times is echoed with all its values.
  for (const auto* echoes : {&options.reading, &task.options}) {
    for (const OptionEcho& echo : *echoes) {
      BatchJson& value = json[echo.name];
      value = value.is_string() ? value.get<std::string>() + " " + echo.value : echo.value;
    }
  }
  return json;
}

std::vector<ResultColumn> RowColumns(const BatchTaskType& task, const BatchOptions& options) {
  std::vector<ResultColumn> columns = CommonColumns();
  columns.insert(columns.end(), task.columns.begin(), task.columns.end());
  if (options.pages != PagesOf::kNone) {
    columns.push_back({"page", "", CellType::kText,
                       "the curve's own page: a path from the folder of the results"});
  }
  return columns;
}

Expected<CheckpointHead> HeadOf(const BatchSource& source, const BatchTaskType& task,
                                const BatchOptions& options) {
  TRY(const std::string digest, source.Digest());
  if (digest.empty() && (options.start == BatchStart::kResume || options.shard.of > 1)) {
    return Fail("standard input and pipes can neither be resumed nor done in shards: name a file");
  }
  CheckpointHead head = NewCheckpointHead();
  head["version"] = Version();
  head["task"] = task.name;
  head["shard"] = options.shard.k;
  head["of"] = options.shard.of;
  head["input"] = digest;
  head["options"] = OptionsJson(task, options);
  head["columns"] = FieldsJson(RowColumns(task, options));
  return head;
}

// Reason why a curve is broken. The file is left out, since another column has it.
std::string ReasonOf(const Error& error) {
  if (error.line == 0) return error.message;
  if (error.column == 0) return fmt::format("line {}: {}", error.line, error.message);
  return fmt::format("line {}, column {}: {}", error.line, error.column, error.message);
}

// The result of a curve, which is doubtful where its readings are.
TaskResult WithDoubt(TaskResult result, const BatchCurve& curve) {
  const std::optional<std::string> doubt =
      PlausibilityProblem(*curve.curve, RatedPowerBeside(curve));
  if (!doubt) return result;
  if (result.status == RowStatus::kFine) result.status = RowStatus::kDoubtful;
  if (result.reason.find(*doubt) != std::string::npos) return result;
  result.reason += (result.reason.empty() ? "" : "; ") + *doubt;
  return result;
}

bool Holds(const std::vector<std::string>& sentences, const std::string& sentence) {
  return std::find(sentences.begin(), sentences.end(), sentence) != sentences.end();
}

// Creates the row of a curve. Thread-safe.
class RowMaker {
 public:
  RowMaker(const BatchSource& source, const BatchTaskType& task, const BatchOptions& options)
      : source_(source),
        task_(task),
        options_(options),
        columns_(RowColumns(task, options)),
        remark_(ColumnPlace(columns_, "remark")) {}

  PipelineStep Make(const BatchItem& item, const StopToken& stop) const {
    BatchCurve curve = source_.Read(item);
    const bool is_curve = curve.curve && curve.file.empty();
    std::vector<std::string> remarks;
    if (is_curve) remarks = Settle(&curve);
    TaskResult result{RowStatus::kBroken, "", {}, false};
    if (curve.curve) {
      result = task_.run(curve, SeedOf(options_.seed, curve.id), stop.AsObserver());
      if (is_curve) result = WithDoubt(std::move(result), curve);
    } else {
      result.reason = ReasonOf(curve.curve.error());
    }
    ResultRow row = {CommonCells(curve, item, result)};
    result.cells.resize(task_.columns.size());
    Append(std::move(result.cells), &row.cells);
    PipelineStep step;
    step.broken = result.status == RowStatus::kBroken;
    step.interrupted = result.interrupted;
    if (options_.pages != PagesOf::kNone) {
      const Expected<ResultCell> page = PageOf(curve.id, result);
      row.cells.push_back(page.value_or(ResultCell()));
      if (!page) remarks.push_back("no page: " + page.error().message);
    }
    for (const std::string& remark : remarks) {
      const auto* const before = std::get_if<std::string>(&row.cells[remark_]);
      row.cells[remark_] = (before == nullptr ? "" : *before + "; ") + remark;
    }
    step.text = RowJson(columns_, row) + "\n";
    return step;
  }

 private:
  // Writes the curve's page before its row, whose last cell is the path. A page that cannot be
  // written is a remark on the row.
  Expected<ResultCell> PageOf(const std::string& id, const TaskResult& result) const {
    const bool wanted = options_.pages != PagesOf::kFailed || result.failed;
    if (result.interrupted || !result.page || !wanted) return ResultCell();
    const std::string path = StringPagePath(id);
    TRY(WriteStringPage(options_.folder, path, result.page({options_.interactive_pages})));
    return path;
  }

  // Adds the known conditions and validates the readings. Returns what has to be said of that.
  std::vector<std::string> Settle(BatchCurve* curve) const {
    Expected<void> settled;
    std::vector<std::string> remarks;
    const auto settle = [&](IvCurve* one) {
      const std::vector<std::string> before = SentencesOf(one->assumptions);
      if (settled && options_.prepare) settled = options_.prepare(curve->id, one);
      for (const std::string& sentence : SentencesOf(one->assumptions)) {
        if (!Holds(before, sentence) && !Holds(remarks, sentence)) remarks.push_back(sentence);
      }
      if (settled) settled = Validate(*one);
    };
    settle(&*curve->curve);
    for (IvCurve& one : curve->more) settle(&one);
    if (!settled) curve->curve = tl::unexpected(settled.error());
    return remarks;
  }

  const BatchSource& source_;
  const BatchTaskType& task_;
  const BatchOptions& options_;
  const std::vector<ResultColumn> columns_;
  const std::size_t remark_;  // position of the column `remark`
};

Expected<PipelineEnd> WriteRows(BatchSource* source, const BatchTaskType& task,
                                const BatchOptions& options, const Observer& observer,
                                CheckpointFile* part) {
  const Instant begin = Now();
  const RowMaker maker(*source, task, options);
  const std::int64_t before = part->rows();
  Pipeline pipeline;
  pipeline.threads = options.threads;
  pipeline.skip = before;
  pipeline.work = [&maker](const BatchItem& item, const StopToken& stop) {
    return maker.Make(item, stop);
  };
  pipeline.write = [part](const std::string& texts, std::int64_t rows) {
    return part->Append(texts, rows);
  };
  pipeline.stop = [&](const PipelineProgress& done) {
    Progress progress;
    progress.stage = "batch";
    progress.iteration = before + done.rows;
    progress.seconds = SecondsSince(begin);
    if (source->size() > 0) {
      progress.part = static_cast<double>(done.end) / static_cast<double>(source->size());
    }
    const std::string note =
        fmt::format("{:.0f} a second, {} broken",
                    static_cast<double>(done.rows) / std::max(progress.seconds, 1e-3), done.broken);
    progress.note = note;
    return StopRequested(observer, progress);
  };
  return Run(pipeline, source);
}

std::optional<std::pair<int, std::int64_t>> Pair(const std::optional<PipelinePlace>& place) {
  if (!place) return std::nullopt;
  return std::make_pair(place->input, place->number);
}

// Begins the additions with all options of the run. Returns the files that they keep beside the
// checkpoint.
Expected<std::vector<ResultFile>> BeginAdditions(const BatchTaskType& task,
                                                 const BatchOptions& options,
                                                 CheckpointHead* head) {
  std::vector<ResultFile> kept;
  for (const auto& addition : options.additions) {
    TRY(auto files, addition->Begin(task, options.folder, &head->at("options")));
    Append(std::move(files), &kept);
  }
  return kept;
}

// True if the folder already has the results of this run, so that nothing is left to do.
Expected<bool> AreThere(const CheckpointHead& head, const BatchOptions& options) {
  if (options.start != BatchStart::kResume || options.shard.of > 1) return false;
  if (std::filesystem::exists(CheckpointPath(options.folder, options.shard))) return false;
  const CheckpointHead there = ResultsHead(options.folder);
  if (there.is_null()) return false;
  if (there == ResultsHeadOf(head)) return true;
  return Fail(
      "the results that are there are of another run: name another folder, or say --force "
      "to replace them",
      options.folder);
}

Expected<void> CheckBatch(const BatchTaskType& task, const BatchOptions& options) {
  TRY(ValidateOptions(options, kBatchOptionTable));
  TRY(ValidateThreads(options.threads));
  if (options.folder.empty()) return Fail("no folder for the results");
  const Shard& shard = options.shard;
  if (shard.k < 1 || shard.k > shard.of) {
    return Fail(fmt::format("expected a shard from 1 to {}, found {}", shard.of, shard.k));
  }
  return task.run ? Expected<void>() : Fail("the task '" + task.name + "' does nothing");
}

}  // namespace

std::uint64_t SeedOf(std::uint64_t seed, const std::string& id) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : id) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  // SplitMix64, as in base/random.cc.
  std::uint64_t z = hash + 0x9e3779b97f4a7c15ULL * (seed + 1);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

Expected<BatchSummary> RunBatch(BatchSource* source, const BatchTaskType& asked,
                                const BatchOptions& options, const Observer& observer,
                                const RowObserver& row_observer) {
  const Instant begin = Now();
  TRY(CheckBatch(asked, options));
  BatchTaskType task = asked;
  for (const auto& addition : options.additions) addition->AddToTask(&task);
  BatchSummary summary;
  summary.version = Version();
  summary.task = task.name;
  summary.folder = options.folder;
  summary.seed = options.seed;
  const bool shard = options.shard.of > 1;
  TRY(PrepareFolder(options.folder, shard || options.start != BatchStart::kNew, options.additions));
  TRY(CheckpointHead head, HeadOf(*source, task, options));
  TRY(const std::vector<ResultFile> kept, BeginAdditions(task, options, &head));
  TRY(summary.was_complete, AreThere(head, options));
  if (summary.was_complete) return summary;
  const PartStart start = options.start == BatchStart::kNew      ? PartStart::kNew
                          : options.start == BatchStart::kResume ? PartStart::kResume
                                                                 : PartStart::kReplace;
  const std::string path = CheckpointPath(options.folder, options.shard);
  TRY(const auto part, CheckpointFile::Open(path, head, start));
  const std::filesystem::path folder(options.folder);
  for (const ResultFile& file : kept) TRY(WriteTextFile((folder / file.name).string(), file.text));
  summary.rows_before = part->rows();
  summary.was_complete = shard && part->complete();
  if (!part->complete()) {
    const auto end = WriteRows(source, task, options, observer, part.get());
    if (!end) {
      if (part->rows() == 0) TRY(part->Remove());
      return tl::unexpected(end.error());
    }
    summary.interrupted = !end->complete;
    if (end->complete) TRY(part->Finish({part->rows(), Pair(end->first), Pair(end->last)}));
  }
  summary.rows = part->rows();
  summary.seconds = SecondsSince(begin);
  if (summary.interrupted) return summary;
  if (shard) {
    TRY(static_cast<BatchCounts&>(summary), CountRows(path));
  } else {
    TRY(auto results,
        WriteResults({path}, options.folder, options.additions, observer, row_observer));
    summary.interrupted = !results;
    if (summary.interrupted) return summary;
    static_cast<BatchResults&>(summary) = std::move(*results);
    TRY(part->Remove());
    std::error_code error;
    for (const ResultFile& file : kept) std::filesystem::remove(folder / file.name, error);
  }
  summary.seconds = SecondsSince(begin);
  return summary;
}

}  // namespace lyrefit
