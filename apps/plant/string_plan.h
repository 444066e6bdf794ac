// Experimental: may change in a minor version (data/stable).
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/model/translation.h"
#include "lyrefit/read/device_layout.h"

namespace LYREFIT_PUBLIC lyrefit {

// The plan of a plant: of how many modules, and of which, each string is built.

// A module of the plan: the device that its data sheet describes.
struct PlannedModule {
  std::string name;            // of the data sheet; else of its file
  int cells_in_series = 1;     // of one module
  int bypass_diodes = 3;       // of one module
  Translation translation;     // De Soto's law, see FitDataSheet
  std::vector<double> shared;  // its parameters
};

// One line of the plan: the strings whose ids it names, and how they are built.
struct PlannedString {
  // An id; or the beginning of ids up to a '/', "site/inv01", for all strings below; or a pattern
  // with * (any text) and ? (any character).
  std::string id;
  int modules_in_series = 0;                    // modules in series
  int strings_in_parallel = 1;                  // equal strings that the curve measures together
  int bypass_diodes = 3;                        // of one module
  std::shared_ptr<const PlannedModule> module;  // null: not stated
};

// How the plan says a string is built; `sheet`: of the module, for what the line does not say.
DeviceLayout LayoutOf(const PlannedString& line, DeviceLayout sheet);

// A plan that was read.
class PlantPlan {
 public:
  // `lines` in the order of the file.
  explicit PlantPlan(std::vector<PlannedString> lines);

  // The line for a string: that of its own id, else the one whose text has most letters that are
  // no wildcards, of equal ones the first. Null: the plan does not name the string.
  const PlannedString* Find(const std::string& id) const;

  // All lines, in the order of the file.
  const std::vector<PlannedString>& lines() const { return lines_; }
  // A text that differs where a plan expects something else of any string.
  std::string Digest() const;

 private:
  std::vector<PlannedString> lines_;
  std::map<std::string, std::size_t> by_id_;  // lines without wildcards
  std::vector<std::size_t> patterns_;         // lines with wildcards
};

// Reads a plan:
//   CSV   a header with id and modules_in_series; also strings_in_parallel (1), bypass_diodes (of a
//         module; its data sheet's, else 3), module and remark, which is not read
//   JSON  a list of objects with these keys, or an object that has the list under "strings"
// `module` is a file, relative to the plan: the JSON of a data sheet (short_circuit_current_A,
// open_circuit_voltage_V, max_power_current_A, max_power_voltage_V, alpha_sc_percent_K or
// alpha_sc_A_K, beta_oc_percent_K or beta_oc_V_K, cells_in_series, bypass_diodes, name), a .PAN
// file, or a row of SAM's library (ReadModuleSheet). Errors, with line and column: an unknown or
// missing column, no whole number where one is expected, a line that is there twice, a module that
// cannot be read or that no diode describes.
Expected<std::shared_ptr<const PlantPlan>> ReadPlantPlan(const std::string& file);

}  // namespace lyrefit
