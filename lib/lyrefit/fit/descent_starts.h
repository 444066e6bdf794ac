#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/fit/descents.h"
#include "lyrefit/fit/fit_job.h"
#include "lyrefit/fit/polish.h"
#include "lyrefit/fit/search_space.h"

namespace lyrefit {

// Places for descents over the local optima of a device with effects.

// Where the shape of the curve suggests, in every variant, on a typical device: "shape 1", ...
constexpr char kShapeOrigin[] = "shape ";
std::vector<PolishStart> ShapeStarts(const FitJob& job);

// The best of many random places, none of them beside another; every second one has the diodes of
// `best`, so that the effects alone are drawn.
std::vector<PolishStart> RandomStarts(const FitJob& job, const SearchSpace& space,
                                      const std::vector<double>& best, RandomStream* random);

// One more or less of each whole number of an end, one less of one for one more of another, the
// next settings of what is settled by trying as well, and the same place in the other variants.
std::vector<PolishStart> Neighbours(const FitJob& job, const DescentEnd& at);

// An end with one parameter elsewhere in its range, of those that say how something acts.
std::vector<PolishStart> Elsewhere(const FitJob& job, const DescentEnd& at);

// A place with what is settled by trying at values spread over all there are.
std::vector<PolishStart> SpreadSettings(const FitJob& job, const PolishStart& at);

// "probe 1", ... in one of the variants.
std::vector<PolishStart> Named(const std::string& origin, int variant,
                               std::vector<std::vector<double>> places);

}  // namespace lyrefit
