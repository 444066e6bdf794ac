#include "lyrefit/read/curve_files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <vector>

#include "lyrefit/read/table_curve.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

using Paths = std::vector<fs::path>;

bool SameButForCase(const std::string& a, const std::string& b) {
  const auto same = [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

fs::path FolderOf(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

bool IsSameFolder(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return fs::equivalent(a, b, error) && !error;
}

bool IsSame(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::exists(a, error) && fs::exists(b, error)) return fs::equivalent(a, b, error);
  const fs::path one = a.lexically_normal();
  const fs::path other = b.lexically_normal();
  return SameButForCase(one.filename().string(), other.filename().string()) &&
         IsSameFolder(FolderOf(one), FolderOf(other));
}

bool IsAmong(const fs::path& file, const Paths& paths) {
  return std::any_of(paths.begin(), paths.end(),
                     [&](const fs::path& path) { return IsSame(file, path); });
}

void AddBounds(const fs::path& folder, Paths* paths) {
  for (const char* name : {"bounds-paper.json", "bounds-literature.json"}) {
    paths->push_back(folder / name);
  }
}

// Files that are read together with a table.
Paths BesideTable(const fs::path& table) {
  const fs::path folder = FolderOf(table);
  Paths paths = {fs::path(table).replace_extension(".json"),
                 folder / (table.stem().string() + "-index.csv")};
  if (table.filename() == kCurvesName) {
    paths.push_back(folder / kIndexName);
    paths.push_back(folder / kDatasetName);
  }
  AddBounds(folder, &paths);
  return paths;
}

FileRole RoleOfTable(const fs::path& file, const fs::path& table) {
  if (IsSame(file, table)) return FileRole::kRead;
  if (IsAmong(file, BesideTable(table))) return FileRole::kConditions;
  // The conditions may also be beside the target of a symbolic link.
  std::error_code error;
  const fs::path target = fs::canonical(table, error);
  return !error && IsAmong(file, BesideTable(target)) ? FileRole::kConditions : FileRole::kNone;
}

FileRole RoleInFolder(const fs::path& file, const fs::path& folder) {
  if (IsFile(folder / kCurvesName)) return RoleOfTable(file, folder / kCurvesName);
  if (const fs::path one = CurveInFolder(folder); !one.empty()) return RoleOfTable(file, one);
  for (const fs::path& table : TablesIn(folder)) {
    const FileRole role = RoleOfTable(file, table);
    if (role != FileRole::kNone) return role;
  }
  if (IsAmong(file, {folder / kIndexName, folder / kDatasetName})) return FileRole::kConditions;
  const bool inside = IsSameFolder(FolderOf(file), folder);
  return inside && IsTable(file) ? FileRole::kNewCurve : FileRole::kNone;
}

}  // namespace

bool IsSameFile(const std::string& a, const std::string& b) { return IsSame(a, b); }

FileRole RoleOf(const std::string& file, const std::string& input) {
  if (IsFolder(input)) return RoleInFolder(file, fs::path(input) / "");
  if (!IsFile(input)) return FileRole::kNone;
  if (IsSame(file, input)) return FileRole::kRead;
  return IsJson(input) ? FileRole::kNone : RoleOfTable(file, input);
}

}  // namespace lyrefit
