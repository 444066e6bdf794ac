#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/law/kernel.h"

namespace lyrefit {

// A curve that rows are held against.
struct AuditCurve {
  IvCurve curve;
  std::string path;    // as given to ReadCurve
  std::string folder;  // where its published bounds lie
  PointSet points;
  double short_circuit_A = 0;
};

// All curves within reach of a table of rows.
struct AuditShelf {
  std::vector<std::string> places;  // folders, in the order they are searched
  std::vector<AuditCurve> curves;
};

// Reads every folder with a curve.csv in the folder of `rows_path`, in its parent and in `folders`;
// what cannot be read there is left out. Errors: one of `folders` is not there.
Expected<AuditShelf> OpenShelf(const std::string& rows_path,
                               const std::vector<std::string>& folders);

// Position of the curve that `device` names, read into the shelf if it is not there yet. Errors: no
// such curve in any of the places, or one that cannot be read.
Expected<int> FindCurve(const std::string& device, AuditShelf* shelf);

}  // namespace lyrefit
