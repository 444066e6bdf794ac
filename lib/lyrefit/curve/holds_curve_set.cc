#include <filesystem>
#include <set>

#include "lyrefit/base/file.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/json_text.h"
#include "lyrefit/curve/read_table.h"
#include "lyrefit/curve/select_sweep.h"
#include "lyrefit/curve/table_curve.h"
#include "lyrefit/curve/table_layout.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

bool FolderHoldsSet(const fs::path& folder) {
  if (IsFile(folder / kCurvesName)) return true;
  return !IsFile(folder / "curve.csv") && !TablesIn(folder).empty();
}

bool JsonHoldsSet(const std::string& text, const std::string& path) {
  const auto document = ParseJson(text, path);
  if (!document || !document->is_object()) return false;
  const auto list = document->find("IV Curves");
  return list != document->end() && list->is_array() && list->size() > 1;
}

bool TableHoldsSet(const std::string& text, const fs::path& path) {
  // Most tables hold one curve: their header says so.
  const auto layout = FindTableLayout(text, path.string());
  if (!layout || layout->sweep == kNoColumn) return false;
  const auto table = ReadTable(text, path.string(), BrokenRows::kSetAside);
  if (!table) return false;
  std::set<int> numbers(table->curve.sweep.begin(), table->curve.sweep.end());
  for (const auto& broken : table->broken) numbers.insert(broken.first);
  if (numbers.size() < 2) return false;
  const fs::path index = path.parent_path() / (path.stem().string() + "-index.csv");
  return table->holds_curves || IsFile(index) || SweepsDifferInConditions(table->curve);
}

}  // namespace

bool HoldsCurveSet(const std::string& path) {
  if (IsFolder(path)) return FolderHoldsSet(path);
  const auto text = ReadTextFile(path, ReadOptions().largest_file_bytes);
  if (!text) return false;
  return IsJson(path) ? JsonHoldsSet(*text, path) : TableHoldsSet(*text, path);
}

}  // namespace lyrefit
