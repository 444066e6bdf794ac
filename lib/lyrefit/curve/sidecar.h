#pragma once

#include <optional>
#include <string>

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
};

enum class SidecarOf {
  kCurve,
  kSet,  // temperature and irradiance may be remarks ("per curve"), which state no value
};

// Reads the sidecar in `path`. Keys as ReadCurve lists them; cell_temperature_C and irradiance_W_m2
// are accepted too and go before the nominal values. Unknown keys are left alone.
Expected<Sidecar> ReadSidecar(const std::string& path, std::uintmax_t largest_file_bytes,
                              SidecarOf of = SidecarOf::kCurve);

// What `own` does not say is taken from `common`.
Sidecar Merge(Sidecar own, const Sidecar& common);

}  // namespace lyrefit
