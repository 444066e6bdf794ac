#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// Content of the JSON file beside a table; unset fields were not stated.
struct Sidecar {
  std::string name;
  std::optional<double> temperature_C;
  std::optional<double> irradiance_W_m2;
  std::string light;  // what states a light without its irradiance: "line 2 'Light: room'"
  std::optional<int> cells_in_series;
  std::optional<int> strings_in_parallel;
  DeviceNotes notes;
  ConditionSources stated_in;           // where these stand
  std::vector<Assumption> assumptions;  // sentences on how it was read
};

enum class SidecarOf {
  kCurve,
  kSet,  // temperature and irradiance may be remarks ("per curve") without a value
};

// Reads the sidecar `path`. The keys are those that ReadCurve lists. cell_temperature_C and
// irradiance_W_m2 are accepted too and have priority over nominal values. Unknown keys are ignored;
// a file without any known key adds an assumption. A report of `lyrefit fit` under this name
// supplies the fitted curve's conditions.
Expected<Sidecar> ReadSidecar(const std::string& path, std::uintmax_t largest_file_bytes,
                              SidecarOf of = SidecarOf::kCurve);

// Reads a sidecar from keys inside another JSON object, for example beside the readings of a row.
Expected<Sidecar> SidecarOfKeys(const nlohmann::json& object, const std::string& path);

// Whether a sidecar may contain this key.
bool IsSidecarKey(std::string_view key);

// Whether a JSON document is a report of this library.
bool IsReport(const nlohmann::json& document);

// Conditions of the single curve of a report, without those that the report assumed. Older reports
// do not list them; if such a report assumed anything, all its conditions are left out. nullopt if
// the report is not about a single curve.
std::optional<Sidecar> ReportedConditions(const nlohmann::json& report, const std::string& path);

// Records the setup of the measurement, and where it is stated, unless one is recorded.
void TakeSetup(Setup setup, const std::string& stated_in, Sidecar* sidecar);

// Fills the unset fields of `own` from `common`.
Sidecar Merge(Sidecar own, const Sidecar& common);

}  // namespace lyrefit
