// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/batch/batch_options.h"
#include "lyrefit/batch/batch_task.h"
#include "lyrefit/report/document.h"
#include "lyrefit/stream/batch_source.h"

namespace LYREFIT_PUBLIC lyrefit {

// Runs one task on each of many curves.
//
// The results are written into one folder:
//   results.csv           one row for each curve, always, in the order of the input; the columns
//                         are those of every row, of the task and of BatchOptions::additions
//   results.jsonl         one JSON object a line with the cells of results.csv; null: unknown
//   pages/ID.html         one page for each curve, if requested (string_pages.h). It is written
//                         before its row. --force writes a removed page again. A page that cannot
//                         be written is a remark on its row
//   results.schema.json   a Table Schema of both (specs.frictionlessdata.io/table-schema): names,
//                         types, units and a description of each column, and the run's settings
// The files have the same bytes on any number of threads, machines, shards and resumed runs. Memory
// does not grow with the number of curves, but by what additions keep.
//
// During the run the rows are in results.part (checkpoint.h). A killed run loses only the curves in
// progress. A shard of several writes shard-K-of-N.part, and MergeShards combines the shards into
// results. All shards may use one folder.

// Number of rows that are broken or not usable for one reason.
struct ReasonCount {
  std::int64_t rows = 0;  // number of rows
  std::string where;      // location of the first of these rows
  std::string first;      // its reason; empty: of many reasons
};

// Rows in numbers.
struct BatchCounts {
  std::int64_t rows = 0;                         // number of rows in the results
  std::map<std::string, std::int64_t> statuses;  // number of rows for each status
  std::map<std::string, std::int64_t> zones;     // number of rows for each zone of a field test
  // Number of rows for each cause, if the task reports causes.
  std::map<std::string, std::int64_t> causes;
  // Number of rows for each subject of a cause; see Effect::where.
  std::map<std::string, std::int64_t> abouts;
  // Reasons with all numbers replaced by "N". Reasons beyond kMostReasons are counted together.
  std::map<std::string, ReasonCount> reasons;
};

// What additions say in the report at the end of a run.
struct AddedReport {
  std::vector<block::Field> fields;  // of the head
  std::vector<Section> sections;     // before the counts of rows
  std::vector<Section> causes;       // beside the causes
};

// What the results of a whole run say of it.
struct BatchResults : BatchCounts {
  std::vector<ResultColumn> columns;  // columns of the results
  AddedReport added;                  // by the additions of the run
};

// Summary of a run. A shard has counts alone.
struct BatchSummary : BatchResults {
  std::string version;  // of lyrefit
  std::string task;     // "fit", "diagnose", "field-test", "cell"
  std::string folder;   // folder of the results
  std::uint64_t seed = 0;
  std::int64_t rows_before = 0;  // of `rows`: written by earlier runs
  double seconds = 0;
  bool interrupted = false;   // there are no results yet, and nothing of BatchResults but `rows`
  bool was_complete = false;  // the results were complete before the run
};

// Number of different reasons that are counted separately.
constexpr int kMostReasons = 40;

// Receives every row of the results in their order, directly after it is written.
using RowObserver = std::function<void(const std::vector<ResultColumn>&, const ResultRow&)>;

// Runs the task `asked` on every curve of `source`. The observer receives stage "batch", whose `iteration`
// counts rows and whose `part` counts bytes. Errors: options outside their ranges; a folder that is
// not writable; existing results or an unfinished run without permission to replace or resume them;
// a run that cannot be resumed, since input, options or version differ or another process writes
// it; a full disk. After an error the rows written before are kept, and --resume continues from
// them.
Expected<BatchSummary> RunBatch(BatchSource* source, const BatchTaskType& asked,
                                const BatchOptions& options, const Observer& observer = {},
                                const RowObserver& row_observer = {});

// Options of MergeShards.
struct MergeOptions {
  std::string folder;             // folder of the results
  bool replace = false;           // overwrite existing results
  BatchAdditions additions = {};  // those of the runs of the shards
};

// Merges the shards in `folders` into results. Errors: missing or unfinished shards, listed by
// number; shards of different runs; a duplicate shard; the folder errors of RunBatch.
Expected<BatchSummary> MergeShards(const std::vector<std::string>& folders,
                                   const MergeOptions& options,
                                   const RowObserver& row_observer = {});

// The report at the end of a run: number of fine rows, reasons of the others, causes.
Document BatchDocument(const BatchSummary& summary);
std::string BatchText(const BatchSummary& summary);

// Seed of the curve `id` in a run with seed `seed`: FNV-1a of the id, mixed with the run's seed.
std::uint64_t SeedOf(std::uint64_t seed, const std::string& id);

}  // namespace lyrefit
