#include "lyrefit/batch/checkpoint.h"

#include <fmt/format.h>
#include <zlib.h>

#include "lyrefit/base/try.h"
#include "lyrefit/read/json_text.h"

namespace lyrefit {
namespace {

constexpr char kHeadBegin[] = "{\"lyrefit_batch\"";
constexpr char kEndBegin[] = "{\"end\"";
constexpr char kNoPart[] = "expected the rows of a batch, found another file";
constexpr char kUnfinished[] = "the run that wrote these rows has not finished";
constexpr char kNoSums[] =
    "these rows have no checksums, as an older lyrefit wrote them: finish and merge them with that "
    "one, or begin anew with batch --force";
constexpr LogKind kKind = {"rows",     "these rows", "rows of a batch",
                           kHeadBegin, kNoPart,      "begin anew with batch --force",
                           kNoSums};

// Format number in the head: {"lyrefit_batch":2, ...}. Files of format 1 have no checksums.
constexpr int kFormat = 2;

bool Begins(const std::string& line, const std::string& with) {
  return line.compare(0, with.size(), with) == 0;
}

// Name of a member of the head, for messages.
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

Expected<CheckpointHead> HeadOf(const std::string& line, const std::string& path) {
  CheckpointHead head = CheckpointHead::parse(line, nullptr, false);
  if (!head.is_object()) return Fail(kNoPart, path, 1);
  return head;
}

}  // namespace

CheckpointHead NewCheckpointHead() { return {{"lyrefit_batch", kFormat}}; }

std::string CheckpointPath(const std::string& folder, const Shard& shard) {
  if (shard.of == 1) return folder + "/results.part";
  return fmt::format("{}/shard-{}-of-{}.part", folder, shard.k, shard.of);
}

Expected<void> CheckSameHead(const CheckpointHead& before, const CheckpointHead& now,
                             const std::string& path) {
  const auto compare = [&path](const BatchJson& a, const BatchJson& b) -> Expected<void> {
    const std::optional<std::string> key = FirstDifference(a, b);
    if (!key) return {};
    return Fail(fmt::format("these rows were begun {} {}, now it is {}: go on as it was begun, or "
                            "say --force to begin anew",
                            Spoken(*key), MemberText(a, *key), MemberText(b, *key)),
                path, 1);
  };
  const auto plain = [](CheckpointHead head) {
    head.erase("options");
    head.erase("columns");
    return head;
  };
  TRY(compare(plain(before), plain(now)));
  TRY(compare(before.value("options", BatchJson::object()), now.at("options")));
  if (before.value("columns", BatchJson()) == now.at("columns")) return {};
  return Fail("these rows were begun with other columns: say --force to begin anew", path, 1);
}

Expected<std::unique_ptr<CheckpointFile>> CheckpointFile::Open(const std::string& path,
                                                               const CheckpointHead& head,
                                                               PartStart start) {
  TRY(auto log, AppendLog::Open(path, kKind));
  std::unique_ptr<CheckpointFile> part(new CheckpointFile(std::move(log)));
  if (!part->log_->empty() && start == PartStart::kNew) {
    return Fail("a run was not finished here: say --resume to go on, or --force to begin anew",
                path);
  }
  if (start == PartStart::kResume) {
    TRY(part->log_->TakeUp(
        [&](const std::string& line, int number) { return part->Take(line, number, head); }));
  } else {
    TRY(part->log_->Clear());
  }
  if (part->log_->empty()) {
    TRY(part->Append(head.dump(-1, ' ', false, BatchJson::error_handler_t::replace) + "\n", 0));
  }
  return part;
}

Expected<void> CheckpointFile::Take(const std::string& line, int number,
                                    const CheckpointHead& head) {
  if (number == 1) {
    TRY(const CheckpointHead before, HeadOf(line, path()));
    return CheckSameHead(before, head, path());
  }
  if (complete_ || line.empty() || line.front() != '{' || line.back() != '}') {
    return Fail("this line is no row, the file is damaged: say --force to begin anew", path(),
                number);
  }
  complete_ = Begins(line, kEndBegin);
  if (!complete_) ++rows_;
  return {};
}

Expected<void> CheckpointFile::Append(const std::string& lines, std::int64_t rows) {
  TRY(log_->Append(lines));
  rows_ += rows;
  return {};
}

Expected<void> CheckpointFile::Finish(const PartEnd& end) {
  const nlohmann::ordered_json line = {
      {"end", rows_}, {"first", PlaceJson(end.first)}, {"last", PlaceJson(end.last)}};
  if (!complete_) TRY(Append(line.dump() + "\n", 0));
  complete_ = true;
  return log_->Sync();
}

Expected<void> CheckpointFile::Remove() { return log_->Remove(); }

std::string TextDigest(const std::string& text) {
  const auto* const bytes = reinterpret_cast<const unsigned char*>(text.data());
  return fmt::format("{:08x}-{}", ::crc32_z(0, bytes, text.size()), text.size());
}

Expected<std::optional<PartEnd>> ReadCheckpointEnd(const std::string& path) {
  TRY(const auto line, LastLine(path, kKind));
  if (!line || !Begins(*line, kEndBegin)) return std::nullopt;
  const nlohmann::json json = nlohmann::json::parse(*line, nullptr, false);
  if (!json.is_object() || !json["end"].is_number_integer()) return std::nullopt;
  return PartEnd{json["end"], PlaceOf(json.value("first", nlohmann::json())),
                 PlaceOf(json.value("last", nlohmann::json()))};
}

Expected<CheckpointReader> CheckpointReader::Open(const std::string& path) {
  TRY(LogReader log, LogReader::Open(path, kKind));
  TRY(const auto line, log.Next());
  if (!line) return log.torn() ? Fail(kUnfinished, path) : Fail(kNoPart, path, 1);
  CheckpointReader reader(std::move(log));
  TRY(reader.head_, HeadOf(*line, path));
  return reader;
}

Expected<std::optional<nlohmann::json>> CheckpointReader::Next() {
  if (over_) return std::nullopt;
  TRY(const auto line, log_.Next());
  if (!line) return Fail(kUnfinished, path());
  nlohmann::json row = nlohmann::json::parse(*line, nullptr, false);
  if (!row.is_object()) return Fail("expected a row, found something else", path(), log_.line());
  if (!Begins(*line, kEndBegin)) {
    ++rows_;
    return row;
  }
  over_ = true;
  if (row["end"] == rows_) return std::nullopt;
  return Fail(fmt::format("expected {} rows before the end, found {}", row["end"].dump(), rows_),
              path(), log_.line());
}

}  // namespace lyrefit
