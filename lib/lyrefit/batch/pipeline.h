#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/batch/batch_source.h"

namespace lyrefit {

// One reader, many workers, one writer: curves are read in the order of the input, worked on side
// by side, and what came of them is written in that order. Between the three wait at most a few
// dozen curves a worker, however many there are and however long one takes.

struct PipelineStep {
  std::string text;          // what is to be written of a curve
  bool broken = false;       // for progress
  bool interrupted = false;  // to be thrown away, with all that come after it
};

struct PipelineProgress {
  std::int64_t rows = 0;    // written by this call
  std::int64_t broken = 0;  // of those
  std::int64_t end = 0;     // BatchItem::end of the last one
};

struct Pipeline {
  int threads = 0;        // that work; 0: all cores
  std::int64_t skip = 0;  // curves at the beginning that are left out, unread
  // From any thread. `stopped` says whether to give up.
  std::function<PipelineStep(const BatchItem& item, const std::function<bool()>& stopped)> work;
  // From the calling thread: the texts of `rows` curves, one behind the other.
  std::function<Expected<void>(const std::string& texts, std::int64_t rows)> write;
  // The same, after each write and ten times a second; true: stop.
  std::function<bool(const PipelineProgress&)> stop;
};

// Where a curve stands in the whole input.
struct PipelinePlace {
  int input = 0;
  std::int64_t number = 0;
};

struct PipelineEnd {
  bool complete = false;               // false: it was stopped, and a first part is written
  std::optional<PipelinePlace> first;  // of the curves that were read, those skipped included
  std::optional<PipelinePlace> last;
};

// Reads to the end of the input, unless it is stopped. An error of the source or of `write` ends it
// too, after what was read before is written.
Expected<PipelineEnd> Run(const Pipeline& pipeline, BatchSource* source);

}  // namespace lyrefit
