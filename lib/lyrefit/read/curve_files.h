// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Role of a file for a measurement.
enum class FileRole {
  kNone,
  kRead,        // an input: the table itself, or a table of the folder
  kConditions,  // conditions, an index or published bounds are read from this name, whether the
                // file exists or not
  kNewCurve,    // does not exist yet, in a folder whose tables are all read as curves
};

// Role of `file` for the measurement at `input`, a file or folder as ReadCurve and ReadCurveSet
// accept it. The role shows whether writing `file` would change the measurement. Two existing paths
// are the same if they lead to one file on the disk. Otherwise the folder must be the same and the
// names must agree, ignoring case. kNone if `input` does not exist.
FileRole RoleOf(const std::string& file, const std::string& input);

// Whether two paths lead to one file, by the rules of RoleOf.
bool IsSameFile(const std::string& a, const std::string& b);

}  // namespace lyrefit
