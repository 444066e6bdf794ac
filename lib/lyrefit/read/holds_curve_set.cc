#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "lyrefit/base/byte_input.h"
#include "lyrefit/read/curve_text.h"
#include "lyrefit/read/json_curves.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/read/key_point_table.h"
#include "lyrefit/read/multi_flash.h"
#include "lyrefit/read/read_curve_set.h"
#include "lyrefit/read/read_ivcurves_json.h"
#include "lyrefit/read/read_table.h"
#include "lyrefit/read/rewrite_table.h"
#include "lyrefit/read/select_sweep.h"
#include "lyrefit/read/table_curve.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

bool FolderHoldsSet(const fs::path& folder) {
  if (IsFile(folder / kCurvesName)) return true;
  return CurveInFolder(folder).empty() && !TablesIn(folder).empty();
}

bool JsonHoldsSet(const nlohmann::json& document, const std::string& path,
                  const ReadOptions& options) {
  if (!IsIvCurves(document)) {
    const auto curves = FindJsonCurves(document, path, options);
    return curves && curves->size() > 1;
  }
  const auto list = document.find("IV Curves");
  return list->is_array() && list->size() > 1;
}

bool TableHoldsSet(const std::string& text, const fs::path& path, const ReadOptions& options) {
  const auto tables = ReadTables(text, path.string(), options, BrokenRows::kSetAside);
  if (!tables) return HoldsKeyPoints(text, path.string());
  if (tables->size() > 1) return true;
  const Table* const table = &tables->front();
  if (table->error) return false;
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
  return text && TextHoldsCurveSet(*text, path, options);
}

bool TextHoldsCurveSet(const DecodedText& text, const std::string& path,
                       const ReadOptions& options) {
  const auto document = DocumentIn(text.text, path);
  if (!document) return false;
  if (IsMultiFlash(text.text)) return true;
  return *document ? JsonHoldsSet(**document, path, options)
                   : TableHoldsSet(RewriteTable(text).text, path, options);
}

}  // namespace lyrefit
