#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/append_log.h"
#include "lyrefit/base/error.h"
#include "lyrefit/study/comparison.h"
#include "lyrefit/study/reference.h"
#include "lyrefit/study/summary.h"

namespace lyrefit {

using JournalLine = nlohmann::ordered_json;

// The results of a study so far, in a file that grows line by line while the study runs. A stopped
// or killed study can be resumed from it. Every line is one JSON object: the head of a section,
// which holds the options, or a record of a section, one for each finished run. A file may hold
// several sections, such as the studies of one reproduction.
class Journal {
 public:
  // Opens `path` for `section` and starts the section if it is new. Every option must equal the
  // option in the section's head. A last line without a line end was left by a process killed while
  // writing and is cut off. Errors: a file that cannot be read or written, is written by another
  // process, or is no journal; the first option that differs.
  static Expected<std::unique_ptr<Journal>> Open(const std::string& path,
                                                 const std::string& section,
                                                 const JournalLine& options);
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  // A record of the section that was in the file when it was opened.
  struct Record {
    JournalLine json;
    int line = 0;
  };
  const std::vector<Record>& records() const { return records_; }
  const std::string& path() const { return log_->path(); }
  bool torn() const { return log_->torn(); }  // true: an incomplete last line was cut off

  // Writes a record before it returns. Thread-safe. After a write error nothing more is written.
  void Append(const JournalLine& record);
  // Reason why not all records were written; empty: all were written.
  std::string failure() const;

 private:
  Journal(std::unique_ptr<AppendLog> log, std::string section)
      : log_(std::move(log)), section_(std::move(section)) {}
  Expected<void> Take(const std::string& text, int number, const JournalLine& options);
  Expected<void> CheckHead(const JournalLine& found, int number, const JournalLine& options) const;

  const std::unique_ptr<AppendLog> log_;
  const std::string section_;
  bool has_head_ = false;
  std::vector<Record> records_;
  mutable std::mutex mutex_;  // guards `failure_` and the writing of records
  std::string failure_;
};

// JSON has no NaN and no infinity, so a journal stores them as text. All other numbers keep every
// bit.
JournalLine ExactNumber(double value);
JournalLine ExactNumbers(const std::vector<double>& values);

// Reads the members of a record. The first missing or mistyped member is kept as the error. Missing
// and mistyped members read as empty values.
class RecordReader {
 public:
  RecordReader(const Journal& journal, const Journal::Record& record)
      : journal_(journal), record_(record) {}

  std::string Text(const char* key);
  std::int64_t Whole(const char* key);
  bool Truth(const char* key);
  double Number(const char* key);
  std::vector<double> Numbers(const char* key);
  std::vector<std::vector<double>> Rows(const char* key);

  Expected<void> Checked() const;  // an Error names file and line

 private:
  const JournalLine& Find(const char* key);
  double ToNumber(const JournalLine& value, const char* key);
  void Object(const char* key, const char* expected);

  const Journal& journal_;
  const Journal::Record& record_;
  std::string error_;
};

// Sixteen hexadecimal digits that differ for different data, with high probability. The journal
// head identifies data by them.
std::string Fingerprint(const std::vector<double>& values);

// Messages about a journal for the user. `taken` describes the records that were resumed from;
// empty: none.
std::vector<std::string> JournalRemarks(const Journal& journal, const std::string& taken);

// The journal head: all inputs that a run of a comparison depends on. The number of runs is left
// out, so that a study can be resumed with more runs. The inputs must have been checked.
JournalLine CompareHead(const std::vector<CompareCurve>& curves,
                        const std::vector<ComparedAlgorithm>& algorithms,
                        const CompareOptions& options);

// The position of a run in its comparison.
struct RunPlace {
  int problem = 0;  // curves in the given order, each with all models
  int algorithm = 0;
  int run = 0;
};

JournalLine WriteRun(const RunPlace& place, const ProblemResult& problem,
                     const ComparedAlgorithm& compared, const CompareOptions& options,
                     const RunOutcome& outcome);

struct WrittenRun {
  RunPlace place;
  RunOutcome outcome;
};
Expected<WrittenRun> ReadRun(const Journal& journal, const Journal::Record& record);

// The record of a problem's multistart.
JournalLine WriteBestKnown(int problem, const BestKnown& known);
bool IsBestKnown(const Journal::Record& record);
struct WrittenBestKnown {
  int problem = 0;
  BestKnown known;
};
Expected<WrittenBestKnown> ReadBestKnown(const Journal& journal, const Journal::Record& record);

}  // namespace lyrefit
