#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/model/kernel.h"

namespace lyrefit {

// A curve that published rows are checked against.
struct AuditCurve {
  IvCurve curve;
  std::string path;    // as given to ReadCurve
  std::string folder;  // folder that holds the curve's published bounds
  PointSet points;
  double short_circuit_A = 0;
};

// All curves that the rows of one table can refer to.
struct AuditShelf {
  std::vector<std::string> places;  // folders, in search order
  std::vector<AuditCurve> curves;
};

// Reads every folder with a curve.csv in the folder of `rows_path`, in its parent and in `folders`.
// Unreadable curves are left out. Errors: one of `folders` does not exist.
Expected<AuditShelf> OpenShelf(const std::string& rows_path,
                               const std::vector<std::string>& folders);

// Position of the curve that `device` names. The curve is read and added to the shelf on first use.
// Errors: no such curve in any of the places, or an unreadable curve.
Expected<int> FindCurve(const std::string& device, AuditShelf* shelf);

}  // namespace lyrefit
