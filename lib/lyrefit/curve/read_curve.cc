#include "lyrefit/curve/read_curve.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "lyrefit/curve/settle_conditions.h"
#include "lyrefit/curve/sidecar.h"
#include "lyrefit/curve/table_curve.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

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
  Expected<IvCurve> curve = ReadTableCurve(path, options);
  if (!curve) return curve;
  const Expected<Sidecar> sidecar = ReadSidecarBeside(path, options);
  if (!sidecar) return tl::unexpected(sidecar.error());
  SettleConditions(*sidecar, &*curve);
  if (options.curve) curve->name += "_" + std::to_string(*options.curve);
  if (auto valid = Validate(*curve); !valid) return Fail(valid.error().message, path);
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
