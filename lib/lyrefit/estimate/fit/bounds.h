#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/model/device.h"

namespace LYREFIT_PUBLIC lyrefit {

// Box of the search.
//   physical     derived from the curve: Iph up to twice the largest delivered current; n in [1, 2],
//                of a stated thin film in [1, 6], of one diode in the dark in [0.5, 10]; Is about
//                the value that Voc implies, in the dark up to the forward current; Rs and Rsh from
//                V_max / I_max, without breakdown. Is may be 0, Rsh practically infinite.
//   wide         as physical, but n in [0.5, 10]: wrong temperature or cell count, unusual devices
//   a table      symbol -> [lower, upper], as published: linear in every parameter. "Is" and "n"
//                hold for every diode unless "Is1", "n2" ... are given.
// `overrides` replaces single ranges of any of these. Units: ampere and ohm of the device, n per
// cell.
struct BoundsSpec {
  // Symbol -> [lower, upper].
  using Table = std::map<std::string, std::pair<double, double>>;
  std::string name = "physical";  // of a table: the path of its file
  Table table;                    // used when `name` is neither "physical" nor "wide"
  Table overrides;                // keys: "Rs", "Is", "n2", ...
};

// Bounds of every parameter, in the order of the device. Errors: a range that is reversed, not
// finite or of a parameter that the model lacks; a table without a range for a parameter.
Expected<std::vector<ParameterBounds>> MakeBounds(const BoundsSpec& spec, const Device& device,
                                                  const IvCurve& curve);

// Whether a table may bound the parameters of some model: names of the triple diode, finite numbers
// in order, none negative. The error names the entry.
Expected<void> CheckBoundsTable(const BoundsSpec::Table& table);

}  // namespace lyrefit
