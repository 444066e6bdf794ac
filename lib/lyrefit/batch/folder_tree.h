#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lyrefit {

// A table of a folder tree, or a part of the tree that cannot be looked into.
struct TreeFile {
  std::string path;
  std::string id;  // the path below the top, without its ending
  std::int64_t size = 0;
  std::string refusal;  // why it is no file
};

// The tables below a folder in natural order of their paths, hidden ones, indexes, sidecars and
// other things left out. Holds the names of one folder a level at a time.
class FolderTree {
 public:
  explicit FolderTree(std::string top);

  std::optional<TreeFile> Next();

  // How many other files were passed by, by their endings.
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
    std::vector<Entry> entries;                       // the last one comes next
  };

  // Looks into a folder; why that cannot be done, else empty.
  std::string Enter(const std::string& path, const std::string& id);
  void TakeEntries(Level* level, std::string* refusal);

  std::vector<Level> levels_;
  std::map<std::string, int> others_;
  std::optional<TreeFile> first_;
};

}  // namespace lyrefit
