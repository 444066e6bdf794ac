#pragma once

#include <optional>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/read/read_pvlib.h"

namespace lyrefit {

// The law and the shared parameters of a family's JSON report. Empty: the report is of another kind,
// of individual fits, or its law has effects, which belong to single curves. `path`: for errors. Errors:
// not JSON; a parameter of the law that is missing or no number.
Expected<std::optional<NamedParameters>> LawOfReport(const std::string& text,
                                                     const std::string& path);

}  // namespace lyrefit
