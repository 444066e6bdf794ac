#include "lyrefit/curve/table_curve.h"

#include <algorithm>
#include <utility>

#include "lyrefit/base/file.h"
#include "lyrefit/curve/current_sign.h"
#include "lyrefit/curve/read_table.h"
#include "lyrefit/curve/select_sweep.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

std::string ExtensionOf(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return extension;
}

}  // namespace

bool IsFile(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error) && !fs::is_directory(path, error);
}

bool IsFolder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool IsJson(const fs::path& path) { return ExtensionOf(path) == ".json"; }

bool IsTable(const fs::path& path) {
  const std::string extension = ExtensionOf(path);
  return extension == ".csv" || extension == ".tsv" || extension == ".txt";
}

std::string FolderNameOf(const fs::path& path) {
  std::error_code error;
  return fs::absolute(path, error).lexically_normal().parent_path().filename().string();
}

std::vector<fs::path> TablesIn(const fs::path& folder) {
  std::vector<fs::path> tables;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const fs::path& path = entry->path();
    const bool hidden = path.filename().string().front() == '.';
    const bool is_curve = IsTable(path) && !hidden && path.filename() != kIndexName;
    if (is_curve && IsFile(path)) tables.push_back(path.lexically_normal());
  }
  std::sort(tables.begin(), tables.end());
  return tables;
}

Expected<IvCurve> ReadTableCurve(const std::string& path, const ReadOptions& options) {
  const Expected<std::string> text = ReadTextFile(path, options.largest_file_bytes);
  if (!text) return tl::unexpected(text.error());
  Expected<Table> table = ReadTable(*text, path);
  if (!table) return tl::unexpected(table.error());
  IvCurve curve = std::move(table->curve);
  curve.source = path;
  // "curve.csv" is named after its folder.
  const fs::path file(path);
  const std::string folder = file.filename() == "curve.csv" ? FolderNameOf(file) : "";
  curve.name = folder.empty() ? file.stem().string() : folder;
  if (auto selected = SelectSweep(options.curve, table->holds_curves, &curve); !selected) {
    return Fail(selected.error().message, path);
  }
  TurnLoadSign(&curve);
  return curve;
}

Expected<Sidecar> ReadSidecarBeside(const std::string& path, const ReadOptions& options) {
  const fs::path sidecar = fs::path(path).replace_extension(".json");
  if (!IsFile(sidecar)) return Sidecar{};
  return ReadSidecar(sidecar.string(), options.largest_file_bytes);
}

}  // namespace lyrefit
