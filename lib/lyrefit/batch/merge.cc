#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/batch/batch.h"
#include "lyrefit/batch/checkpoint.h"
#include "lyrefit/batch/string_pages.h"
#include "lyrefit/batch/write_results.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

// The shard 3 of 8 for "shard-3-of-8.part".
std::optional<Shard> ShardOf(const std::string& name) {
  constexpr std::string_view kBegin = "shard-", kMiddle = "-of-", kEnd = ".part";
  const char* const end = name.data() + name.size();
  Shard shard;
  if (name.rfind(kBegin, 0) != 0) return std::nullopt;
  const auto k = std::from_chars(name.data() + kBegin.size(), end, shard.k);
  if (k.ec != std::errc() || name.compare(k.ptr - name.data(), kMiddle.size(), kMiddle) != 0) {
    return std::nullopt;
  }
  const auto of = std::from_chars(k.ptr + kMiddle.size(), end, shard.of);
  if (of.ec != std::errc() || std::string_view(of.ptr, end - of.ptr) != kEnd) return std::nullopt;
  return shard;
}

// "2,5-7", the notation of schedulers for the numbers of an array.
std::string Ranges(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t j = i;
    while (j + 1 < numbers.size() && numbers[j + 1] == numbers[j] + 1) ++j;
    text += (text.empty() ? "" : ",") + std::to_string(numbers[i]);
    if (j > i) text += "-" + std::to_string(numbers[j]);
    i = j + 1;
  }
  return text;
}

struct Shards {
  int of = 0;
  std::map<int, std::string> paths;
};

Expected<Shards> FindShards(const std::vector<std::string>& folders) {
  Shards shards;
  for (const std::string& folder : folders) {
    std::error_code error;
    std::vector<std::string> names;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
      names.push_back(entry->path().filename().string());
    }
    if (error) return Fail("cannot read the folder: " + error.message(), folder);
    std::sort(names.begin(), names.end());
    for (const std::string& name : names) {
      const std::optional<Shard> shard = ShardOf(name);
      if (!shard) continue;
      const std::string path = (fs::path(folder) / name).string();
      if (shards.of == 0) shards.of = shard->of;
      if (shard->of != shards.of) {
        return Fail(fmt::format("expected a shard of {} as the others are, found one of {}",
                                shards.of, shard->of),
                    path);
      }
      if (!shards.paths.emplace(shard->k, path).second) {
        return Fail(
            fmt::format("shard {} is there twice, in {} too", shard->k, shards.paths[shard->k]),
            path);
      }
    }
  }
  if (shards.of > 0) return shards;
  return Fail(
      "no shards in here: expected files named shard-K-of-N.part, as batch --shard K/N "
      "writes them",
      folders.front());
}

Expected<void> CheckAllThere(const Shards& shards) {
  std::vector<int> missing, unfinished;
  for (int k = 1; k <= shards.of; ++k) {
    const auto found = shards.paths.find(k);
    if (found == shards.paths.end()) {
      missing.push_back(k);
      continue;
    }
    TRY(const auto end, ReadCheckpointEnd(found->second));
    if (!end) unfinished.push_back(k);
  }
  if (missing.empty() && unfinished.empty()) return {};
  std::string text = fmt::format("of {} shards", shards.of);
  if (!missing.empty()) text += fmt::format(" these are missing: {}", Ranges(missing));
  if (!unfinished.empty()) {
    text += fmt::format("{} these have not finished: {}", missing.empty() ? "" : ",",
                        Ranges(unfinished));
  }
  return Fail(text);
}

CheckpointHead WithoutShard(const CheckpointHead& head) {
  CheckpointHead run = head;
  run.erase("shard");
  // Only the names and sizes of the whole input are compared. The rest of the digest covers bytes
  // up to the shard's end and so differs between shards.
  const std::string input = head.value("input", "");
  run["input"] = input.substr(0, input.find('-'));
  return run;
}

// Checks that all shards are of one run and that each begins at the end of the one before.
Expected<void> CheckOneRun(const Shards& shards) {
  std::optional<CheckpointHead> run;
  std::pair<int, std::int64_t> next{0, 0};
  for (const auto& [k, path] : shards.paths) {
    TRY(const CheckpointReader reader, CheckpointReader::Open(path));
    const CheckpointHead own = WithoutShard(reader.head());
    if (reader.head().value("shard", 0) != k || reader.head().value("of", 0) != shards.of) {
      return Fail(fmt::format("this is shard {} of {}: its file was renamed",
                              reader.head().value("shard", 0), reader.head().value("of", 0)),
                  path);
    }
    if (!run) run = own;
    if (auto same = CheckSameHead(*run, own, path); !same) {
      return Fail("this shard is of another run than the first: " + same.error().message, path);
    }
    TRY(const auto end, ReadCheckpointEnd(path));
    if (!end->first || !end->last) continue;  // a shard without rows
    const bool another = end->first->first > next.first && end->first->second == 0;
    if (*end->first != next && !another) {
      return Fail(fmt::format("this shard does not begin where the one before it ends: the input "
                              "was another one. Do shard {} again",
                              k),
                  path);
    }
    next = {end->last->first, end->last->second + 1};
  }
  return {};
}

}  // namespace

Expected<BatchSummary> MergeShards(const std::vector<std::string>& folders,
                                   const MergeOptions& options, const RowObserver& row_observer) {
  const Instant begin = Now();
  if (folders.empty()) return Fail("no folder with shards");
  if (options.folder.empty()) return Fail("no folder for the results");
  TRY(const Shards shards, FindShards(folders));
  TRY(CheckAllThere(shards));
  TRY(CheckOneRun(shards));
  TRY(PrepareFolder(options.folder, options.replace, options.additions));
  std::vector<std::string> paths;
  for (const auto& [k, path] : shards.paths) paths.push_back(path);
  TRY(const CheckpointReader reader, CheckpointReader::Open(paths.front()));
  BatchSummary summary;
  summary.version = reader.head().value("version", "");
  summary.task = reader.head().value("task", "");
  summary.folder = options.folder;
  summary.seed = reader.head().at("options").value("seed", std::uint64_t{0});
  for (const std::string& path : paths) TRY(BringStringPages(path, options.folder));
  TRY(auto results, WriteResults(paths, options.folder, options.additions, {}, row_observer));
  static_cast<BatchResults&>(summary) = std::move(*results);  // nobody stops it
  summary.seconds = SecondsSince(begin);
  return summary;
}

}  // namespace lyrefit
