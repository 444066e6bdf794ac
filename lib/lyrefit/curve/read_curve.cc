#include "lyrefit/curve/read_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "lyrefit/base/file.h"
#include "lyrefit/curve/current_sign.h"
#include "lyrefit/curve/read_table.h"
#include "lyrefit/curve/select_sweep.h"
#include "lyrefit/curve/settle_conditions.h"
#include "lyrefit/curve/sidecar.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

bool IsJson(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return extension == ".json";
}

bool IsFile(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error) && !fs::is_directory(path, error);
}

bool IsFolder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

// "curve.csv" is named after its folder.
std::string NameOf(const fs::path& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  const std::string folder = absolute.parent_path().filename().string();
  return path.filename() == "curve.csv" && !folder.empty() ? folder : path.stem().string();
}

Expected<IvCurve> ReadFromIvCurvesJson(const std::string& path, const ReadOptions& options) {
  const fs::path table = fs::path(path).replace_extension(".csv");
  Expected<std::vector<IvCurve>> curves = ReadIvCurvesJson(path, options);
  if (!curves) {
    Error error = curves.error();
    if (error.line == 0 && IsFile(table)) {
      error.message +=
          fmt::format(" (for the curve beside it, name {})", table.filename().string());
    }
    return tl::unexpected(std::move(error));
  }
  std::string numbers;
  for (IvCurve& curve : *curves) {
    // The reader names every curve FILE_INDEX.
    const std::string index = curve.name.substr(curve.name.rfind('_') + 1);
    if (options.curve && index == std::to_string(*options.curve)) return std::move(curve);
    if (numbers.size() < 40) numbers += (numbers.empty() ? "" : ", ") + index;
  }
  if (options.curve) {
    return Fail(fmt::format("curve {} was asked for, but the file holds {} curves ({} ...)",
                            *options.curve, curves->size(), numbers),
                path);
  }
  if (curves->size() == 1) return std::move(curves->front());
  return Fail(fmt::format("expected one curve, found {} ({} ...): choose one with --curve INDEX",
                          curves->size(), numbers),
              path);
}

Expected<IvCurve> ReadFromTable(const std::string& path, const ReadOptions& options) {
  const Expected<std::string> text = ReadTextFile(path, options.largest_file_bytes);
  if (!text) return tl::unexpected(text.error());
  Expected<Table> table = ReadTable(*text, path);
  if (!table) return tl::unexpected(table.error());
  IvCurve curve = std::move(table->curve);
  curve.source = path;
  curve.name = NameOf(path);
  if (auto selected = SelectSweep(options.curve, table->holds_curves, &curve); !selected) {
    return Fail(selected.error().message, path);
  }
  TurnLoadSign(&curve);
  Sidecar sidecar;
  const fs::path sidecar_path = fs::path(path).replace_extension(".json");
  if (IsFile(sidecar_path)) {
    Expected<Sidecar> read = ReadSidecar(sidecar_path.string(), options.largest_file_bytes);
    if (!read) return tl::unexpected(read.error());
    sidecar = std::move(*read);
  }
  SettleConditions(sidecar, &curve);
  if (options.curve) curve.name += "_" + std::to_string(*options.curve);
  if (auto valid = Validate(curve); !valid) return Fail(valid.error().message, path);
  return curve;
}

}  // namespace

Expected<IvCurve> ReadCurve(const std::string& path, const ReadOptions& options) {
  if (IsFolder(path)) {
    const fs::path inside = fs::path(path) / "curve.csv";
    if (!IsFile(inside)) {
      return Fail("expected a file, or a folder that holds curve.csv, found a folder without it",
                  path);
    }
    return ReadFromTable(inside.lexically_normal().string(), options);
  }
  return IsJson(path) ? ReadFromIvCurvesJson(path, options) : ReadFromTable(path, options);
}

}  // namespace lyrefit
