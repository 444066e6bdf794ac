#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/stream/batch_source.h"

namespace lyrefit {

// One reader, many workers, one writer. Curves are read in the order of the input and processed in
// parallel. Results are written in the order of the input. At most a few dozen curves for each
// worker are queued, whatever the number of curves and the time of one.

struct PipelineStep {
  std::string text;          // text to be written for the curve
  bool broken = false;       // for progress
  bool interrupted = false;  // to be discarded, with all later ones
};

struct PipelineProgress {
  std::int64_t rows = 0;    // written by this call
  std::int64_t broken = 0;  // of `rows`: broken
  std::int64_t end = 0;     // BatchItem::end of the last row
};

struct Pipeline {
  int threads = 0;        // number of workers; 0: all cores
  std::int64_t skip = 0;  // number of curves at the beginning that are not processed
  // Processes one curve. Must be thread-safe. `stop` requests that the work be abandoned.
  std::function<PipelineStep(const BatchItem& item, const StopToken& stop)> work;
  // Writes the concatenated texts of `rows` curves. Called from the calling thread.
  std::function<Expected<void>(const std::string& texts, std::int64_t rows)> write;
  // Called from the calling thread after each write and ten times a second. True: stop.
  std::function<bool(const PipelineProgress&)> stop;
};

// Position of a curve in the whole input.
struct PipelinePlace {
  int input = 0;
  std::int64_t number = 0;
};

struct PipelineEnd {
  bool complete = false;               // false: stopped, and only the first rows are written
  std::optional<PipelinePlace> first;  // first of all curves read, including those skipped
  std::optional<PipelinePlace> last;
};

// Reads to the end of the input, unless it is stopped. An error of the source or of `write` stops
// it too. Curves read before the error are still written.
Expected<PipelineEnd> Run(const Pipeline& pipeline, BatchSource* source);

}  // namespace lyrefit
