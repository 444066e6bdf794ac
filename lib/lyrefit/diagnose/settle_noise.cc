#include <algorithm>
#include <cmath>

#include "lyrefit/diagnose/select.h"

namespace lyrefit {
namespace {

// A grid much coarser than the noise leaves errors that neighbours share.
void WidenByRounding(const Measurement& measurement, const Noise& noise, Workbench* bench) {
  if (!IsCoarse(measurement, noise)) return;
  bench->least_variance = 1;
  for (std::size_t k = 0; k < bench->sigma.size(); ++k) {
    bench->sigma[k] = std::hypot(bench->sigma[k], measurement.values.rounding[k]);
  }
}

}  // namespace

Noise SettleNoise(const Measurement& measurement, Workbench* bench, LawFit* fit) {
  const Readings& readings = measurement.readings;
  Noise noise;
  for (int round = 0; round < 2; ++round) {
    std::vector<double> residual(readings.points.size());
    for (std::size_t k = 0; k < residual.size(); ++k) {
      residual[k] = fit->current[k] - readings.points[k].current;
    }
    noise = EstimateNoise(measurement, residual, bench->used);
    bench->sigma = noise.sigma;
    WidenByRounding(measurement, noise, bench);
    const bool exact = *std::max_element(noise.sigma.begin(), noise.sigma.end()) <
                       10 * kSmallestNoise;  // computed readings: what is left is arithmetic
    if (exact) bench->least_variance = 1;
    LawFit again = FitLaw(*bench, fit->law, fit->p);
    if (again.usable) *fit = std::move(again);
  }
  return noise;
}

}  // namespace lyrefit
