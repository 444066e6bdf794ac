#include "lyrefit/curve/read_curve.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "lyrefit/base/byte_input.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/curve_text.h"
#include "lyrefit/curve/json_curves.h"
#include "lyrefit/curve/json_text.h"
#include "lyrefit/curve/number_text.h"
#include "lyrefit/curve/read_ivcurves_json.h"
#include "lyrefit/curve/table_curve.h"
#include "lyrefit/curve/table_layout.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// A curve of a document and its number: the Index of an ivcurves file, else its place.
struct NumberedCurve {
  std::string number;
  RawCurve raw;
  bool settled = false;  // the reader has determined the conditions
};

Expected<std::vector<NumberedCurve>> CurvesOf(const json& document, const std::string& path,
                                              const ReadOptions& options) {
  std::vector<NumberedCurve> numbered;
  if (IsIvCurves(document)) {
    TRY(std::vector<IvCurvesEntry> entries, ReadIvCurvesEntries(document, path));
    for (IvCurvesEntry& entry : entries) {
      if (!entry.curve) return tl::unexpected(entry.curve.error());
      numbered.push_back({entry.id, {std::move(*entry.curve), {}, false}, true});
    }
    return numbered;
  }
  TRY(std::vector<RawCurve> curves, FindJsonCurves(document, path, options));
  for (RawCurve& raw : curves) {
    const std::string id = raw.curve.name;
    raw.curve.name = fs::path(path).stem().string();
    if (curves.size() > 1 && !id.empty()) raw.curve.name += "_" + id;
    numbered.push_back({std::to_string(numbered.size() + 1), std::move(raw), false});
  }
  return numbered;
}

Expected<IvCurve> FromDocument(const json& document, const std::string& path,
                               const ReadOptions& options) {
  Expected<std::vector<NumberedCurve>> curves = CurvesOf(document, path, options);
  if (!curves) return tl::unexpected(curves.error());
  constexpr std::size_t kLongestList = 200;
  std::string numbers;
  NumberedCurve* chosen = curves->size() == 1 && !options.curve ? &curves->front() : nullptr;
  for (NumberedCurve& curve : *curves) {
    if (options.curve && curve.number == std::to_string(*options.curve)) chosen = &curve;
    if (numbers.size() > kLongestList) continue;
    numbers += (numbers.empty() ? "" : ", ") + curve.number;
    if (!curve.settled) numbers += " " + Quoted(curve.raw.curve.name);
  }
  if (chosen == nullptr && options.curve) {
    return Fail(fmt::format("curve {} was asked for, but the file holds {} curves ({} ...)",
                            *options.curve, curves->size(), numbers),
                path);
  }
  if (chosen == nullptr) {
    return Fail(fmt::format("expected one curve, found {} ({} ...): choose one with --curve INDEX",
                            curves->size(), numbers),
                path);
  }
  if (chosen->settled) return std::move(chosen->raw.curve);
  return FinishCurve(std::move(chosen->raw), options);
}

Expected<IvCurve> ReadFromJson(const std::string& path, const ReadOptions& options) {
  const fs::path table = fs::path(path).replace_extension(".csv");
  const Expected<json> document = ReadJsonFile(path, options);
  Expected<IvCurve> curve =
      document ? FromDocument(*document, path, options) : tl::unexpected(document.error());
  if (curve || curve.error().line != 0 || !IsFile(table)) return curve;
  return Fail(curve.error().message +
                  fmt::format(" (for the curve beside it, name {})", table.filename().string()),
              path);
}

Expected<IvCurve> FromTable(RawCurve raw, const ReadOptions& options) {
  Expected<IvCurve> curve = FinishCurve(std::move(raw), options);
  if (curve && options.curve) curve->name += "_" + std::to_string(*options.curve);
  return curve;
}

Expected<IvCurve> ReadFromTable(const std::string& path, const ReadOptions& options) {
  TRY(RawCurve raw, ReadTableCurve(path, options));
  return FromTable(std::move(raw), options);
}

// The JSON document that the text holds; nullopt if it is no JSON object or array.
std::optional<json> DocumentIn(const DecodedText& text, const std::string& path) {
  Expected<json> document = ParseJson(text.text, path);
  const bool is_json = document && (document->is_object() || document->is_array());
  return is_json ? std::optional<json>(std::move(*document)) : std::nullopt;
}

}  // namespace

Expected<IvCurve> CurveOfFile(const DecodedText& text, const std::string& path,
                              const ReadOptions& options) {
  if (const auto document = DocumentIn(text, path)) return FromDocument(*document, path, options);
  TRY(RawCurve raw, TableCurveOfFile(text, path, options));
  return FromTable(std::move(raw), options);
}

Expected<IvCurve> ReadCurve(const std::string& path, const ReadOptions& options) {
  if (IsFolder(path)) {
    const fs::path inside = CurveInFolder(path);
    if (inside.empty()) {
      return Fail(
          "expected a file, or a folder that holds curve.csv or a table of the folder's own name, "
          "found a folder without it",
          path);
    }
    return ReadFromTable(inside.string(), options);
  }
  if (IsStream(path)) {
    TRY(const DecodedText text, ReadDecodedFile(path, options.largest_file_bytes));
    return CurveOfFile(text, path, options);
  }
  return IsJson(path) ? ReadFromJson(path, options) : ReadFromTable(path, options);
}

Expected<IvCurve> ReadCurveText(std::string text, const std::string& name,
                                const ReadOptions& options) {
  TRY(const DecodedText decoded, DecodeText(std::move(text), name));
  if (const auto document = DocumentIn(decoded, name)) {
    return FromDocument(*document, name, options);
  }
  TRY(RawCurve raw, TableCurveFromText(decoded, name, options));
  raw.curve.name = name;
  raw.curve.source = name;
  return FinishCurve(std::move(raw), options);
}

Expected<std::vector<ColumnNote>> ListColumns(const std::string& path, const ReadOptions& options) {
  const fs::path inside = IsFolder(path) ? CurveInFolder(path) : fs::path(path);
  if (inside.empty()) return Fail("expected a file, found a folder", path);
  TRY(const DecodedText text, ReadDecodedFile(inside.string(), options.largest_file_bytes));
  return ListTableColumns(text.text, inside.string(), options);
}

}  // namespace lyrefit
