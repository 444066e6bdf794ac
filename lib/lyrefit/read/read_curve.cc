#include "lyrefit/read/read_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "lyrefit/base/byte_input.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/sweep_order.h"
#include "lyrefit/read/curve_text.h"
#include "lyrefit/read/json_curves.h"
#include "lyrefit/read/json_text.h"
#include "lyrefit/read/key_point_table.h"
#include "lyrefit/read/multi_flash.h"
#include "lyrefit/read/read_curve_set.h"
#include "lyrefit/read/settle_conditions.h"
#include "lyrefit/read/table_curve.h"

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
  TRY(JsonCurves found, FindJsonCurves(document, path, options));
  if (!found.rejected.empty()) return tl::unexpected(found.rejected.front().error);
  for (RawCurve& raw : found.curves) {
    const std::string id = raw.curve.name;
    raw.curve.name = fs::path(path).stem().string();
    if (found.size() > 1 && !id.empty()) raw.curve.name += "_" + id;
    numbered.push_back({std::to_string(numbered.size() + 1), std::move(raw), false});
  }
  return numbered;
}

// The curve that the options name, the only one, or the one at place `usual`.
Expected<IvCurve> ChooseCurve(std::vector<NumberedCurve> curves, std::optional<std::size_t> usual,
                              const std::string& path, const ReadOptions& options) {
  constexpr std::size_t kLongestList = 200;
  std::string numbers;
  if (curves.size() == 1) usual = 0;
  NumberedCurve* chosen = usual && !options.curve ? &curves[*usual] : nullptr;
  for (NumberedCurve& curve : curves) {
    if (options.curve && curve.number == std::to_string(*options.curve)) chosen = &curve;
    if (numbers.size() > kLongestList) continue;
    numbers += (numbers.empty() ? "" : ", ") + curve.number;
    if (!curve.settled) numbers += " " + Quoted(curve.raw.curve.name);
  }
  if (chosen == nullptr && options.curve) {
    return Fail(fmt::format("curve {} was asked for, but the file holds {} curves ({} ...)",
                            *options.curve, curves.size(), numbers),
                path);
  }
  if (chosen == nullptr) {
    return Fail(fmt::format("expected one curve, found {} ({} ...): choose one with --curve INDEX",
                            curves.size(), numbers),
                path);
  }
  if (chosen->settled) return std::move(chosen->raw.curve);
  return FinishCurve(std::move(chosen->raw), options);
}

Expected<IvCurve> FromDocument(const json& document, const std::string& path,
                               const ReadOptions& options) {
  TRY(std::vector<NumberedCurve> curves, CurvesOf(document, path, options));
  return ChooseCurve(std::move(curves), std::nullopt, path, options);
}

// A curve of the file of a multi-flash tester, by default that at the light that the file aims at.
Expected<IvCurve> FromFlashes(const DecodedText& text, const std::string& path,
                              const Sidecar& beside, const ReadOptions& options) {
  TRY(MultiFlash flashes, ReadMultiFlash(text.text, path));
  const std::string name = fs::path(path).stem().string();
  std::string list;
  std::vector<NumberedCurve> numbered;
  for (RawCurve& raw : flashes.curves) {
    const std::string number = std::to_string(numbered.size() + 1);
    list += fmt::format("{}{} {}", list.empty() ? "" : ", ", number, raw.curve.name);
    raw.curve.name = fmt::format("{}_{}", name, raw.curve.name);
    raw.stated = MergeHead(beside, raw.stated);
    numbered.push_back({number, std::move(raw), false});
  }
  for (NumberedCurve& curve : numbered) {
    curve.raw.curve.assumptions.emplace_back(
        fmt::format("one of {} curves, which --curve chooses: {}", numbered.size(), list));
  }
  return ChooseCurve(std::move(numbered), flashes.at_target, path, options);
}

Expected<IvCurve> FromTable(RawCurve raw, const ReadOptions& options) {
  Expected<IvCurve> curve = FinishCurve(std::move(raw), options);
  if (curve && options.curve) curve->name += "_" + std::to_string(*options.curve);
  return curve;
}

// One condition of a table of key points.
Expected<IvCurve> CurveOfKeyPoints(const DecodedText& text, const std::string& path,
                                   const ReadOptions& options) {
  const std::string sidecar = fs::path(path).replace_extension(".json").string();
  TRY(CurveSet set, ReadKeyPoints(text, path, sidecar, options));
  const int count = static_cast<int>(set.curves.size());
  if (options.curve && *options.curve >= 1 && *options.curve <= count) {
    IvCurve curve = std::move(set.curves[*options.curve - 1]);
    curve.assumptions.insert(curve.assumptions.begin(), set.assumptions.begin(),
                             set.assumptions.end());
    return curve;
  }
  return Fail(fmt::format("expected one curve, found the key points of {} conditions (1 {}, ...): "
                          "choose one with --curve INDEX, or fit all with --family pvsyst",
                          count, Quoted(set.curves.front().name)),
              path);
}

}  // namespace

Expected<IvCurve> CurveOfFile(const DecodedText& text, const std::string& path,
                              const ReadOptions& options) {
  TRY(const std::optional<json> document, DocumentIn(text.text, path));
  if (document) {
    Expected<IvCurve> curve = FromDocument(*document, path, options);
    const fs::path table = fs::path(path).replace_extension(".csv");
    if (curve || curve.error().line != 0 || !IsJson(path) || !IsFile(table)) return curve;
    return Fail(curve.error().message +
                    fmt::format(" (for the curve beside it, name {})", table.filename().string()),
                path);
  }
  if (IsMultiFlash(text.text)) {
    TRY(const Sidecar beside, ReadSidecarBeside(path, options));
    return FromFlashes(text, path, beside, options);
  }
  Expected<RawCurve> raw = TableCurveOfFile(text, path, options);
  if (!raw && HoldsKeyPoints(text.text, path)) return CurveOfKeyPoints(text, path, options);
  if (!raw) return tl::unexpected(raw.error());
  return FromTable(std::move(*raw), options);
}

Expected<IvCurve> ReadCurve(const std::string& path, const ReadOptions& options) {
  const fs::path file = IsFolder(path) ? CurveInFolder(path) : fs::path(path);
  if (file.empty()) {
    return Fail(
        "expected a file, or a folder that holds curve.csv or a table of the folder's own name, "
        "found a folder without it" +
            std::string(HoldsTablesBelow(path) ? "; many curves in folders of folders are for "
                                                 "lyrefit batch"
                                               : ""),
        path);
  }
  TRY(const DecodedText text, ReadDecodedFile(file.string(), options.largest_file_bytes));
  return CurveOfFile(text, file.string(), options);
}

Expected<IvCurve> ReadCurveText(std::string text, const std::string& name,
                                const ReadOptions& options) {
  TRY(const DecodedText decoded, DecodeText(std::move(text), name));
  TRY(const std::optional<json> document, DocumentIn(decoded.text, name));
  if (document) return FromDocument(*document, name, options);
  if (IsMultiFlash(decoded.text)) return FromFlashes(decoded, name, {}, options);
  Expected<RawCurve> read = TableCurveFromText(decoded, name, options);
  if (!read && HoldsKeyPoints(decoded.text, name)) return CurveOfKeyPoints(decoded, name, options);
  TRY(RawCurve raw, std::move(read));
  raw.curve.name = name;
  raw.curve.source = name;
  return FinishCurve(std::move(raw), options);
}

namespace {

bool UnderSameConditions(const IvCurve& a, const IvCurve& b) {
  const double light = std::max(a.conditions.irradiance_W_m2, b.conditions.irradiance_W_m2);
  return a.conditions.cells_in_series == b.conditions.cells_in_series &&
         std::fabs(a.conditions.irradiance_W_m2 - b.conditions.irradiance_W_m2) <= 0.02 * light &&
         std::fabs(a.conditions.cell_temperature_K - b.conditions.cell_temperature_K) <= 1;
}

// Whether the curves are sweeps in both directions under the same conditions.
bool AreSweeps(const std::vector<IvCurve>& curves) {
  bool up = false, down = false;
  for (const IvCurve& curve : curves) {
    if (curve.suns_voc_A || !UnderSameConditions(curve, curves.front())) return false;
    (Rises(curve.voltage_V) ? up : down) = true;
  }
  return up && down;
}

// Joins sweeps, one after the other, to one curve.
IvCurve JoinSweeps(const std::vector<IvCurve>& curves) {
  IvCurve joined = curves.front();
  joined.sweep.clear();
  joined.irradiance_W_m2.clear();
  joined.temperature_C.clear();
  for (std::size_t c = 1; c < curves.size(); ++c) {
    AppendSweep(curves[c], &joined);
    joined.name += " + " + curves[c].name;
  }
  joined.assumptions.push_back(
      "the sweeps follow each other in the order of the files, reading by reading at one pace");
  return joined;
}

}  // namespace

Expected<CurveSet> ReadMeasurement(const std::string& path, const ReadOptions& options) {
  if (IsFolder(path)) {
    if (HoldsCurveSet(path, options)) return ReadCurveSet(path, options);
    TRY(IvCurve curve, ReadCurve(path, options));
    return SetOfOne(std::move(curve));
  }
  TRY(const DecodedText text, ReadDecodedFile(path, options.largest_file_bytes));
  if (TextHoldsCurveSet(text, path, options)) return CurveSetOfFile(text, path, options);
  TRY(IvCurve curve, CurveOfFile(text, path, options));
  return SetOfOne(std::move(curve));
}

Expected<CurveSet> ReadMeasurement(const std::vector<std::string>& paths,
                                   const ReadOptions& options) {
  CurveSet all;
  for (const std::string& path : paths) {
    TRY(CurveSet set, ReadMeasurement(path, options));
    all.name += (all.name.empty() ? "" : " + ") + set.name;
    all.several_devices = all.several_devices || set.several_devices;
    all.source += (all.source.empty() ? "" : ", ") + set.source;
    for (IvCurve& curve : set.curves) all.curves.push_back(std::move(curve));
    for (RejectedCurve& bad : set.rejected) all.rejected.push_back(std::move(bad));
  }
  if (all.curves.size() > 1 && AreSweeps(all.curves)) all.curves = {JoinSweeps(all.curves)};
  return all;
}

}  // namespace lyrefit
