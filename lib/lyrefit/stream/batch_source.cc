#include "lyrefit/stream/batch_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>
#include <utility>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/table_curve.h"
#include "lyrefit/stream/batch_input.h"
#include "lyrefit/stream/seen_ids.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

std::string WhereOf(const FoundCurve& found, const std::string& input) {
  const std::string& file = found.file.empty() ? input : found.file;
  return found.line == 0 ? file : fmt::format("{}:{}", file, found.line);
}

std::string WhereOf(const IdPlace& place, const std::vector<std::string>& paths) {
  const std::string& path = paths[static_cast<std::size_t>(place.input)];
  return place.line == 0 ? path : fmt::format("{}:{}", path, place.line);
}

// `id` without characters that end a line or a page.
std::string CleanId(std::string id) {
  id = PercentCoded(id);
  for (char& c : id) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return id;
}

}  // namespace

std::string PercentCoded(std::string_view text) {
  std::string coded;
  while (const auto bad = FirstInvalidUtf8(text)) {
    coded += fmt::format("{}%{:02X}", text.substr(0, *bad), static_cast<unsigned char>(text[*bad]));
    text.remove_prefix(*bad + 1);
  }
  return coded.append(text);
}

namespace {

// All inputs in sequence, limited to one shard.
class Batch : public BatchSource {
 public:
  Batch(std::vector<std::string> paths, std::vector<std::shared_ptr<BatchInput>> inputs,
        const Shard& shard)
      : paths_(std::move(paths)), inputs_(std::move(inputs)) {
    std::int64_t all = 0;
    for (const auto& input : inputs_) all += input->size();
    // This order of operations cannot overflow for any file size.
    const auto part = [&](int k) { return all / shard.of * k + all % shard.of * k / shard.of; };
    begin_ = part(shard.k - 1);
    end_ = part(shard.k);
    known_ = std::none_of(paths_.begin(), paths_.end(), IsReadOnce);
    if (!known_) end_ = std::numeric_limits<std::int64_t>::max();
  }

  Expected<std::optional<BatchItem>> Next() override {
    while (input_ < inputs_.size()) {
      TRY(auto found, inputs_[input_]->Next());
      if (!found) {
        base_ += inputs_[input_++]->size();
        number_ = 0;
        continue;
      }
      any_ = true;
      ++number_;
      const std::int64_t at = base_ + found->begin;
      if (at >= end_) break;
      NameIt(&*found);
      if (at < begin_) continue;
      return std::optional<BatchItem>(ItemOf(std::move(*found)));
    }
    if (input_ == inputs_.size() && !any_) {
      return Fail("expected at least one curve, found none", paths_.empty() ? "" : paths_.front());
    }
    input_ = inputs_.size();
    return std::optional<BatchItem>();
  }

  BatchCurve Read(const BatchItem& item) const override {
    BatchCurve curve;
    if (item.error) {
      curve.id = item.id;
      curve.curve = tl::unexpected(*item.error);
      return curve;
    }
    curve = item.reader->Read(item);
    if (curve.curve && !curve.curve->notes.date.empty()) {
      curve.beside.emplace("date", curve.curve->notes.date);
    }
    return curve;
  }

  std::int64_t size() const override { return known_ ? end_ - begin_ : 0; }

  Expected<std::string> Digest() const override {
    if (!known_) return std::string();
    ByteSum files;
    ByteSum sum;
    std::int64_t base = 0;
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      const std::int64_t size = inputs_[i]->size();
      files.Add(fmt::format("{} {}\n", paths_[i], size));
      if (base < end_) TRY(inputs_[i]->AddTo(&sum, std::min(size, end_ - base)));
      base += size;
    }
    return fmt::format("{:08x}-{:08x}-{}", files.crc, sum.crc, sum.bytes);
  }

  std::vector<std::string> Remarks() const override {
    std::vector<std::string> remarks;
    for (const auto& input : inputs_) input->AddRemarks(&remarks);
    return remarks;
  }

 private:
  // Sets the id of a curve, and an error if the id was used before.
  void NameIt(FoundCurve* found) {
    const std::string& path = paths_[input_];
    if (found->id.empty()) {
      found->unnamed = found->line != 0;
      found->id = found->line == 0 ? IdOfPath(found->file.empty() ? path : found->file)
                                   : fmt::format("{}:{}", StemOfInput(path), found->line);
    }
    found->id = CleanId(std::move(found->id));
    const auto before = ids_.Insert(found->id, {static_cast<int>(input_), found->line});
    if (!before || found->error) return;
    const std::string& file = found->file.empty() ? path : found->file;
    found->error = Error{fmt::format("the id '{}' was used before, in {}: every curve needs its "
                                     "own, and the rows of one have to stand together",
                                     found->id, WhereOf(*before, paths_)),
                         file, static_cast<int>(found->line)};
  }

  BatchItem ItemOf(FoundCurve found) {
    BatchItem item;
    item.place = place_++;
    item.where = WhereOf(found, paths_[input_]);
    item.bytes = std::string(found.bytes);
    item.end = std::min(base_ + found.end, end_) - begin_;
    item.input = static_cast<int>(input_);
    item.reader = found.reader ? std::move(found.reader) : inputs_[input_];
    item.line = found.line;
    item.number = number_ - 1;
    item.in_file = found.in_file;
    item.unnamed = found.unnamed;
    item.error = std::move(found.error);
    item.id = std::move(found.id);
    return item;
  }

  const std::vector<std::string> paths_;
  const std::vector<std::shared_ptr<BatchInput>> inputs_;
  SeenIds ids_;
  std::int64_t begin_ = 0;  // first byte of the shard, counted over all inputs
  std::int64_t end_ = 0;
  bool known_ = true;  // the size is known, and all inputs can be read again
  bool any_ = false;   // at least one curve was found
  std::size_t input_ = 0;
  std::int64_t base_ = 0;    // position of the current input
  std::int64_t number_ = 0;  // of its curves found
  std::int64_t place_ = 0;
};

// Sidecars of the tables among the inputs, since a pattern such as `roof/*` includes them.
std::set<fs::path> SidecarsOf(const std::vector<std::string>& inputs) {
  std::set<fs::path> sidecars;
  for (const std::string& path : inputs) {
    if (IsTable(path)) sidecars.insert(fs::path(path).replace_extension(".json"));
  }
  return sidecars;
}

}  // namespace

Expected<std::unique_ptr<BatchSource>> OpenBatch(const std::vector<std::string>& inputs,
                                                 const BatchReadOptions& options) {
  if (inputs.empty()) return Fail("no input");
  const Shard& shard = options.shard;
  if (shard.of < 1 || shard.k < 1 || shard.k > shard.of) {
    return Fail(
        fmt::format("expected a shard k/N with 1 <= k <= N, found {}/{}", shard.k, shard.of));
  }
  if (std::count(inputs.begin(), inputs.end(), "-") > 1) {
    return Fail("standard input can be named once");
  }
  if (shard.of > 1 && std::any_of(inputs.begin(), inputs.end(), IsReadOnce)) {
    return Fail("standard input and pipes cannot be split into shards: pack them into a file");
  }
  const auto folders = std::count_if(inputs.begin(), inputs.end(),
                                     [](const std::string& path) { return IsFolder(path); });
  const std::set<fs::path> sidecars = SidecarsOf(inputs);
  std::vector<std::string> paths;
  std::vector<std::shared_ptr<BatchInput>> opened;
  for (const std::string& path : inputs) {
    if (sidecars.count(path) != 0) continue;
    const std::string folder = folders > 1 ? FolderNameOf(fs::path(path) / "x") : "";
    TRY(auto input, OpenInput(path, IsFolder(path) ? folder : IdOfPath(path), options.reading));
    paths.push_back(path);
    opened.push_back(std::move(input));
  }
  return std::unique_ptr<BatchSource>(
      std::make_unique<Batch>(std::move(paths), std::move(opened), shard));
}

}  // namespace lyrefit
