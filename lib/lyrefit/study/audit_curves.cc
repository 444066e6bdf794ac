#include "lyrefit/study/audit_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "lyrefit/base/number_text.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/table_curve.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostCurves = 200;  // limit for the curves read from all places

bool Exists(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

double ShortCircuitCurrent(const IvCurve& curve) {
  const double isc = FindKeyPoints(curve.voltage_V, curve.current_A).short_circuit_current_A;
  return std::isnan(isc) ? *std::max_element(curve.current_A.begin(), curve.current_A.end()) : isc;
}

AuditCurve Shelve(IvCurve curve, const fs::path& path) {
  AuditCurve shelved;
  shelved.points = MakePointSet(curve.voltage_V, curve.current_A);
  shelved.short_circuit_A = ShortCircuitCurrent(curve);
  shelved.path = path.lexically_normal().string();
  shelved.folder = (IsFolder(path) ? path : path.parent_path()).string();
  shelved.curve = std::move(curve);
  return shelved;
}

// Position of the curve on the shelf that was read from this file or folder.
std::optional<int> PositionOf(const fs::path& path, const AuditShelf& shelf) {
  for (std::size_t i = 0; i < shelf.curves.size(); ++i) {
    std::error_code error;
    if (fs::equivalent(path, shelf.curves[i].path, error)) return static_cast<int>(i);
  }
  return std::nullopt;
}

void ShelveFolder(const fs::path& place, AuditShelf* shelf) {
  std::error_code error;
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(place, error)) {
    if (Exists(entry.path() / "curve.csv")) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());  // the directory order depends on the file system
  for (const fs::path& folder : folders) {
    if (shelf->curves.size() >= kMostCurves) return;
    if (PositionOf(folder, *shelf)) continue;
    Expected<IvCurve> curve = ReadCurve(folder.string());
    if (curve) shelf->curves.push_back(Shelve(std::move(*curve), folder));
  }
}

}  // namespace

Expected<AuditShelf> OpenShelf(const std::string& rows_path,
                               const std::vector<std::string>& folders) {
  AuditShelf shelf;
  std::error_code error;
  fs::path rows_folder = fs::path(rows_path).parent_path();
  if (rows_folder.empty()) rows_folder = ".";
  shelf.places = {rows_folder.string(), (rows_folder / "..").lexically_normal().string()};
  for (const std::string& folder : folders) {
    if (!IsFolder(folder)) return Fail("expected a folder of curves", folder);
    shelf.places.push_back(folder);
  }
  for (const std::string& place : shelf.places) ShelveFolder(place, &shelf);
  return shelf;
}

Expected<int> FindCurve(const std::string& device, AuditShelf* shelf) {
  std::string tried;
  for (const std::string& place : shelf->places) {
    for (const char* ending : {"", ".csv", ".json"}) {
      const fs::path path = fs::path(place) / (device + ending);
      if (!Exists(path)) continue;
      if (const auto position = PositionOf(path, *shelf)) return *position;
      Expected<IvCurve> curve = ReadCurve(path.string());
      if (!curve) return tl::unexpected(curve.error());
      shelf->curves.push_back(Shelve(std::move(*curve), path));
      return static_cast<int>(shelf->curves.size()) - 1;
    }
    tried += (tried.empty() ? "" : ", ") + place;
  }
  return Fail(fmt::format("no curve of device {} in {}", Quoted(device), tried));
}

}  // namespace lyrefit
