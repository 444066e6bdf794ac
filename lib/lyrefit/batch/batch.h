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
#include "lyrefit/batch/batch_source.h"
#include "lyrefit/batch/batch_task.h"
#include "lyrefit/report/document.h"

namespace LYREFIT_PUBLIC lyrefit {

// One thing done with each of many curves.
//
// Writes into a folder
//   results.csv           one row a curve, always, in the order of the input, a column each for what
//                         CommonColumns, the task and NeighbourColumns name
//   results.jsonl         the same as one JSON object a line, null for what is not known
//   pages/ID.html         a page each, where they were asked for (string_pages.h). It stands there
//                         before its row does; one that is removed later is made again by --force;
//                         one that cannot be written is a remark on its row
//   results.schema.json   a Table Schema of both (specs.frictionlessdata.io/table-schema): names,
//                         types, units and a line on each column, and what the run was
// with the same bytes on any number of threads and machines, in however many shards or goes it was
// done. Memory does not grow with the number of curves.
//
// While it runs the rows stand in results.part (checkpoint.h); a killed run loses those curves only
// that were worked on. A shard of several leaves shard-K-of-N.part, which MergeShards makes results
// of; all shards may have one folder.

// Why a kind of rows is broken or not usable, and how many there are.
struct ReasonCount {
  std::int64_t rows = 0;  // how many
  std::string where;      // the first of them
};

// What a run came to.
struct BatchSummary {
  std::string version;  // of lyrefit
  std::string task;     // "fit", "diagnose", "translate"
  std::string folder;   // where the results are
  std::uint64_t seed = 0;
  std::int64_t rows = 0;         // in the results
  std::int64_t rows_before = 0;  // of them written by runs before this one
  double seconds = 0;
  bool interrupted = false;                      // there are no results yet; what follows is empty
  bool was_complete = false;                     // nothing was left to do
  std::map<std::string, std::int64_t> statuses;  // how many rows of each
  std::map<std::string, std::int64_t> zones;     // of a field test
  std::map<std::string, std::int64_t> causes;    // where the task looks for any
  std::map<std::string, std::int64_t> abouts;    // what those belong to: see AboutOf
  // With all numbers in them written as "N"; the rarest beyond kMostReasons as one.
  std::map<std::string, ReasonCount> reasons;
  std::vector<ResultColumn> columns;  // of the results
  std::int64_t compared = 0;          // strings with neighbours
  std::int64_t flagged = 0;           // of those
};

// So many different reasons are counted one by one.
constexpr int kMostReasons = 40;

// Hears every row of the results in their order, as soon as it is written.
using RowObserver = std::function<void(const std::vector<ResultColumn>&, const ResultRow&)>;

// The observer hears of stage "batch", whose `iteration` counts rows and whose `part` bytes.
// Errors: options outside their ranges; a folder that cannot be written; results, or an unfinished
// run, that are there already and not to be replaced or gone on with; what cannot be gone on with,
// as input, options or version differ, or another process writes it; a full disk. What was written
// before stays as it is, and --resume goes on from it.
Expected<BatchSummary> RunBatch(BatchSource* source, const BatchTaskType& task,
                                const BatchOptions& options, const Observer& observer = {},
                                const RowObserver& row_observer = {});

// Where the results of all shards go.
struct MergeOptions {
  std::string folder;    // where the results go
  bool replace = false;  // results that are there already
};

// The results of all shards in these folders. Errors: shards that are missing or not finished, all
// by their numbers; shards of different runs; one that is there twice; what RunBatch says of the
// folder.
Expected<BatchSummary> MergeShards(const std::vector<std::string>& folders,
                                   const MergeOptions& options,
                                   const RowObserver& row_observer = {});

// What there is to say at the end of a run: how many rows are fine, why others are not, causes.
Document BatchDocument(const BatchSummary& summary);
std::string BatchText(const BatchSummary& summary);

// The seed of the curve `id` in a run with this seed: FNV-1a of the id, mixed with the run's.
std::uint64_t SeedOf(std::uint64_t seed, const std::string& id);

}  // namespace lyrefit
