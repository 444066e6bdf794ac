#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lyrefit {

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

}  // namespace lyrefit
