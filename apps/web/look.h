#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/report/page.h"
#include "request.h"

namespace lyrefit {

// A measurement with the conditions of the form, as `lyrefit diagnose` reads it.
Expected<CurveSet> ReadStated(const std::string& file, const ReadingForm& form);

// Applies the conditions of the form to all that was read of `file`. Error: an irradiance for
// several curves.
Expected<void> ApplyStated(const ReadingForm& form, const std::string& file, CurveSet* set);

// Pictures are interactive charts, since the page has no gnuplot.
PageOptions InPage();

// File name without extension: "sweep" for "sweep.csv".
std::string StemOf(const std::string& file);

// Content of a file as far as it can be read: its columns and their interpretation, its curves with
// their conditions, a page with a picture of the readings, the assumptions, and the error if it
// cannot be read. A trace that needs another file of its cell is read beside request.files. The
// sheet of a module has no curve, but "module" (--module takes it) or "sheet" (datasheet does).
Expected<nlohmann::ordered_json> LookAt(const PageRequest& request);

}  // namespace lyrefit
