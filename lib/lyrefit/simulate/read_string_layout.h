// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/model/law.h"

namespace LYREFIT_PUBLIC lyrefit {

// Reads a layout from JSON:
//
//   {"bypass_diode": {"voltage_V": 0.5, "ideality": 1.2},
//    "reverse": {"law": "bishop", "a": 0.1, "Vbr_V": 15, "m": 3.4},
//    "strings": [[{"bypass": true, "cells": [{"count": 19}, {"count": 1, "light": 0.3,
//                                                            "leak_S": 0.01}]},
//                 {"bypass": true, "cells": [{"count": 20}]}]]}
//
// Strings are in parallel, the parts (substrings) of each in series. `times` (1) repeats a part,
// `bypass` (false) gives each of them a bypass diode. reverse: {"law": "shunt"} (default), "bishop"
// (a, Vbr_V, m; doi:10.1016/0379-6787(88)90059-2) or "soft" (A_V, m). Equal parts of a string are
// merged. Errors: unknown keys, strings of unequal numbers of cells, more than kMostGroups
// different cell groups, numbers outside their ranges.
Expected<StringLayout> ReadStringLayout(const std::string& path);

}  // namespace lyrefit
