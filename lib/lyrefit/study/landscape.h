#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/family/family_options.h"
#include "lyrefit/fit/bounds.h"
#include "lyrefit/law/extension.h"

namespace LYREFIT_PUBLIC lyrefit {

// Made measurements of a kind that has many local optima: problems for searches. Everything is drawn from
// ranges that modules, cells and tracers have, none of it with an eye on any search.

// One device of such a problem. All devices of a problem are fitted with the same laws.
struct LandscapeCase {
  std::string problem;  // "strings_3"
  IvCurve curve;        // the measurement, where there is no set
  Model model = Model::kSingleDiode;
  BoundsSpec bounds;
  std::vector<EffectUse> with;
  std::optional<CurveSet> set;  // of a family: fitted as `family` says, `model` and `with` in it
  FamilyOptions family;         // how a set is fitted
  // What it was made with, in the units of reports: "Iph", "substrings.d1"; of a set the shared
  // parameters and, where no effect says it, "irradiance_offset_W_m2" and "temperature_offset_K",
  // true less shown.
  std::map<std::string, double> truth;
  double noise_A = 0;  // standard deviation of every current's error
};

// A kind of devices whose fit has many local optima.
struct LandscapeProblem {
  std::string name;   // "strings_3"
  std::string title;  // "three lights, one of three substrings each"
};

// All there are, in the order of tables.
const std::vector<LandscapeProblem>& LandscapeProblems();

// So many devices of one problem; the same for the same seed, and the first ones whatever their
// count. Errors: an unknown name, and which there are; a count out of 1 to 10000.
Expected<std::vector<LandscapeCase>> MakeLandscape(const std::string& problem, int devices,
                                                   std::uint64_t seed);

}  // namespace lyrefit
