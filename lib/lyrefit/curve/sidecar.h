#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// What the JSON file beside a table says; empty where it says nothing.
struct Sidecar {
  std::string name;
  std::optional<double> temperature_C;
  std::optional<double> irradiance_W_m2;
  std::optional<int> cells_in_series;
  std::optional<int> strings_in_parallel;
  DeviceNotes notes;
  std::vector<Assumption> assumptions;  // plain sentences on how it was read
};

enum class SidecarOf {
  kCurve,
  kSet,  // temperature and irradiance may be remarks ("per curve"), which state no value
};

// Reads the sidecar in `path`. A report of `lyrefit fit` that stands in its place gives the
// conditions that were fitted, and a file without any known key says so. Keys as ReadCurve lists
// them; cell_temperature_C and irradiance_W_m2 are accepted too and go before the nominal values.
// Unknown keys are left alone.
Expected<Sidecar> ReadSidecar(const std::string& path, std::uintmax_t largest_file_bytes,
                              SidecarOf of = SidecarOf::kCurve);

// The same from the keys themselves, wherever they stand: beside the readings of a row.
Expected<Sidecar> SidecarOfKeys(const nlohmann::json& object, const std::string& path);

// Whether a sidecar may have this key.
bool IsSidecarKey(std::string_view key);

// Whether a JSON document is a report that this library wrote.
bool IsReport(const nlohmann::json& document);

// The conditions under which the one curve of a report was taken, without those that the report had
// to assume (all, where an older one does not list these and assumed anything); nothing if it is on
// no single curve.
std::optional<Sidecar> ReportedConditions(const nlohmann::json& report, const std::string& path);

// What `own` does not say is taken from `common`.
Sidecar Merge(Sidecar own, const Sidecar& common);

}  // namespace lyrefit
