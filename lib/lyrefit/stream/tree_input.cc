#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/read/table_curve.h"
#include "lyrefit/stream/batch_input.h"
#include "lyrefit/stream/natural_order.h"

namespace lyrefit {
namespace {

// A table of a folder tree, or an unreadable part of the tree.
struct TreeFile {
  std::string path;
  std::string id;  // path below the top folder, without its ending
  std::int64_t size = 0;
  std::string refusal;  // reason why it is not a readable file; empty: it is
};

// The tables below a folder in natural order of their paths. Hidden files, indexes, sidecars and
// other files are left out. Memory: the names of one folder for each level.
class FolderTree {
 public:
  explicit FolderTree(std::string top);

  std::optional<TreeFile> Next();

  // Number of ignored files for each ending.
  const std::map<std::string, int>& others() const { return others_; }

 private:
  struct Entry {
    std::string name;
    bool folder = false;
    std::int64_t size = 0;
    std::string refusal;
  };
  struct Level {
    std::string path;
    std::string id;
    std::pair<std::uint64_t, std::uint64_t> file_id;  // device and inode
    std::vector<Entry> entries;                       // next entry last
  };

  // Lists a folder. Returns the reason if that fails, else an empty text.
  std::string Enter(const std::string& path, const std::string& id);
  void TakeEntries(Level* level, std::string* refusal);

  std::vector<Level> levels_;
  std::map<std::string, int> others_;
  std::optional<TreeFile> first_;
};

namespace fs = std::filesystem;

std::string StemOfName(const std::string& name) { return fs::path(name).stem().string(); }

std::string EndingOf(const std::string& name) {
  return LowerCase(fs::path(name).extension().string());
}

// Excel workbooks count as curves, so that the user gets the error message of their reader.
bool IsWorkbook(const std::string& name) {
  const std::string ending = EndingOf(name);
  return ending == ".xlsx" || ending == ".xls";
}

bool EndsWith(const std::string& text, std::string_view end) {
  return text.size() >= end.size() &&
         std::string_view(text).substr(text.size() - end.size()) == end;
}

// True for the names of known files that describe curves but are none.
bool IsAboutCurves(const std::string& name) {
  const std::string lower = LowerCase(name);
  return name == kIndexName || name == kDatasetName || EndsWith(name, "-index.csv") ||
         name == "bounds-paper.json" || name == "bounds-literature.json" ||
         StemOfName(lower) == "readme";
}

std::string Below(const std::string& id, const std::string& name) {
  return id.empty() ? name : id + "/" + name;
}

FolderTree::FolderTree(std::string top) {
  while (top.size() > 1 && top.back() == '/') top.pop_back();
  const std::string refusal = Enter(top, "");
  if (!refusal.empty()) first_ = TreeFile{top, "", 0, refusal};
}

void FolderTree::TakeEntries(Level* level, std::string* refusal) {
  std::error_code error;
  std::vector<Entry>& entries = level->entries;
  fs::directory_iterator at(level->path, error);
  for (; !error && at != fs::directory_iterator(); at.increment(error)) {
    Entry entry;
    entry.name = at->path().filename().string();
    if (entry.name.front() == '.') continue;
    std::error_code other;
    const fs::file_status status = at->status(other);
    entry.folder = fs::is_directory(status);
    if (!entry.folder && !fs::exists(status)) entry.refusal = "the link leads nowhere";
    if (fs::is_other(status)) {
      entry.refusal = "expected a file, found a pipe, a socket or a device";
    }
    if (fs::is_regular_file(status)) {
      entry.size = static_cast<std::int64_t>(at->file_size(other));
    }
    entries.push_back(std::move(entry));
  }
  if (error) *refusal = "cannot read the folder: " + error.message();
}

std::string FolderTree::Enter(const std::string& path, const std::string& id) {
  struct stat facts = {};
  if (::stat(path.c_str(), &facts) != 0) {
    return "cannot read the folder: " + std::generic_category().message(errno);
  }
  Level level{path, id, {facts.st_dev, facts.st_ino}, {}};
  for (const Level& above : levels_) {
    if (above.file_id == level.file_id) {
      return "the folder is a link that leads back to " + above.path;
    }
  }
  std::string refusal;
  TakeEntries(&level, &refusal);
  if (!refusal.empty()) return refusal;
  std::set<std::string> tables;
  for (const Entry& entry : level.entries) {
    if (!entry.folder && IsTable(entry.name)) tables.insert(StemOfName(entry.name));
  }
  std::vector<Entry> kept;
  for (Entry& entry : level.entries) {
    const bool json = IsJson(entry.name);
    const bool sidecar = json && tables.count(StemOfName(entry.name)) != 0;
    const bool curve = (IsTable(entry.name) || json || IsWorkbook(entry.name)) && !sidecar &&
                       !IsAboutCurves(entry.name);
    if (entry.folder || curve) {
      kept.push_back(std::move(entry));
    } else if (!sidecar && !IsAboutCurves(entry.name)) {
      ++others_[EndingOf(entry.name)];
    }
  }
  std::sort(kept.begin(), kept.end(),
            [](const Entry& a, const Entry& b) { return NaturalLess(b.name, a.name); });
  level.entries = std::move(kept);
  levels_.push_back(std::move(level));
  return "";
}

std::optional<TreeFile> FolderTree::Next() {
  if (first_) return std::exchange(first_, std::nullopt);
  while (!levels_.empty()) {
    if (levels_.back().entries.empty()) {
      levels_.pop_back();
      continue;
    }
    const Entry entry = std::move(levels_.back().entries.back());
    levels_.back().entries.pop_back();
    const std::string path = levels_.back().path + "/" + entry.name;
    if (!entry.folder) {
      const std::string id = entry.name == "curve.csv"
                                 ? levels_.back().id
                                 : Below(levels_.back().id, StemOfName(entry.name));
      return TreeFile{path, id, entry.size, entry.refusal};
    }
    const std::string id = Below(levels_.back().id, entry.name);
    const std::string refusal = Enter(path, id);
    if (!refusal.empty()) return TreeFile{path, id, 0, refusal};
  }
  return std::nullopt;
}

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
