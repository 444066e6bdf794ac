#include "lyrefit/fit/floor.h"

#include <algorithm>

#include "lyrefit/base/try.h"
#include "lyrefit/law/device.h"

namespace lyrefit {
namespace {

constexpr double kLeastSaturation_A = 1e-300;

bool HasOwnRanges(const CertifyOptions& options) {
  const CertifyOptions usual;
  return options.n_lower != usual.n_lower || options.n_upper != usual.n_upper ||
         options.rs_lower_ohm != usual.rs_lower_ohm || options.rs_upper_ohm != usual.rs_upper_ohm ||
         options.iph_lower_A != usual.iph_lower_A || options.iph_upper_A != usual.iph_upper_A ||
         options.is_lower_A != usual.is_lower_A || options.is_upper_A != usual.is_upper_A ||
         options.rsh_lower_ohm != usual.rsh_lower_ohm ||
         options.rsh_upper_ohm != usual.rsh_upper_ohm || !options.diodes.empty();
}

}  // namespace

CertifyOptions RangesOf(const std::vector<ParameterBounds>& bounds, ConstantSet constants,
                        std::vector<Model> models) {
  CertifyOptions options;
  options.constants = constants;
  options.models = std::move(models);
  options.rs_lower_ohm = bounds[kRs].lower;
  options.rs_upper_ohm = bounds[kRs].upper;
  options.n_lower = bounds[IdealityIndex(0)].lower;
  options.n_upper = bounds[IdealityIndex(0)].upper;
  for (int d = 1; IdealityIndex(d) < static_cast<int>(bounds.size()); ++d) {
    options.n_lower = std::min(options.n_lower, bounds[IdealityIndex(d)].lower);
    options.n_upper = std::max(options.n_upper, bounds[IdealityIndex(d)].upper);
  }
  options.iph_lower_A = bounds[kIph].lower;
  options.iph_upper_A = bounds[kIph].upper;
  options.rsh_lower_ohm = bounds[kRsh].lower;
  options.rsh_upper_ohm = bounds[kRsh].upper;
  for (int d = 0; IdealityIndex(d) < static_cast<int>(bounds.size()); ++d) {
    const ParameterBounds& is = bounds[SaturationCurrentIndex(d)];
    const ParameterBounds& n = bounds[IdealityIndex(d)];
    // A diode fixed at Is = 0 is represented by one that hardly conducts.
    options.diodes.push_back({n.lower, n.upper, is.lower, std::max(is.upper, kLeastSaturation_A)});
  }
  // A single value of n becomes a narrow range.
  if (!(options.n_lower < options.n_upper)) options.n_upper = options.n_lower * (1 + 1e-9);
  return options;
}

Expected<CertifyOptions> CertifyWithin(const BoundsSpec& spec, const IvCurve& curve,
                                       const CertifyOptions& options) {
  if (HasOwnRanges(options)) {
    return Fail("bounds '" + spec.name +
                "' hold every range: leave out those of n, Rs, Iph, Is and Rsh, or put them into a "
                "bounds file");
  }
  Model largest = options.models.empty() ? Model::kTripleDiode : Model::kSingleDiode;
  for (const Model model : options.models) largest = std::max(largest, model);
  const Device device = MakeDevice(largest, curve.conditions, options.constants);
  TRY(const std::vector<ParameterBounds> bounds, MakeBounds(spec, device, curve));
  CertifyOptions within = RangesOf(bounds, options.constants, options.models);
  within.objective = options.objective;
  within.tolerance = options.tolerance;
  within.rigorous = options.rigorous;
  within.effort = options.effort;
  within.bounds = spec.name;
  return within;
}

}  // namespace lyrefit
