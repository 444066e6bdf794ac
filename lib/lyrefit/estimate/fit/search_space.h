#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/model/parameter.h"
#include "lyrefit/model/variants.h"
#include "lyrefit/search/search_summary.h"

namespace lyrefit {

// The box of a search, with one dimension for each parameter that is not fixed. A linear parameter
// is searched in its own unit, so that published boxes keep their meaning. A logarithmic one is
// searched as ln(value / lower end), from 0. An integer parameter has an interval of length 1 for
// each value. If effects have several variants, one more dimension has an interval of length 1 for
// each variant.
class SearchSpace {
 public:
  // `fixed[i]` is the value of a fixed parameter, NaN for the others.
  SearchSpace(const std::vector<ParameterBounds>& bounds, const std::vector<double>& fixed);
  // For a device with effects: `bounds` and `fixed` are of its base, the effects are those of
  // `variants`. The effects must outlive the space.
  SearchSpace(const std::vector<ParameterBounds>& bounds, const std::vector<double>& fixed,
              const DeviceEffects& device_effects, std::vector<Variant> variants);

  // Fills in Box::sides; `parameters` are those of the device, effects last.
  void NameSides(const std::vector<ParameterInfo>& parameters);

  const Box& box() const { return box_; }
  int dimensions() const { return static_cast<int>(box_.lower.size()); }
  // Converts a point of the box to device parameters `p` (array of the size of the device).
  void ToParameters(const double* x, double* p) const;
  // Point of the box for parameters in a variant. Values outside their ranges are clamped, and an
  // integer becomes the middle of its interval.
  std::vector<double> FromParameters(const double* p, int variant) const;
  // Index of the variant of a point.
  int VariantAt(const double* x) const;

 private:
  struct Side {
    int parameter = 0;
    double log_base = 0;  // lower end of a logarithmic parameter, else 0
    double first = 0;     // lowest integer value
    double whole = 0;
    int values = 0;
  };
  void AddSide(int parameter, const ParameterBounds& bounds);

  std::vector<double> fixed_;
  std::vector<Side> sides_;
  const DeviceEffects* effects_ = nullptr;
  std::vector<Variant> variants_;
  Box box_;
};

// Checks and completes the result of a user's own search before the polish. `best` replaces missing
// elites, the first elite replaces a missing `best`, and objective values are recomputed. Error: no
// candidate, or one that is not finite, is outside the box or has another number of coordinates
// than the box.
Expected<void> CheckCandidates(const ObjectiveFunction& objective, const Box& box,
                               SearchSummary* summary);

}  // namespace lyrefit
