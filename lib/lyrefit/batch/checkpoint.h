#pragma once

#include <cstdint>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "lyrefit/base/append_log.h"
#include "lyrefit/base/error.h"
#include "lyrefit/batch/batch_source.h"

namespace lyrefit {

// The file that a run over many curves writes row by row, so that it can be taken up again. Lines
// of JSON: a head with all that a row depends on (version, task, options, shard, digest of the
// input), the rows in the order of the input, and once all are there {"end": how many}. The last
// member of every line, "crc", is the CRC-32 of it and all lines before it: a line that was changed,
// moved, or lost is found by whoever reads the file.

using CheckpointHead = nlohmann::ordered_json;

// A head that holds the format of part files alone.
CheckpointHead NewCheckpointHead();

// DIR/results.part; of a shard of several DIR/shard-3-of-8.part.
std::string CheckpointPath(const std::string& folder, const Shard& shard);

// The first thing in which a run differs from the one that wrote `before`, as a sentence.
Expected<void> CheckSameHead(const CheckpointHead& before, const CheckpointHead& now, const std::string& path);

// Where in the whole input the first and the last row of a part stand: which file, and which curve
// of that; nothing where there are no rows.
struct PartEnd {
  std::int64_t rows = 0;
  std::optional<std::pair<int, std::int64_t>> first;
  std::optional<std::pair<int, std::int64_t>> last;
};

// What the last line of a part file says; nothing where the run has not finished.
Expected<std::optional<PartEnd>> ReadCheckpointEnd(const std::string& path);

// The checksums of the lines of a part file, one after the other.
class LineSums {
 public:
  // A line, without its end, with its checksum as the last member.
  std::string Seal(std::string_view line);
  // The line without its checksum. Errors, a sentence: it has none, or another one than it should.
  Expected<std::string> Check(std::string_view line);

 private:
  unsigned long Add(std::string_view line);

  unsigned long crc_ = 0;  // of the lines so far
};

enum class PartStart {
  kNew,      // nothing may be there
  kResume,   // goes on with what is there, if it is of the same run
  kReplace,  // begins anew
};

class CheckpointFile {
 public:
  // Errors, and nothing is changed: what cannot be opened or is written by another process; what is
  // there without kResume, or is of another run, no part file, or not as it was written. A last line
  // without an end was never finished: it is cut off.
  static Expected<std::unique_ptr<CheckpointFile>> Open(const std::string& path, const CheckpointHead& head,
                                                  PartStart start);

  std::int64_t rows() const { return rows_; }  // that are there
  bool complete() const { return complete_; }
  const std::string& path() const { return log_->path(); }

  // Whole lines, each with its end, `rows` of them; see AppendLog.
  Expected<void> Append(const std::string& lines, std::int64_t rows);
  // Says that all rows are there, which curves of the input they are of, and waits until they are on
  // the disk.
  Expected<void> Finish(const PartEnd& end);
  Expected<void> Remove();

 private:
  explicit CheckpointFile(std::unique_ptr<AppendLog> log) : log_(std::move(log)) {}
  Expected<void> Take(const std::string& line, int number, const CheckpointHead& head);

  const std::unique_ptr<AppendLog> log_;
  LineSums sums_;
  std::int64_t rows_ = 0;
  bool complete_ = false;
};

// Reads the rows of a part file one after the other.
class CheckpointReader {
 public:
  static Expected<CheckpointReader> Open(const std::string& path);

  const CheckpointHead& head() const { return head_; }
  const std::string& path() const { return path_; }
  // None after the last. Errors: a line that is no row or not as it was written; an end that is
  // missing, or counts other rows than there were.
  Expected<std::optional<nlohmann::json>> Next();

 private:
  CheckpointReader(std::string path, std::ifstream in) : path_(std::move(path)), in_(std::move(in)) {}

  std::string path_;
  std::ifstream in_;
  LineSums sums_;
  CheckpointHead head_;
  int line_ = 0;
  std::int64_t rows_ = 0;
  bool over_ = false;
};

}  // namespace lyrefit
