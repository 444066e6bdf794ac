#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "lyrefit/base/try.h"
#include "lyrefit/read/table_curve.h"
#include "lyrefit/stream/batch_input.h"
#include "lyrefit/stream/folder_tree.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

// A file has one byte more than its size, so that empty files have a position too.
std::int64_t WeightOf(const TreeFile& file) { return file.size + 1; }

class TreeInput : public BatchInput {
 public:
  TreeInput(const std::string& folder, std::string prefix, const ReadOptions& options)
      : folder_(folder), prefix_(std::move(prefix)), options_(options), tree_(folder) {
    FolderTree all(folder);
    while (const auto file = all.Next()) {
      size_ += WeightOf(*file);
      ++count_;
    }
    others_ = all.others();
  }

  std::int64_t count() const { return count_; }

  Expected<std::optional<FoundCurve>> Next() override {
    if (several_) {
      TRY(auto found, several_->Next());
      if (found) return Placed(std::move(*found));
      several_.reset();
    }
    at_ += weight_;
    weight_ = 0;
    const std::optional<TreeFile> file = tree_.Next();
    if (!file) return std::optional<FoundCurve>();
    weight_ = WeightOf(*file);
    path_ = file->path;
    id_ = prefix_ + (prefix_.empty() || file->id.empty() ? "" : "/") + file->id;
    const bool whole = options_.whole_files || !file->refusal.empty();
    if (!whole && (options_.whole_cells || HoldsSeveral())) {
      TRY(several_, OpenInput(path_, id_, options_));
      return Next();
    }
    FoundCurve found;
    found.id = id_;
    found.end = weight_;
    if (!file->refusal.empty()) found.error = Error{file->refusal, path_};
    return Placed(std::move(found));
  }

  BatchCurve Read(const BatchItem& item) const override {
    if (options_.whole_files) return {item.id, IvCurve(), {}, {}, item.where};
    return {item.id, ReadCurve(item.where, options_), {}};
  }

  std::int64_t size() const override { return size_ + 1; }

  Expected<void> AddTo(ByteSum* sum, std::int64_t until) const override {
    FolderTree tree(folder_);
    std::int64_t at = 0;
    while (const auto file = tree.Next()) {
      if (at >= until) return {};
      at += WeightOf(*file);
      sum->Add(fmt::format("{} {} {}\n", file->id, file->size, file->refusal));
      if (!file->refusal.empty()) continue;
      AddBytes(file->path, file->size, sum);
      const std::string sidecar = fs::path(file->path).replace_extension(".json").string();
      if (sidecar != file->path && IsFile(sidecar)) {
        sum->Add("sidecar\n");
        AddBytes(sidecar, SizeOfFile(sidecar), sum);
      }
    }
    return {};
  }

  void AddRemarks(std::vector<std::string>* remarks) const override {
    if (others_.empty()) return;
    int files = 0;
    std::string endings;
    for (const auto& [ending, count] : others_) {
      files += count;
      endings += fmt::format("{}{} {}", endings.empty() ? "" : ", ", count,
                             ending.empty() ? "without an ending" : ending);
    }
    remarks->push_back(fmt::format("{}: {} file{} of other kinds left aside ({})", folder_, files,
                                   files == 1 ? "" : "s", endings));
  }

 private:
  // Whether the present file has more than one curve. A file that cannot be read has its error as
  // one.
  bool HoldsSeveral() const {
    const auto input = OpenInput(path_, id_, options_);
    for (int i = 0; i < 2; ++i) {
      const auto found = input ? (*input)->Next() : std::nullopt;
      if (!found || !*found) return false;
    }
    return true;
  }

  // A curve of the present file, with its position in the tree.
  std::optional<FoundCurve> Placed(FoundCurve found) {
    if (found.id.empty()) {
      found.unnamed = true;
      found.id = fmt::format("{}:{}", id_, found.line);
    } else if (found.stated) {
      found.id = id_ + "/" + found.id;
    }
    found.begin += at_;
    found.end += at_;
    found.file = path_;
    found.reader = several_;
    return found;
  }

  // Adds a file to the checksum. A file that cannot be read is a broken row, and its error message
  // is added instead.
  static void AddBytes(const std::string& path, std::int64_t size, ByteSum* sum) {
    if (const auto added = sum->AddFile(path, size); !added) sum->Add(added.error().message + "\n");
  }

  const std::string folder_;
  const std::string prefix_;
  const ReadOptions options_;
  FolderTree tree_;
  std::map<std::string, int> others_;
  std::int64_t size_ = 0;
  std::int64_t count_ = 0;
  std::int64_t at_ = 0;  // position of the present file
  std::int64_t weight_ = 0;
  std::string path_;
  std::string id_;
  std::shared_ptr<BatchInput> several_;  // the present file, if it has several curves
};

}  // namespace

Expected<std::unique_ptr<BatchInput>> FolderTreeInput(const std::string& folder,
                                                      const std::string& name,
                                                      const ReadOptions& options) {
  auto tree = std::make_unique<TreeInput>(folder, name, options);
  if (tree->count() == 0) {
    return Fail("expected tables (.csv, .tsv, .txt, ...) in the folder or below, found none",
                folder);
  }
  return std::unique_ptr<BatchInput>(std::move(tree));
}

}  // namespace lyrefit
