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

namespace lyrefit {

using JournalLine = nlohmann::ordered_json;

// What a study has done so far, in a file that grows line by line while it runs, so that a study
// that was stopped, or killed, can be taken up again. Every line is one JSON object: a head with
// the options of a section, or a record of it, one a finished run. A file may hold several sections
// (the studies of one reproduction).
class Journal {
 public:
  // Opens `path` for `section`, or begins it. Of the options every one must be what the head of the
  // section says. A last line without an end is what a process left that was killed while it wrote:
  // it is cut off. Errors: a file that cannot be read or written, that another process is writing,
  // or that is no journal; the first option that differs.
  static Expected<std::unique_ptr<Journal>> Open(const std::string& path,
                                                 const std::string& section,
                                                 const JournalLine& options);
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  // The records of the section that were there, each with the line it stands in.
  struct Record {
    JournalLine json;
    int line = 0;
  };
  const std::vector<Record>& records() const { return records_; }
  const std::string& path() const { return log_->path(); }
  bool torn() const { return log_->torn(); }  // a last line was cut off

  // Writes a record before it returns, from any thread. After a failure nothing more is written.
  void Append(const JournalLine& record);
  // Why not all records were written; empty: all were.
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
  mutable std::mutex mutex_;  // of what follows
  std::string failure_;
};

// JSON has no NaN and no infinity; a journal keeps them as text, all other numbers to the last bit.
JournalLine ExactNumber(double value);
JournalLine ExactNumbers(const std::vector<double>& values);

// Reads what a record holds; the first thing that is missing or of another kind is kept, and the
// rest reads as nothing.
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

// Sixteen hexadecimal digits that differ where the numbers do: tells data apart in a head.
std::string Fingerprint(const std::vector<double>& values);

// What a reader at the terminal should know of a journal; `taken` says what was taken from it,
// empty: nothing.
std::vector<std::string> JournalRemarks(const Journal& journal, const std::string& taken);

}  // namespace lyrefit
