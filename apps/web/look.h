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

// Pictures are interactive charts, since the page has no gnuplot.
PageOptions InPage();

// File name without extension: "sweep" for "sweep.csv".
std::string StemOf(const std::string& file);

// Content of a file as far as it can be read: its columns and their interpretation, its curves with
// their conditions, a page with a picture of the readings, the assumptions, and the error if it
// cannot be read.
Expected<nlohmann::ordered_json> LookAt(const PageRequest& request);

}  // namespace lyrefit
