// Experimental: may change in a minor version (data/stable).
#pragma once

#include <vector>

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

}  // namespace lyrefit
