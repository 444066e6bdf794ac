// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/model/effect.h"

namespace LYREFIT_PUBLIC lyrefit {

// The wiring of a device's cells and the properties of each cell group. These are constants of the
// law, in contrast to the parameters of effects. The device's own parameters describe all cells as
// identical.
struct StringLayout {
  // A cell group: identical cells.
  struct Cells {
    double share = 1;   // fraction of all cells of the device
    double light = 1;   // factor of the photocurrent
    double leak_S = 0;  // additional shunt conductance of each cell
    int substring = 0;  // position of its substring in `substrings`
  };
  std::vector<Cells> groups;          // at most kMostGroups
  std::vector<Substring> substrings;  // at most kMostGroups
  int cells_in_series = 1;
  int strings = 1;                                // in parallel, of equal cell numbers
  double bypass_voltage_V = 0.5;                  // at the current scale, which is about Isc
  double bypass_ideality = kUsualBypassIdeality;  // towards 0: an ideal diode of constant voltage
  ReverseLaw reverse = ReverseLaw::kShunt;
  double reverse_strength = 0.1;  // Bishop's a
  double reverse_voltage_V = 15;
  double reverse_exponent = 3.4;  // m of either law
};

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
