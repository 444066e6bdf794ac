#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/estimate/fit/bounds.h"
#include "lyrefit/family/family_options.h"
#include "lyrefit/model/device_effects.h"
#include "lyrefit/study/compare_options.h"

namespace lyrefit {

// Synthetic measurements whose fits have many local optima: test problems for searches. All values
// are drawn from the ranges of real modules, cells and tracers, without regard to any search
// algorithm.

// One device of a problem. All devices of a problem are fitted with the same laws.
struct LandscapeCase {
  std::string problem;  // "strings_3"
  IvCurve curve;        // the measurement, if there is no set
  Model model = Model::kSingleDiode;
  BoundsSpec bounds;
  std::vector<EffectUse> with;
  // Curves of a family; fitted with `family`, which also holds the model and the effects.
  std::optional<CurveSet> set;
  FamilyOptions family;  // how a set is fitted
  // True parameters of the simulation in reporting units: "Iph", "substrings.d1". For a set they
  // are the shared parameters. If no effect has the sensor offsets, "irradiance_offset_W_m2" and
  // "temperature_offset_K" are included, as true minus shown value.
  std::map<std::string, double> truth;
  double noise_A = 0;  // standard deviation of every current's error
};

// A type of device whose fit has many local optima.
struct LandscapeProblem {
  std::string name;   // "strings_3"
  std::string title;  // "three lights, one of three substrings each"
};

// All problems, in the order of the tables.
const std::vector<LandscapeProblem>& LandscapeProblems();

// Draws `devices` devices of one problem. The same seed gives the same devices, and a larger count
// only appends devices. Errors: an unknown name (the message lists the known ones); a count outside
// 1 to 10000.
Expected<std::vector<LandscapeCase>> MakeLandscape(const std::string& problem, int devices,
                                                   std::uint64_t seed);

// The device as an input of a comparison.
CompareCurve SubjectOf(LandscapeCase made);

}  // namespace lyrefit
