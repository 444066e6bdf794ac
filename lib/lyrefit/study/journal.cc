#include "lyrefit/study/compare_journal.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/json_text.h"

namespace lyrefit {
namespace {

constexpr char kNoJournal[] = "expected a journal that --resume wrote, found another file";
constexpr LogKind kKind = {"journal",      "this journal", "a journal",
                           "{\"journal\"", kNoJournal,     "begin another one"};

std::string LineText(const JournalLine& line) {
  // Names may hold bytes that are not UTF-8.
  return line.dump(-1, ' ', false, JournalLine::error_handler_t::replace) + "\n";
}

}  // namespace

Expected<std::unique_ptr<Journal>> Journal::Open(const std::string& path,
                                                 const std::string& section,
                                                 const JournalLine& options) {
  if (path == "-") return Fail("expected a file for the journal, found standard output");
  TRY(auto log, AppendLog::Open(path, kKind));
  std::unique_ptr<Journal> journal(new Journal(std::move(log), section));
  TRY(journal->log_->TakeUp(
      [&](const std::string& line, int number) { return journal->Take(line, number, options); }));
  if (!journal->has_head_) {
    const JournalLine head = {{"journal", section}, {"options", options}};
    TRY(journal->log_->Append(LineText(head)));
  }
  return journal;
}

Expected<void> Journal::Take(const std::string& text, int number, const JournalLine& options) {
  JournalLine line = JournalLine::parse(text, nullptr, false);
  const bool head = line.is_object() && line.contains("journal") && line["journal"].is_string();
  const bool record = line.is_object() && line.contains("of") && line["of"].is_string();
  if (!head && (!record || number == 1)) {
    return Fail(kNoJournal, path(), number);
  }
  if (head && line["journal"] == section_) {
    has_head_ = true;
    return CheckHead(line, number, options);
  }
  if (record && line["of"] == section_) {
    if (!has_head_) return Fail("a record stands before the options it belongs to", path(), number);
    records_.push_back({std::move(line), number});
  }
  return {};
}

Expected<void> Journal::CheckHead(const JournalLine& found, int number,
                                  const JournalLine& options) const {
  const JournalLine before = found.value("options", JournalLine::object());
  const std::optional<std::string> key = FirstDifference(before, options);
  if (!key) return {};
  return Fail(fmt::format("this study was begun with {}: {}; now it is {}. Take the same options, "
                          "or another file",
                          *key, MemberText(before, *key), MemberText(options, *key)),
              path(), number);
}

void Journal::Append(const JournalLine& record) {
  JournalLine line = {{"of", section_}};
  line.update(record);
  const std::string text = LineText(line);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!failure_.empty()) return;
  if (const auto written = log_->Append(text); !written) failure_ = written.error().message;
}

std::string Journal::failure() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return failure_;
}

JournalLine ExactNumber(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

JournalLine ExactNumbers(const std::vector<double>& values) {
  JournalLine list = JournalLine::array();
  for (const double value : values) list.push_back(ExactNumber(value));
  return list;
}

void RecordReader::Object(const char* key, const char* expected) {
  if (error_.empty()) error_ = fmt::format("expected {} as {} of this record", expected, key);
}

const JournalLine& RecordReader::Find(const char* key) {
  static const JournalLine kNothing;
  const auto found = record_.json.find(key);
  return found == record_.json.end() ? kNothing : *found;
}

std::string RecordReader::Text(const char* key) {
  const JournalLine& value = Find(key);
  if (value.is_string()) return value.get<std::string>();
  Object(key, "a text");
  return {};
}

std::int64_t RecordReader::Whole(const char* key) {
  const JournalLine& value = Find(key);
  if (value.is_number_integer()) return value.get<std::int64_t>();
  Object(key, "a whole number");
  return 0;
}

bool RecordReader::Truth(const char* key) {
  const JournalLine& value = Find(key);
  if (value.is_boolean()) return value.get<bool>();
  Object(key, "true or false");
  return false;
}

double RecordReader::ToNumber(const JournalLine& value, const char* key) {
  if (value.is_number()) return value.get<double>();
  if (value == "nan") return kUnknown;
  if (value == "inf") return HUGE_VAL;
  if (value == "-inf") return -HUGE_VAL;
  Object(key, "a number");
  return 0;
}

double RecordReader::Number(const char* key) { return ToNumber(Find(key), key); }

std::vector<double> RecordReader::Numbers(const char* key) {
  std::vector<double> numbers;
  const JournalLine& list = Find(key);
  if (!list.is_array()) Object(key, "a list of numbers");
  for (const JournalLine& value : list) numbers.push_back(ToNumber(value, key));
  return numbers;
}

std::vector<std::vector<double>> RecordReader::Rows(const char* key) {
  std::vector<std::vector<double>> rows;
  const JournalLine& list = Find(key);
  if (!list.is_array()) Object(key, "a list of rows");
  for (const JournalLine& row : list) {
    if (!row.is_array()) Object(key, "a list of rows");
    rows.emplace_back();
    for (const JournalLine& value : row) rows.back().push_back(ToNumber(value, key));
  }
  return rows;
}

Expected<void> RecordReader::Checked() const {
  if (error_.empty()) return {};
  return Fail(error_, journal_.path(), record_.line);
}

std::string Fingerprint(const std::vector<double>& values) {
  std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a over the bytes
  for (const double value : values) {
    unsigned char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211ULL;
  }
  return fmt::format("{:016x}", hash);
}

std::vector<std::string> JournalRemarks(const Journal& journal, const std::string& taken) {
  std::vector<std::string> remarks;
  if (!taken.empty()) remarks.push_back(fmt::format("{}: {}", journal.path(), taken));
  if (journal.torn()) {
    remarks.push_back(
        journal.path() +
        ": the last line was never finished and is left out; what it was of is done again");
  }
  if (const std::string failure = journal.failure(); !failure.empty()) {
    remarks.push_back(fmt::format("{}: {}; the runs since then are in the report alone",
                                  journal.path(), failure));
  }
  return remarks;
}

}  // namespace lyrefit
