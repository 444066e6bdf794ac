#include <algorithm>
#include <cmath>

#include "lyrefit/diagnose/select.h"

namespace lyrefit {
namespace {

// A grid much coarser than the noise leaves errors that neighbours share.
void WidenByRounding(const Measurement& measurement, const Noise& noise, Workbench* bench) {
  const ValueFindings& values = measurement.values;
  const auto widen = [&](const std::vector<double>& by) {
    bench->least_variance = 1;
    for (std::size_t k = 0; k < by.size(); ++k)
      bench->sigma[k] = std::hypot(bench->sigma[k], by[k]);
  };
  if (IsCoarse(measurement, noise)) widen(values.rounding);
  if (HasCoarseBins(measurement, noise)) widen(values.bin_rounding);
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

// What the file says of each current is believed.
void TakeStatedSigma(const Measurement& measurement, Workbench* bench) {
  for (std::size_t k = 0; k < bench->sigma.size(); ++k) {
    bench->sigma[k] = std::max(measurement.stated_sigma[k], kSmallestNoise);
  }
}

// And so are sizes that somebody knows. The voltage's errors show by the slope of the fitted curve.
void TakeStated(const Measurement& measurement, const LawFit& fit, Workbench* bench) {
  const ErrorSizes& sizes = measurement.errors.sizes;
  const std::vector<Reading>& points = measurement.readings.points;
  const ReadingScale& scale = measurement.readings.scale;
  const double voltage = sizes.voltage_V / scale.cells / measurement.readings.pivot_voltage;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t a = k > 0 ? k - 1 : k, b = k + 1 < points.size() ? k + 1 : k;
    const double span = points[b].voltage - points[a].voltage;
    const double slope = span != 0 ? (fit.current[b] - fit.current[a]) / span : 0;
    bench->sigma[k] =
        std::max(std::hypot(sizes.current_A / scale.current_A, voltage * points[k].voltage * slope),
                 kSmallestNoise);
  }
  bench->path = sizes.path;
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
    if (measurement.has_path()) {
      bench->least_variance = 1;
      if (measurement.errors.kind == ErrorKind::kStated) {
        TakeStated(measurement, *fit, bench);
      } else {
        if (measurement.stated_sigma.empty()) {
          LevelNoise(bench, residual);
        } else {
          TakeStatedSigma(measurement, bench);
        }
        bench->path = FindPath(*bench, *fit);
      }
    }
    LawFit again = FitLaw(*bench, fit->law, fit->p);
    if (again.usable) *fit = std::move(again);
  }
  return noise;
}

}  // namespace lyrefit
