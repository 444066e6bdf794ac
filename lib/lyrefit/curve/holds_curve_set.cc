#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "lyrefit/base/byte_input.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/curve_text.h"
#include "lyrefit/curve/json_curves.h"
#include "lyrefit/curve/json_text.h"
#include "lyrefit/curve/read_ivcurves_json.h"
#include "lyrefit/curve/read_table.h"
#include "lyrefit/curve/select_sweep.h"
#include "lyrefit/curve/table_curve.h"
#include "lyrefit/curve/table_layout.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

bool FolderHoldsSet(const fs::path& folder) {
  if (IsFile(folder / kCurvesName)) return true;
  return CurveInFolder(folder).empty() && !TablesIn(folder).empty();
}

bool JsonHoldsSet(const std::string& text, const std::string& path, const ReadOptions& options) {
  const auto document = ParseJson(text, path);
  if (!document) return false;
  if (!IsIvCurves(*document)) {
    const auto curves = FindJsonCurves(*document, path, options);
    return curves && curves->size() > 1;
  }
  const auto list = document->find("IV Curves");
  return list->is_array() && list->size() > 1;
}

bool TableHoldsSet(const std::string& text, const fs::path& path, const ReadOptions& options) {
  ReadOptions first = options;
  if (first.column.empty()) first.column = "1";
  const auto layout = FindTableLayout(text, path.string(), first);
  if (!layout) return false;
  if (layout->channels.size() > 1 && options.column.empty()) return true;
  const auto table = ReadTable(text, path.string(), options, BrokenRows::kSetAside);
  if (!table) return false;
  std::set<int> numbers(table->curve.sweep.begin(), table->curve.sweep.end());
  for (const auto& broken : table->broken) numbers.insert(broken.first);
  if (numbers.size() < 2) return false;
  const fs::path index = path.parent_path() / (path.stem().string() + "-index.csv");
  return table->holds_curves || IsFile(index) || SweepsDifferInConditions(table->curve);
}

}  // namespace

bool HoldsCurveSet(const std::string& path, const ReadOptions& options) {
  if (IsFolder(path)) return FolderHoldsSet(path);
  if (IsStream(path)) return false;  // reading a pipe would consume its content
  const auto text = ReadDecodedFile(path, options.largest_file_bytes);
  if (!text) return false;
  return IsJson(path) ? JsonHoldsSet(text->text, path, options)
                      : TableHoldsSet(text->text, path, options);
}

bool TextHoldsCurveSet(const DecodedText& text, const std::string& path,
                       const ReadOptions& options) {
  return ParseJson(text.text, path) ? JsonHoldsSet(text.text, path, options)
                                    : TableHoldsSet(text.text, path, options);
}

CurveSet SetOfOne(IvCurve curve) {
  CurveSet set;
  set.name = curve.name;
  set.source = curve.source;
  set.curves.push_back(std::move(curve));
  return set;
}

}  // namespace lyrefit
