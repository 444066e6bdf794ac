#include "lyrefit/study/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "lyrefit/base/numbers.h"

namespace lyrefit {
namespace {

std::string Because() { return std::strerror(errno); }

// All of `text`, or false.
bool WriteAll(int file, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t written = write(file, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    done += static_cast<std::size_t>(written);
  }
  return true;
}

std::string Dump(const JournalLine& line) {
  // Names may hold bytes that are not UTF-8.
  return line.dump(-1, ' ', false, JournalLine::error_handler_t::replace) + "\n";
}

}  // namespace

Journal::Journal(std::string path, std::string section)
    : path_(std::move(path)), section_(std::move(section)) {}

Journal::~Journal() {
  if (file_ >= 0) close(file_);
}

Expected<std::unique_ptr<Journal>> Journal::Open(const std::string& path,
                                                 const std::string& section,
                                                 const JournalLine& options) {
  std::unique_ptr<Journal> journal(new Journal(path, section));
  if (auto locked = journal->Lock(); !locked) return tl::unexpected(locked.error());
  if (auto read = journal->Read(options); !read) return tl::unexpected(read.error());
  if (!journal->has_head_) {
    const JournalLine head = {{"journal", section}, {"options", options}};
    if (!WriteAll(journal->file_, Dump(head))) {
      return Fail("cannot write the journal: " + Because(), path);
    }
  }
  return journal;
}

Expected<void> Journal::Lock() {
  std::error_code ignored;
  if (path_ == "-") return Fail("expected a file for the journal, found standard output");
  if (std::filesystem::exists(path_, ignored) &&
      !std::filesystem::is_regular_file(path_, ignored)) {
    return Fail("expected a journal, or a file that does not exist yet", path_);
  }
  file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file_ < 0) return Fail("cannot write the journal: " + Because(), path_);
  if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
    return Fail("another process is writing this journal", path_);
  }
  return {};
}

Expected<void> Journal::Read(const JournalLine& options) {
  std::ifstream in(path_, std::ios::binary);
  std::streamoff complete = 0;
  int number = 0;
  for (std::string text; std::getline(in, text);) {
    ++number;
    if (in.eof()) {
      torn_ = true;
      // A first line that was never finished is a journal's only if it begins like one.
      const std::string begin = "{\"journal\"";
      const std::size_t length = std::min(begin.size(), text.size());
      if (number == 1 && text.compare(0, length, begin, 0, length) != 0) {
        return Fail("expected a journal that --resume wrote, found another file", path_, 1);
      }
      break;
    }
    if (auto taken = Take(text, number, options); !taken) return taken;
    complete = in.tellg();
  }
  if (torn_ && ftruncate(file_, complete) != 0) {
    return Fail("cannot write the journal: " + Because(), path_);
  }
  return {};
}

Expected<void> Journal::Take(const std::string& text, int number, const JournalLine& options) {
  JournalLine line = JournalLine::parse(text, nullptr, false);
  const bool head = line.is_object() && line.contains("journal") && line["journal"].is_string();
  const bool record = line.is_object() && line.contains("of") && line["of"].is_string();
  if (!head && (!record || number == 1)) {
    return Fail("expected a journal that --resume wrote, found another file", path_, number);
  }
  if (head && line["journal"] == section_) {
    has_head_ = true;
    return CheckHead(line, number, options);
  }
  if (record && line["of"] == section_) {
    if (!has_head_) return Fail("a record stands before the options it belongs to", path_, number);
    records_.push_back({std::move(line), number});
  }
  return {};
}

Expected<void> Journal::CheckHead(const JournalLine& found, int number,
                                  const JournalLine& options) const {
  const JournalLine before = found.value("options", JournalLine::object());
  const auto text = [](const JournalLine& object, const std::string& key) {
    if (!object.contains(key)) return std::string("nothing");
    const JournalLine& value = object[key];
    return value.is_string() ? value.get<std::string>() : value.dump();
  };
  const auto differs = [&](const std::string& key) {
    return Fail(fmt::format("this study was begun with {}: {}; now it is {}. Take the same "
                            "options, or another file",
                            key, text(before, key), text(options, key)),
                path_, number);
  };
  for (const auto& [key, value] : options.items()) {
    if (!before.contains(key) || before[key] != value) return differs(key);
  }
  for (const auto& [key, value] : before.items()) {
    if (!options.contains(key)) return differs(key);
  }
  return {};
}

void Journal::Append(const JournalLine& record) {
  JournalLine line = {{"of", section_}};
  line.update(record);
  const std::string text = Dump(line);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (failure_.empty() && !WriteAll(file_, text)) failure_ = Because();
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
    remarks.push_back(
        fmt::format("{}: cannot be written ({}); the runs since then are in the report alone",
                    journal.path(), failure));
  }
  return remarks;
}

}  // namespace lyrefit
