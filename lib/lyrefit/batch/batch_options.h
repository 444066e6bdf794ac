// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/public.h"
#include "lyrefit/batch/string_pages.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/stream/batch_source.h"

namespace LYREFIT_PUBLIC lyrefit {

// Behaviour if an unfinished run or results exist.
enum class BatchStart {
  kNew,      // return an error
  kResume,   // continue a run of the same input, options and version; a complete run is no error
  kReplace,  // start again
};

// Adds columns, files and sections to the results of a run (the closed header batch/addition.h), such
// as comparisons of the rows with each other.
class BatchAddition;
using BatchAdditions = std::vector<std::shared_ptr<BatchAddition>>;

// How many curves are processed at once, and where the rows are written.
struct BatchOptions {
  std::string folder;  // folder of the results; created if missing
  Shard shard;         // must be the shard that the source was opened with
  BatchStart start = BatchStart::kNew;
  std::uint64_t seed = 0;  // of the run; each curve's seed is computed from it and the id
  int threads = 0;         // 0: all cores; no effect on results
  // Pages of single curves in the folder of the results: see string_pages.h.
  PagesOf pages = PagesOf::kNone;
  bool interactive_pages = false;
  // Write texts of results.csv unchanged, including those that a spreadsheet would run as formulas.
  bool raw_csv = false;
  // Adds known conditions to the curve of an id after it is read. Assumptions that it adds are
  // remarks on the row. Empty: none.
  std::function<Expected<void>(const std::string& id, IvCurve* curve)> prepare;
  // Options of reading and preparation, for the digest of the run.
  std::vector<OptionEcho> reading;
  // What is added to the results; its cells follow those of the task in this order. Empty: plain
  // rows.
  BatchAdditions additions;
};

inline constexpr OptionRow<BatchOptions> kBatchOptionTable[] = {
    OptionRow<BatchOptions>("Batch"),
    {"seed", "", "seed of the run; each curve's comes from it and the curve's id",
     &BatchOptions::seed, 0, 1.8446744073709552e19},
    {"threads", "N", "0: all cores; never changes a result", &BatchOptions::threads, 0,
     kMostThreads, OptionTrait::kQuiet | OptionTrait::kNoEcho},
    {"pages", "WHICH",
     "a page each, DIR/pages/ID.html, for those that failed or show a cause, or all",
     EnumOption<&BatchOptions::pages>()},
    {"interactive-pages", "", "with charts to hover over, half a megabyte more each",
     &BatchOptions::interactive_pages},
    {"raw-csv", "",
     "texts in results.csv as they are; else an apostrophe stands before those that a spreadsheet "
     "would run as formulas",
     &BatchOptions::raw_csv},
};

}  // namespace lyrefit
