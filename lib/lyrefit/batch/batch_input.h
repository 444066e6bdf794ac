#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/batch/csv_head.h"
#include "lyrefit/batch/batch_source.h"
#include "lyrefit/batch/line_scanner.h"

namespace lyrefit {

// A curve found in one input.
struct FoundCurve {
  std::string id;
  std::int64_t line = 0;  // 0: a file of its own
  std::int64_t number = 0;
  std::int64_t begin = 0;  // its first byte, of size()
  std::int64_t end = 0;
  std::string_view bytes;  // until the next one is asked for
  std::string file;        // where it is not that of the input
  bool unnamed = false;    // the id is its place in a file of many
  std::optional<Error> error;
};

// A sum over bytes that tells other bytes apart.
struct ByteSum {
  unsigned long crc = 0;
  std::int64_t bytes = 0;

  void Add(std::string_view text);
  // The first bytes of a file, as many as `limit`.
  Expected<void> AddFile(const std::string& path, std::int64_t limit);
};

// One of the inputs of a batch, whatever its shape.
class BatchInput {
 public:
  virtual ~BatchInput() = default;
  virtual Expected<std::optional<FoundCurve>> Next() = 0;
  virtual BatchCurve Read(const BatchItem& item) const = 0;
  // Never 0, so that an empty file is somewhere, too.
  virtual std::int64_t size() const = 0;
  // Of what lies before `until`, of size().
  virtual Expected<void> AddTo(ByteSum* sum, std::int64_t until) const = 0;
  virtual void AddRemarks(std::vector<std::string>* remarks) const = 0;
};

// Each reads one shape. `scanner` stands at the beginning of the file.
std::unique_ptr<BatchInput> JsonRowsInput(const std::string& path,
                                          std::unique_ptr<LineScanner> scanner,
                                          const ReadOptions& options);
std::unique_ptr<BatchInput> CsvRowsInput(const std::string& path,
                                         std::unique_ptr<LineScanner> scanner, const CsvHead& head,
                                         const ReadOptions& options);
std::unique_ptr<BatchInput> LongTableInput(const std::string& path,
                                           std::unique_ptr<LineScanner> scanner,
                                           const CsvHead& head, const ReadOptions& options);
// `list`: the key under which the curves stand, or none, where the document is a list.
Expected<std::unique_ptr<BatchInput>> JsonListInput(const std::string& path,
                                                    const std::optional<std::string>& list,
                                                    const ReadOptions& options);
std::unique_ptr<BatchInput> JsonWholeInput(const std::string& path, const ReadOptions& options);
std::unique_ptr<BatchInput> OneCurveInput(const std::string& path, const ReadOptions& options);
// `prefix` leads the ids.
Expected<std::unique_ptr<BatchInput>> FolderTreeInput(const std::string& folder,
                                                      const std::string& prefix,
                                                      const ReadOptions& options);

// Whether it cannot be read again: "-", which is standard input, or a pipe.
bool IsReadOnce(const std::string& path);

// Looks at what it is. "-" is standard input.
Expected<std::unique_ptr<BatchInput>> OpenInput(const std::string& path, const std::string& prefix,
                                                const ReadOptions& options);

// A text in which bytes that are no UTF-8, as names of files may hold, are %FF: two such texts that
// differ stay different.
std::string PercentCoded(std::string_view text);

// What ids begin with that come from a file: its path without its ending and without what leads out
// of or to the top of the file system.
std::string IdOfPath(const std::string& path);

// The file's name without folder and ending; "input" for standard input and pipes.
std::string StemOf(const std::string& path);

// The size of a file, 0 if it cannot be told.
std::int64_t SizeOfFile(const std::string& path);

// The curve of a row in JSON with what stands around it, whatever it is nested in. `line`: of its
// first character.
BatchCurve ReadJsonText(std::string_view text, const BatchItem& item, const std::string& path,
                        const std::vector<RowScalar>& around, const ReadOptions& options);

}  // namespace lyrefit
