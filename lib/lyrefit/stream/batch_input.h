#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/stream/batch_source.h"
#include "lyrefit/stream/csv_head.h"
#include "lyrefit/stream/line_scanner.h"

namespace lyrefit {

// Size of a file in bytes; 0 if unknown.
std::int64_t SizeOfFile(const std::string& path);

class BatchInput;

// A curve found in one input.
struct FoundCurve {
  std::string id;
  std::int64_t line = 0;     // line of its first byte; 0: a file of its own
  std::int64_t in_file = 0;  // as in BatchItem
  std::int64_t begin = 0;    // position of its first byte, on the scale of size()
  std::int64_t end = 0;
  std::string_view bytes;  // valid until the next call of Next()
  std::string file;        // file of the curve, if it differs from the input's
  bool stated = false;     // the curve states its id, which is unique within its file
  bool unnamed = false;    // the id is its position in a file of many curves
  std::shared_ptr<const BatchInput> reader;  // if it is not the input that found the curve
  std::optional<Error> error;
};

// A checksum over bytes that detects changed input.
struct ByteSum {
  unsigned long crc = 0;
  std::int64_t bytes = 0;

  void Add(std::string_view text);
  // Adds the first `limit` bytes of a file.
  Expected<void> AddFile(const std::string& path, std::int64_t limit);
};

// One input of a batch, of any shape.
class BatchInput {
 public:
  virtual ~BatchInput() = default;
  virtual Expected<std::optional<FoundCurve>> Next() = 0;
  virtual BatchCurve Read(const BatchItem& item) const = 0;
  // Total size in bytes. It is at least 1, so that an empty file has a position too.
  virtual std::int64_t size() const = 0;
  // Adds the bytes before position `until`, on the scale of size().
  virtual Expected<void> AddTo(ByteSum* sum, std::int64_t until) const = 0;
  virtual void AddRemarks(std::vector<std::string>*) const {}
};

// Base of the inputs that are one file.
class FileInput : public BatchInput {
 public:
  FileInput(std::string path, const ReadOptions& options)
      : path_(std::move(path)), options_(options), size_(SizeOfFile(path_) + 1) {}

  std::int64_t size() const override { return size_; }
  Expected<void> AddTo(ByteSum* sum, std::int64_t until) const override {
    return sum->AddFile(path_, until);
  }

 protected:
  const std::string path_;
  const ReadOptions options_;

 private:
  const std::int64_t size_;
};

// Inputs of one shape each. `scanner` is at the beginning of the file; `name` is the first part of
// ids that the file does not state.
std::unique_ptr<BatchInput> JsonRowsInput(const std::string& path,
                                          std::unique_ptr<LineScanner> scanner,
                                          const ReadOptions& options);
std::unique_ptr<BatchInput> CsvRowsInput(const std::string& path,
                                         std::unique_ptr<LineScanner> scanner, const CsvHead& head,
                                         const ReadOptions& options);
std::unique_ptr<BatchInput> LongTableInput(const std::string& path,
                                           std::unique_ptr<LineScanner> scanner,
                                           const CsvHead& head, const ReadOptions& options);
// `list`: the key of the list of curves; empty if the document is a list.
Expected<std::unique_ptr<BatchInput>> JsonListInput(const std::string& path,
                                                    const std::string& name,
                                                    const std::optional<std::string>& list,
                                                    const ReadOptions& options);
// A file that is read whole: one curve, or, if `several`, a JSON document with curves at any
// position or a table with several measurements side by side.
std::unique_ptr<BatchInput> WholeFileInput(const std::string& path, const std::string& name,
                                           bool several, const ReadOptions& options);
// `name` is the first part of the ids.
Expected<std::unique_ptr<BatchInput>> FolderTreeInput(const std::string& folder,
                                                      const std::string& name,
                                                      const ReadOptions& options);

// True if the input cannot be read twice: "-", which is standard input, or a pipe.
bool IsReadOnce(const std::string& path);

// Opens an input after detecting its shape. "-" is standard input. `name` is the first part of the
// ids: of the unnamed curves of a file, of all curves of a folder.
Expected<std::unique_ptr<BatchInput>> OpenInput(const std::string& path, const std::string& name,
                                                const ReadOptions& options);

// `text` with bytes that are not UTF-8, as in file names, replaced by %FF and the like. Different
// texts stay different.
std::string PercentCoded(std::string_view text);

// First part of the ids of a file's curves. It is the path without its ending and without leading
// "/", "." and ".." parts.
std::string IdOfPath(const std::string& path);

// The file's name without folder and ending; "input" for standard input and pipes.
std::string StemOfInput(const std::string& path);

// The curve of a row in JSON, nested in any way, with the scalars `around` it. `item.line` is the
// line of its first character.
BatchCurve ReadJsonText(std::string_view text, const BatchItem& item, const std::string& path,
                        const std::vector<RecordScalar>& around, const ReadOptions& options);

}  // namespace lyrefit
