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

// Root mean square of a fit's residuals.
double Misfit(const Workbench& bench, const std::vector<double>& residual) {
  double sum = 0;
  for (std::size_t k = 0; k < residual.size(); ++k) {
    if (bench.used[k] != 0) sum += residual[k] * residual[k];
  }
  return std::sqrt(sum / std::max(bench.count(), 1));
}

// Steps that a fit does not follow would pass for noise wherever there are few readings.
void LevelNoise(Workbench* bench, const std::vector<double>& residual) {
  constexpr double kRuined = 0.01, kByFar = 3, kUsual = 1.5e-3;
  std::vector<double> sorted = bench->sigma;
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  const double middle = sorted[sorted.size() / 2], misfit = Misfit(*bench, residual);
  if (misfit < kRuined || misfit < kByFar * middle) return;
  bench->sigma.assign(bench->sigma.size(), std::max(kUsual, std::min(middle, 0.3 * misfit)));
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
    if (measurement.has_path) {
      bench->least_variance = 1;
      LevelNoise(bench, residual);
      bench->path = FindPath(*bench, *fit);
    }
    LawFit again = FitLaw(*bench, fit->law, fit->p);
    if (again.usable) *fit = std::move(again);
  }
  return noise;
}

}  // namespace lyrefit
