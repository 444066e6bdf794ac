#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "request.h"

namespace lyrefit {

// A measurement with what is said of it, as `lyrefit diagnose` reads it.
Expected<CurveSet> ReadStated(const std::string& file, const ReadingForm& form);

// "sweep" of "sweep.csv".
std::string StemOf(const std::string& file);

// What a file holds as far as it is understood: its columns and what each is read as, its curves with
// their conditions, what had to be assumed, why it cannot be read.
Expected<nlohmann::ordered_json> LookAt(const PageRequest& request);

}  // namespace lyrefit
