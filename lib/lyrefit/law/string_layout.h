#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/law/effect.h"

namespace LYREFIT_PUBLIC lyrefit {

// How the cells of a device are wired, and what each kind of them is: constants of the law, where
// effects have parameters. The device's own parameters are those of all its cells alike.
struct StringLayout {
  // Cells that are alike.
  struct Cells {
    double share = 1;   // of all cells of the device
    double light = 1;   // part of the photocurrent
    double leak_S = 0;  // conductance of each cell beside that of the others
    int part = 0;       // position in `parts`
  };
  std::vector<Cells> kinds;  // at most kMostKinds
  std::vector<Part> parts;   // at most kMostKinds
  int cells_in_series = 1;
  int strings = 1;                // in parallel, all of as many cells
  double bypass_voltage_V = 0.5;  // at the current scale, which is about Isc
  double bypass_ideality = 1.2;   // towards 0: an ideal one, whose voltage stays there
  ReverseLaw reverse = ReverseLaw::kShunt;
  double reverse_strength = 0.1;  // Bishop's a
  double reverse_voltage_V = 15;
  double reverse_exponent = 3.4;  // m of either law
};

// A layout from JSON:
//
//   {"bypass_diode": {"voltage_V": 0.5, "ideality": 1.2},
//    "reverse": {"law": "bishop", "a": 0.1, "Vbr_V": 15, "m": 3.4},
//    "strings": [[{"bypass": true, "cells": [{"count": 19}, {"count": 1, "light": 0.3,
//                                                            "leak_S": 0.01}]},
//                 {"bypass": true, "cells": [{"count": 20}]}]]}
//
// strings stand in parallel, the parts of each in series; of a part, `times` (1) says how many such
// follow each other, `bypass` (false) whether each has a bypass diode. reverse: {"law": "shunt"}
// (the usual), "bishop" (a, Vbr_V, m; doi:10.1016/0379-6787(88)90059-2) or "soft" (A_V, m). Parts
// that are equal are taken together. Errors: what else stands in the file, strings of unequal
// numbers of cells, more than kMostKinds different kinds, numbers no cell has.
Expected<StringLayout> ReadStringLayout(const std::string& path);

}  // namespace lyrefit
