#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "lyrefit/base/append_log.h"
#include "lyrefit/base/error.h"
#include "lyrefit/stream/batch_source.h"

namespace lyrefit {

// The file to which a run over many curves writes row by row, so that it can be resumed. It has
// lines of JSON: a head with all inputs of a row (version, task, options, shard, digest of the
// input), the rows in the order of the input, and {"end": number of rows} when complete. Every line
// has a checksum (LineSums).

// JSON with its keys in order, of every record of a batch.
using BatchJson = nlohmann::ordered_json;
using CheckpointHead = BatchJson;

// A head that holds only the format of checkpoint files.
CheckpointHead NewCheckpointHead();

// DIR/results.part; for a shard of several DIR/shard-3-of-8.part.
std::string CheckpointPath(const std::string& folder, const Shard& shard);

// Checks that a run has the head `before` of the file at `path`. Error: the first difference, as a
// sentence.
Expected<void> CheckSameHead(const CheckpointHead& before, const CheckpointHead& now,
                             const std::string& path);

// Positions of the first and the last row of a checkpoint in the whole input: index of the input,
// and index of the curve in it. Empty without rows.
struct PartEnd {
  std::int64_t rows = 0;
  std::optional<std::pair<int, std::int64_t>> first;
  std::optional<std::pair<int, std::int64_t>> last;
};

// Digest of a text among the options of a run: CRC-32 and size.
std::string TextDigest(const std::string& text);

// The last line of a complete checkpoint file; empty if the run is unfinished.
Expected<std::optional<PartEnd>> ReadCheckpointEnd(const std::string& path);

enum class PartStart {
  kNew,      // the file must not exist
  kResume,   // continues an existing file of the same run
  kReplace,  // starts again
};

class CheckpointFile {
 public:
  // Opens or creates a file. A last line without a line end is incomplete and is cut off. Errors,
  // without any change to the file: it cannot be opened, or another process writes it; it exists
  // without kResume; it is of another run, is no checkpoint file or was changed.
  static Expected<std::unique_ptr<CheckpointFile>> Open(const std::string& path,
                                                        const CheckpointHead& head,
                                                        PartStart start);

  std::int64_t rows() const { return rows_; }  // number of rows in the file
  bool complete() const { return complete_; }
  const std::string& path() const { return log_->path(); }

  // Appends `rows` complete lines, each with its line end; see AppendLog.
  Expected<void> Append(const std::string& lines, std::int64_t rows);
  // Writes the final line with the positions of the rows, and waits until all rows are on the disk.
  Expected<void> Finish(const PartEnd& end);
  Expected<void> Remove();

 private:
  explicit CheckpointFile(std::unique_ptr<AppendLog> log) : log_(std::move(log)) {}
  Expected<void> Take(const std::string& line, int number, const CheckpointHead& head);

  const std::unique_ptr<AppendLog> log_;
  std::int64_t rows_ = 0;
  bool complete_ = false;
};

// Reads the rows of a checkpoint file in order.
class CheckpointReader {
 public:
  static Expected<CheckpointReader> Open(const std::string& path);

  const CheckpointHead& head() const { return head_; }
  const std::string& path() const { return log_.path(); }
  // The next row; empty after the last. Errors: a line that is no row or was changed; a missing
  // end, or one with another number of rows.
  Expected<std::optional<nlohmann::json>> Next();

 private:
  explicit CheckpointReader(LogReader log) : log_(std::move(log)) {}

  LogReader log_;
  CheckpointHead head_;
  std::int64_t rows_ = 0;
  bool over_ = false;
};

}  // namespace lyrefit
