#include "lyrefit/stream/folder_tree.h"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>

#include "lyrefit/base/number_text.h"
#include "lyrefit/read/table_curve.h"
#include "lyrefit/stream/natural_order.h"

namespace lyrefit {
namespace {

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

}  // namespace

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

}  // namespace lyrefit
