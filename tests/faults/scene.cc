#include "faults/scene.h"

#include <algorithm>
#include <cmath>

#include "faults/base_fit.h"
#include "faults/measure.h"

namespace faults {

std::vector<double> Scene::Sigmas() const {
  return faults::Sigmas(noise, plan, ExactCurrents(device, effects, plan));
}

std::vector<double> Scene::Exact() const {
  std::vector<double> currents = ExactCurrents(device, effects, plan);
  const std::vector<double> sigmas = faults::Sigmas(noise, plan, currents);
  for (const Outlier& outlier : outliers) {
    currents[outlier.point] += outlier.sigmas * sigmas[outlier.point];
  }
  return currents;
}

double Misfit(const Scene& scene) {
  const std::vector<double> sigmas = scene.Sigmas();
  if (scene.resolution_A > 0) {
    double chi2 = 0;
    for (std::size_t i = 0; i < sigmas.size(); ++i) {
      const double range = scene.plan.settings[i].suns == 0 ? 0.1 : 1;
      const double rounding = range * scene.resolution_A / sigmas[i];
      chi2 += rounding * rounding / 12;
    }
    return std::sqrt(chi2);
  }
  return FitBase(scene.device, scene.plan, scene.Exact(), sigmas).Misfit();
}

Measurement Take(const Scene& scene, Random* random) {
  Measurement taken;
  taken.current = WithNoise(scene.noise, scene.plan, scene.Exact(), random);
  taken.current = Rounded(scene.resolution_A, scene.plan, taken.current);
  for (double& current : taken.current) {
    if (scene.effects.clip_A > 0) current = std::min(current, scene.effects.clip_A);
  }
  const bool one = scene.plan.kind <= Kind::kReverse;
  for (const Setting& at : scene.plan.settings) {
    taken.voltage.push_back(at.voltage);
    if (scene.plan.times) taken.time.push_back(at.time_s);
    if (!one) taken.sweep.push_back(at.sweep);
    taken.curve.push_back(at.curve);
    taken.irradiance.push_back(1000 * at.suns);
    const double kelvin = scene.stated_kelvin > 0 ? scene.stated_kelvin : at.kelvin;
    taken.temperature.push_back(kelvin - 273.15);
  }
  taken.cells = scene.stated_cells > 0 ? scene.stated_cells : scene.device.cells;
  taken.bypass_diodes = scene.stated_groups > 0 ? scene.stated_groups : scene.device.substrings;
  taken.bandgap_eV = scene.device.bandgap_eV;
  taken.isc_tempco_per_K = scene.device.isc_tempco_per_K;
  taken.thin_film = scene.device.thin_film;
  if (scene.noise.neighbours == 0 && random->Chance(0.12)) {
    taken.noise_constant_A = scene.noise.constant_A;
    taken.noise_relative = scene.noise.relative;
  }
  return taken;
}

}  // namespace faults
