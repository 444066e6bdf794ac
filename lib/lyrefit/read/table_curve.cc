#include "lyrefit/read/table_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "lyrefit/base/byte_input.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/plausibility.h"
#include "lyrefit/curve/sweep_order.h"
#include "lyrefit/read/read_table.h"
#include "lyrefit/read/rewrite_table.h"
#include "lyrefit/read/settle_conditions.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

std::string ExtensionOf(const fs::path& path) { return LowerCase(path.extension().string()); }

}  // namespace

bool IsFile(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error) && !fs::is_directory(path, error);
}

Expected<void> CheckIsNoStream(const fs::path& path) {
  if (!IsStream(path.string())) return {};
  return Fail("expected a file, found a pipe, a socket or a device", path.string());
}

bool IsFolder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool IsJson(const fs::path& path) { return ExtensionOf(path) == ".json"; }

bool IsTable(const fs::path& path) {
  const std::string extension = ExtensionOf(path);
  constexpr const char* kEndings[] = {".csv", ".tsv", ".txt", ".dat", ".asc",
                                      ".dta", ".mpt", ".lvm", ".prn", ".mfr"};
  return std::find(std::begin(kEndings), std::end(kEndings), extension) != std::end(kEndings);
}

std::string FolderNameOf(const fs::path& path) {
  std::error_code error;
  return fs::absolute(path, error).lexically_normal().parent_path().filename().string();
}

fs::path CurveInFolder(const fs::path& folder) {
  const fs::path plain = folder / "curve.csv";
  if (IsFile(plain)) return plain.lexically_normal();
  const std::string name = FolderNameOf(plain);
  for (const char* ending : {".csv", ".txt"}) {
    const fs::path own = folder / (name + ending);
    if (!name.empty() && IsFile(own)) return own.lexically_normal();
  }
  return {};
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

bool HoldsTablesBelow(const fs::path& folder) {
  constexpr int kDeepest = 6;
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    if (entry.depth() >= kDeepest) entry.disable_recursion_pending();
    if (entry.depth() > 0 && IsTable(entry->path()) && IsFile(entry->path())) return true;
  }
  return false;
}

Expected<RawCurve> TableCurveFromText(const DecodedText& text, const std::string& path,
                                      const ReadOptions& options) {
  const DecodedText rewritten = RewriteTable(text);
  TRY(Table table, ReadTable(rewritten.text, path, options));
  RawCurve raw;
  raw.curve = std::move(table.curve);
  raw.stated = std::move(table.head);
  raw.per_area = table.per_area;
  TakeSetup(rewritten.setup, "the layout of the file", &raw.stated);
  if (!rewritten.remark.empty()) {
    raw.curve.assumptions.insert(raw.curve.assumptions.begin(), rewritten.remark);
  }
  const bool chosen = table.of_device && options.column.empty();  // --curve chose the device
  const auto wanted = chosen ? std::nullopt : options.curve;
  if (auto selected = SelectSweep(wanted, table.holds_curves, &raw.curve); !selected) {
    return Fail(selected.error().message, path);
  }
  TurnLoadSign(&raw.curve);
  return raw;
}

Expected<RawCurve> ReadTableCurve(const std::string& path, const ReadOptions& options) {
  TRY(const DecodedText text, ReadDecodedFile(path, options.largest_file_bytes));
  return TableCurveOfFile(text, path, options);
}

Expected<RawCurve> TableCurveOfFile(const DecodedText& text, const std::string& path,
                                    const ReadOptions& options) {
  Expected<RawCurve> raw = TableCurveFromText(text, path, options);
  if (!raw) return raw;
  raw->curve.source = path;
  // A table "curve.csv" is named after its folder.
  const fs::path file(path);
  const std::string folder = file.filename() == "curve.csv" ? FolderNameOf(file) : "";
  raw->curve.name = folder.empty() ? file.stem().string() : folder;
  TRY(Sidecar beside, ReadSidecarBeside(path, options));
  raw->stated = MergeHead(std::move(beside), raw->stated);
  return raw;
}

Expected<IvCurve> FinishCurve(RawCurve raw, const ReadOptions& options) {
  IvCurve curve = std::move(raw.curve);
  const std::string source = curve.source;
  if (raw.per_area) {
    auto settled = SettleArea(options, raw.stated, &curve);
    if (!settled) return Fail(settled.error().message, source);
  }
  SettleConditions(raw.stated, &curve);
  if (options.area_cm2) curve.notes.area_cm2 = options.area_cm2;
  if (!options.keep_limited) LeaveOutLimited(&curve);
  if (auto valid = Validate(curve); !valid) return Fail(valid.error().message, source);
  return curve;
}

Expected<Sidecar> ReadSidecarBeside(const std::string& path, const ReadOptions& options) {
  const fs::path sidecar = fs::path(path).replace_extension(".json");
  if (!IsFile(sidecar)) return Sidecar{};
  TRY(CheckIsNoStream(sidecar));
  return ReadSidecar(sidecar.string(), options.largest_file_bytes);
}

namespace {

struct Sweep {
  double first_voltage_V = 0;
  double last_voltage_V = 0;
  double irradiance_sum = 0;
  double temperature_sum = 0;
  int points = 0;

  double irradiance_W_m2() const { return irradiance_sum / points; }
  double temperature_C() const { return temperature_sum / points; }
};

std::map<int, Sweep> Summarise(const IvCurve& curve) {
  std::map<int, Sweep> sweeps;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    Sweep& sweep = sweeps[curve.sweep[i]];
    if (sweep.points++ == 0) sweep.first_voltage_V = curve.voltage_V[i];
    sweep.last_voltage_V = curve.voltage_V[i];
    if (!curve.irradiance_W_m2.empty()) sweep.irradiance_sum += curve.irradiance_W_m2[i];
    if (!curve.temperature_C.empty()) sweep.temperature_sum += curve.temperature_C[i];
  }
  return sweeps;
}

std::string Numbers(const std::map<int, Sweep>& sweeps) {
  constexpr int kShown = 10;
  std::string list;
  int shown = 0;
  for (const auto& [number, sweep] : sweeps) {
    if (shown++ == kShown) return list + ", ... " + std::to_string(sweeps.rbegin()->first);
    list += (list.empty() ? "" : ", ") + std::to_string(number);
  }
  return list;
}

bool SameConditions(const std::map<int, Sweep>& sweeps) {
  const Sweep& first = sweeps.begin()->second;
  return std::all_of(sweeps.begin(), sweeps.end(), [&](const auto& entry) {
    const Sweep& sweep = entry.second;
    const double brighter =
        std::max(std::abs(sweep.irradiance_W_m2()), std::abs(first.irradiance_W_m2()));
    return std::abs(sweep.irradiance_W_m2() - first.irradiance_W_m2()) <= 0.02 * brighter &&
           std::abs(sweep.temperature_C() - first.temperature_C()) <= 1;
  });
}

bool BothDirections(const std::map<int, Sweep>& sweeps) {
  const auto rises = [](const auto& entry) {
    return entry.second.last_voltage_V > entry.second.first_voltage_V;
  };
  const auto falls = [](const auto& entry) {
    return entry.second.last_voltage_V < entry.second.first_voltage_V;
  };
  return std::any_of(sweeps.begin(), sweeps.end(), rises) &&
         std::any_of(sweeps.begin(), sweeps.end(), falls);
}

template <class T>
void KeepRows(const std::vector<bool>& keep, std::vector<T>* values) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values->size(); ++i) {
    if (keep[i]) (*values)[kept++] = (*values)[i];
  }
  values->resize(kept);
}

void KeepSweep(int wanted, IvCurve* curve) {
  std::vector<bool> keep(curve->size());
  for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = curve->sweep[i] == wanted;
  for (auto* column : {&curve->voltage_V, &curve->current_A, &curve->sigma_A, &curve->time_s,
                       &curve->irradiance_W_m2, &curve->temperature_C}) {
    KeepRows(keep, column);
  }
  KeepRows(keep, &curve->sweep);
}

}  // namespace

bool SweepsDifferInConditions(const IvCurve& curve) {
  return !curve.sweep.empty() && !SameConditions(Summarise(curve));
}

Expected<void> SelectSweep(std::optional<int> wanted, bool holds_curves, IvCurve* curve) {
  const char* kind = holds_curves ? "curves" : "sweeps";
  if (curve->sweep.empty()) {
    if (!wanted) return {};
    return Fail(
        fmt::format("curve {} was asked for, but the table has no column sweep or curve", *wanted));
  }
  const std::map<int, Sweep> sweeps = Summarise(*curve);
  if (wanted) {
    if (sweeps.count(*wanted) == 0) {
      return Fail(fmt::format("curve {} was asked for, but the table holds the {} {}", *wanted,
                              kind, Numbers(sweeps)));
    }
    if (sweeps.size() > 1) KeepSweep(*wanted, curve);
    return {};
  }
  if (sweeps.size() == 1) return {};
  std::string reason;
  if (!holds_curves) {
    if (!SameConditions(sweeps)) reason = " at different irradiance or temperature";
    if (reason.empty() && !BothDirections(sweeps)) reason = " in the same direction";
    if (reason.empty()) {
      curve->assumptions.push_back(fmt::format(
          "{} sweeps up and down at the same conditions read as one curve", sweeps.size()));
      return {};
    }
  }
  return Fail(fmt::format("expected one curve, found {} {}{} ({}): choose one with --curve INDEX",
                          sweeps.size(), kind, reason, Numbers(sweeps)));
}

}  // namespace lyrefit
