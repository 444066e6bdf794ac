#include "lyrefit/fleet/part_file.h"

#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

constexpr char kHeadBegin[] = "{\"lyrefit_batch\"";
constexpr char kEndBegin[] = "{\"end\"";
constexpr char kNoPart[] = "expected the rows of a batch, found another file";

std::string Because() { return std::generic_category().message(errno); }

tl::unexpected<Error> CannotWriteRows(const std::string& path) {
  const std::string reason = Because();
  return Fail("cannot write the rows: " + reason, path);
}

bool Begins(const std::string& line, const std::string& with) {
  return line.compare(0, with.size(), with) == 0;
}

std::string ValueText(const PartHead& value) {
  if (value.is_null()) return "nothing";
  return value.is_string() ? value.get<std::string>() : value.dump();
}

// How heads call things, and how people do.
std::string Spoken(const std::string& key) {
  if (key == "version") return "by lyrefit";
  if (key == "input") return "on an input with the digest";
  return "with " + key;
}

nlohmann::ordered_json PlaceJson(const std::optional<std::pair<int, std::int64_t>>& place) {
  if (!place) return nullptr;
  return {place->first, place->second};
}

std::optional<std::pair<int, std::int64_t>> PlaceOf(const nlohmann::json& json) {
  const bool pair = json.is_array() && json.size() == 2 && json[0].is_number_integer() &&
                    json[1].is_number_integer();
  if (!pair) return std::nullopt;
  return std::make_pair(json[0].get<int>(), json[1].get<std::int64_t>());
}

}  // namespace

std::string PartPath(const std::string& folder, const Shard& shard) {
  if (shard.of == 1) return folder + "/results.part";
  return fmt::format("{}/shard-{}-of-{}.part", folder, shard.k, shard.of);
}

Expected<void> CheckSameHead(const PartHead& before, const PartHead& now, const std::string& path) {
  const auto differs = [&path](const std::string& what, const PartHead& old_value,
                               const PartHead& new_value) {
    return Fail(fmt::format("these rows were begun {} {}, now it is {}: go on as it was begun, or "
                            "say --force to begin anew",
                            what, ValueText(old_value), ValueText(new_value)),
                path, 1);
  };
  const auto compare = [&](const PartHead& a, const PartHead& b) -> Expected<void> {
    for (const auto& [key, value] : b.items()) {
      if (key == "options" || key == "columns") continue;
      if (!a.contains(key) || a[key] != value) {
        return differs(Spoken(key), a.value(key, PartHead()), value);
      }
    }
    for (const auto& [key, value] : a.items()) {
      if (!b.contains(key)) return differs(Spoken(key), value, PartHead());
    }
    return {};
  };
  TRY(compare(before, now));
  TRY(compare(before.value("options", PartHead::object()), now.at("options")));
  if (before.value("columns", PartHead()) == now.at("columns")) return {};
  return Fail("these rows were begun with other columns: say --force to begin anew", path, 1);
}

Expected<std::unique_ptr<PartFile>> PartFile::Open(const std::string& path, const PartHead& head,
                                                   PartStart start) {
  const int number = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (number < 0) return CannotWriteRows(path);
  std::unique_ptr<PartFile> part(new PartFile(path, number));
  TRY(part->Lock());
  struct stat status = {};
  if (fstat(number, &status) != 0) return CannotWriteRows(path);
  if (status.st_size > 0 && start == PartStart::kNew) {
    return Fail("a run was not finished here: say --resume to go on, or --force to begin anew",
                path);
  }
  if (start == PartStart::kResume) {
    TRY(part->Take(head));
  } else {
    TRY(part->Cut(0));
  }
  if (part->size_ == 0) {
    TRY(part->Append(head.dump(-1, ' ', false, PartHead::error_handler_t::replace) + "\n", 0));
  }
  return part;
}

Expected<void> PartFile::Lock() const {
  if (flock(file_.number(), LOCK_EX | LOCK_NB) != 0) {
    return Fail("another process is writing these rows", path_);
  }
  // It may have finished, and removed the file, between our opening and our lock.
  struct stat held = {};
  if (fstat(file_.number(), &held) != 0 || held.st_nlink == 0) {
    return Fail("another process has just finished these rows", path_);
  }
  return {};
}

Expected<void> PartFile::Take(const PartHead& head) {
  std::ifstream in(path_, std::ios::binary);
  int number = 0;
  bool torn = false;
  for (std::string line; !torn && std::getline(in, line);) {
    torn = in.eof();  // without an end
    if (++number == 1) {
      const std::string begin = kHeadBegin;
      const std::size_t length = torn ? std::min(begin.size(), line.size()) : begin.size();
      if (line.compare(0, length, begin, 0, length) != 0) return Fail(kNoPart, path_, 1);
    }
    if (torn) break;
    if (number == 1) {
      const PartHead before = PartHead::parse(line, nullptr, false);
      if (!before.is_object()) return Fail(kNoPart, path_, 1);
      TRY(CheckSameHead(before, head, path_));
    } else if (complete_ || line.empty() || line.front() != '{' || line.back() != '}') {
      return Fail("this line is no row, the file is damaged: say --force to begin anew", path_,
                  number);
    } else if (Begins(line, kEndBegin)) {
      complete_ = true;
    } else {
      ++rows_;
    }
    size_ += static_cast<std::int64_t>(line.size()) + 1;
  }
  return torn ? Cut(size_) : Expected<void>();
}

Expected<void> PartFile::Cut(std::int64_t size) const {
  if (ftruncate(file_.number(), size) != 0) return CannotWriteRows(path_);
  return {};
}

Expected<void> PartFile::Append(const std::string& lines, std::int64_t rows) {
  const LimitIsAnError guard;
  if (!file_.Write(lines)) {
    const auto failed = CannotWriteRows(path_);
    (void)Cut(size_);  // the next one to resume would do it too
    return failed;
  }
  size_ += static_cast<std::int64_t>(lines.size());
  rows_ += rows;
  return {};
}

Expected<void> PartFile::Finish(const PartEnd& end) {
  const nlohmann::ordered_json line = {
      {"end", rows_}, {"first", PlaceJson(end.first)}, {"last", PlaceJson(end.last)}};
  if (!complete_) TRY(Append(line.dump() + "\n", 0));
  complete_ = true;
  if (fdatasync(file_.number()) != 0 && errno != EINVAL) return CannotWriteRows(path_);
  return {};
}

Expected<void> PartFile::Remove() {
  if (unlink(path_.c_str()) != 0) return CannotWriteRows(path_);
  return {};
}

Expected<std::optional<PartEnd>> ReadPartEnd(const std::string& path) {
  constexpr std::streamoff kEnough = 4096;  // the last line of a part that is complete is short
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) return Fail("cannot read the rows: " + Because(), path);
  const std::streamoff size = in.tellg();
  in.seekg(std::max<std::streamoff>(size - kEnough, 0));
  std::string text(static_cast<std::size_t>(std::min(size, kEnough)), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (text.empty() || text.back() != '\n') return std::nullopt;
  text.pop_back();
  text.erase(0, text.rfind('\n') + 1);
  if (!Begins(text, kEndBegin)) return std::nullopt;
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json["end"].is_number_integer()) return std::nullopt;
  return PartEnd{json["end"], PlaceOf(json.value("first", nlohmann::json())),
                 PlaceOf(json.value("last", nlohmann::json()))};
}

Expected<PartReader> PartReader::Open(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return Fail("cannot read the rows: " + Because(), path);
  PartReader reader(path, std::move(in));
  std::string line;
  if (!std::getline(reader.in_, line) || !Begins(line, kHeadBegin)) return Fail(kNoPart, path, 1);
  reader.head_ = PartHead::parse(line, nullptr, false);
  reader.line_ = 1;
  if (!reader.head_.is_object()) return Fail(kNoPart, path, 1);
  return reader;
}

Expected<std::optional<nlohmann::json>> PartReader::Next() {
  if (over_) return std::nullopt;
  std::string line;
  ++line_;
  if (!std::getline(in_, line) || in_.eof()) {
    return Fail("the run that wrote these rows has not finished", path_);
  }
  nlohmann::json row = nlohmann::json::parse(line, nullptr, false);
  if (!row.is_object()) return Fail("expected a row, found something else", path_, line_);
  if (!Begins(line, kEndBegin)) {
    ++rows_;
    return row;
  }
  over_ = true;
  if (row["end"] == rows_) return std::nullopt;
  return Fail(fmt::format("expected {} rows before the end, found {}", row["end"].dump(), rows_),
              path_, line_);
}

}  // namespace lyrefit
