#include "lyrefit/model/default_values.h"
#include "studies/coverage_sets.h"
#include "studies/landscape_draw.h"
#include "synthetic/draw.h"

namespace lyrefit {

Expected<LandscapeCase> DrawFamily(bool effects, RandomStream* random) {
  CoverageOptions options;
  options.seed = random->Bits();
  options.curves = WholeBetween(random, 6, 12);
  options.points = WholeBetween(random, 30, 60);
  options.noise_relative = 5e-4;
  options.temperature_error_K = Between(random, -8, 8);
  options.irradiance_error_W_m2 = Between(random, -20, 20);
  options.family.temperature_offset = options.family.irradiance_offset = true;
  auto made = SimulateSet(options, 0);
  if (!made) return tl::unexpected(made.error());
  LandscapeCase result;
  result.set = std::move(made->set);
  result.family = options.family;
  // Only the search and its polish are evaluated.
  result.family.individual_fits = result.family.intervals = result.family.random_baseline = false;
  result.family.folds = 0;
  for (int i = 0; i < made->translation.size(); ++i) {
    result.truth[made->translation.parameters[i].symbol] = made->truth[i];
  }
  const double kelvin = -options.temperature_error_K;
  const double irradiance = -options.irradiance_error_W_m2;
  if (effects) {
    result.family.temperature_offset = result.family.irradiance_offset = false;
    // The fit with offsets fixes the band gap too: its effect resembles an offset.
    result.family.fixed["EgRef"] = kDefaultBandgap_eV;
    result.family.with = {Freed("temp_offset", {}), Freed("sensor_offset", {})};
    result.truth["temp_offset.c"] = kelvin;
    result.truth["sensor_offset.c"] = irradiance;
  } else {
    result.truth["temperature_offset_K"] = kelvin;
    result.truth["irradiance_offset_W_m2"] = irradiance;
  }
  result.noise_A = made->noise_A;
  return result;
}

}  // namespace lyrefit
