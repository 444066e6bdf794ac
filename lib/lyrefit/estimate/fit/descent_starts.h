#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/estimate/fit/descents.h"
#include "lyrefit/estimate/fit/polish.h"
#include "lyrefit/estimate/fit/prepare_fit.h"
#include "lyrefit/estimate/fit/search_space.h"

namespace lyrefit {

// Starts for descents among the local optima of a device with effects.

// Starts from the shape of the curve, in every variant, on a typical device. Their origins are
// "shape 1", ...
constexpr char kShapeOrigin[] = "shape ";
std::vector<PolishStart> ShapeStarts(const PreparedFit& fit);

// The best of many random points, none close to another. Every second one has the base parameters
// of `best`, so that only the effects are random.
std::vector<PolishStart> RandomStarts(const PreparedFit& fit, const SearchSpace& space,
                                      const std::vector<double>& best, RandomStream* random);

// Starts near an end: with one integer parameter a step up or down, with one integer up and another
// down, or with the next settings of each enumerated parameter. The end transferred to the other
// variants is added.
std::vector<PolishStart> Neighbours(const PreparedFit& fit, const DescentEnd& at);

// Starts from an end with one parameter moved within its range. Parameters that describe how an
// effect acts are moved, not its strength.
std::vector<PolishStart> Elsewhere(const PreparedFit& fit, const DescentEnd& at);

// Starts with each enumerated parameter at values spread over its settings.
std::vector<PolishStart> SpreadSettings(const PreparedFit& fit, const PolishStart& at);

// Starts at `places` in one variant, with the origins "ORIGIN 1", "ORIGIN 2", ...
std::vector<PolishStart> Named(const std::string& origin, int variant,
                               std::vector<std::vector<double>> places);

}  // namespace lyrefit
