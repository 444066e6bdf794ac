#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/law/device.h"

namespace LYREFIT_PUBLIC lyrefit {

// Which box to search.
//   physical     derived from the curve: Iph up to twice the largest current, n in [1, 2], Is on a
//                logarithmic scale around what Voc asks for, Rs and Rsh from the characteristic
//                resistance V_max / I_max. A diode may vanish and the shunt may be perfect.
//   wide         the same with n in [0.5, 10]: wrong temperature or cell count, odd devices
//   a table      symbol -> [lower, upper], as published: linear in every parameter. "Is" and "n"
//                hold for every diode unless "Is1", "n2" ... are given.
// `overrides` replace single ranges of any of these.
struct BoundsSpec {
  // Symbol -> [lower, upper].
  using Table = std::map<std::string, std::pair<double, double>>;
  std::string name = "physical";  // of a table: that of its file
  Table table;                    // used when `name` is neither "physical" nor "wide"
  Table overrides;                // keys: "Rs", "Is", "n2", ...
};

// Bounds of every parameter of the device, in its order. Errors: a range that is reversed, not
// finite or of a parameter the model does not have; a table that leaves a parameter out.
Expected<std::vector<ParameterBounds>> MakeBounds(const BoundsSpec& spec, const Device& device,
                                                  const IvCurve& curve);

// A bounds file: {"Iph":[0,2],"Is":[0,5e-5],"n":[1,2],"Rs":[0,0.36],"Rsh":[0,1000]}. A ampere and
// ohm of the whole device, n per cell. Errors carry file, line and column.
Expected<BoundsSpec> ReadBoundsFile(const std::string& path);

// What a person names: "physical", "wide", a bounds file, or "paper" or "literature", which stand in
// bounds-NAME.json beside the curve's file (or in its folder). Errors without a file begin with
// "bounds".
Expected<BoundsSpec> NamedBounds(const std::string& name, const std::string& curve_file);

}  // namespace lyrefit
