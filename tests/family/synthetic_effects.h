#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "effects/synthetic_use.h"
#include "family/synthetic_family.h"
#include "lyrefit/model/extended_set.h"

namespace lyrefit {

// The dark curve of a device of 36 cells, from -4 V to beyond the knee.
inline IvCurve DarkCurve(const Translation& law, const std::vector<double>& shared,
                         double temperature_C, int points) {
  const double kelvin = temperature_C + 273.15;
  const TranslatedDevice made = TranslateTo(law, shared, 0, kelvin);
  IvCurve curve;
  curve.name = "dark";
  curve.conditions.irradiance_W_m2 = 0;
  curve.conditions.cell_temperature_K = kelvin;
  curve.conditions.cells_in_series = law.spec.cells_in_series;
  for (int k = 0; k < points; ++k) curve.voltage_V.push_back(-4 + 25.0 * k / (points - 1));
  curve.current_A = SolveCurrents(made.device, made.parameters.data(), curve.voltage_V);
  return curve;
}

// Replaces the currents of a set by those of the device with effects, plus noise of noise_A. Every
// parameter of the effects must be fixed.
inline void AddSyntheticEffects(const std::vector<EffectUse>& uses, Translation law,
                                std::vector<double> shared, double noise_A, CurveSet* set,
                                std::uint64_t seed = 3) {
  shared.resize(law.size());  // without offsets of the sensors
  const Expected<void> extended =
      ExtendTranslation(*set, shared[law.bandgap_slope], uses, /*force=*/true, &law);
  ASSERT_TRUE(extended) << extended.error().ToString();
  const std::vector<double>& usual = law.extended->effects->usual;
  shared.insert(shared.end(), usual.begin(), usual.end());
  const std::vector<double> p = ExtendedParameters(law, shared.data());
  RandomStream random(seed);
  for (std::size_t c = 0; c < set->curves.size(); ++c) {
    IvCurve& curve = set->curves[c];
    const Device device = OfCurve(*law.extended, static_cast<int>(c));
    ASSERT_TRUE(ExtendedCurrents(device, p.data(), curve.current_A.data(), nullptr));
    for (double& current : curve.current_A) current += noise_A * random.Normal();
  }
}

}  // namespace lyrefit
