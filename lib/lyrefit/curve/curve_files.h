#pragma once

#include <string>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// What a file is to a measurement.
enum class FileRole {
  kNone,
  kRead,        // it is read: the table itself, a table of the folder
  kConditions,  // conditions, an index or published bounds are read from a file of this name, be it
                // there or not
  kNewCurve,    // it is not there, but in a folder where every table is read as a curve
};

// What writing `file` would do to the measurement at `input`, a file or folder as ReadCurve and
// ReadCurveSet take it. Files are the same if they are one file on the disk (links, another way to
// it), and where one is not there yet, if folder and name are the same but for upper and lower
// case. kNone where there is no `input`.
FileRole RoleOf(const std::string& file, const std::string& input);

// Whether two paths lead to one file, in the same sense.
bool IsSameFile(const std::string& a, const std::string& b);

}  // namespace lyrefit
