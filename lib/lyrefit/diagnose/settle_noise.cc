#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/median.h"
#include "lyrefit/diagnose/select.h"

namespace lyrefit {
namespace {

// Standard deviation of the rounding errors of each reading, for grids much coarser than the noise:
// neighbours share such errors. Empty if there is no coarse grid.
std::vector<double> CoarseRounding(const Measurement& measurement, const Noise& noise) {
  const ValueFindings& values = measurement.values;
  std::vector<double> rounding;
  const auto add = [&](const std::vector<double>& by, double shared) {
    rounding.resize(by.size(), 0.0);
    for (std::size_t k = 0; k < by.size(); ++k) {
      rounding[k] = std::hypot(rounding[k], std::sqrt(shared) * by[k]);
    }
  };
  if (IsCoarse(measurement, noise)) add(values.rounding, 1);
  if (HasCoarseBins(measurement, noise)) add(values.bin_rounding, values.bins_shared);
  return rounding;
}

// Root mean square of a fit's residuals, without the part that rounding explains.
double Misfit(const WeightedData& weighted, const std::vector<double>& residual,
              const std::vector<double>& rounding) {
  constexpr double kReach = 2;
  double sum = 0;
  for (std::size_t k = 0; k < residual.size(); ++k) {
    const double by_rounding = rounding.empty() ? 0 : kReach * rounding[k];
    const double beyond = residual[k] * residual[k] - by_rounding * by_rounding;
    if (weighted.used[k] != 0) sum += std::max(beyond, 0.0);
  }
  return std::sqrt(sum / std::max(weighted.count(), 1));
}

// With a large misfit, steps that a fit does not follow would count as noise where readings are
// few. All sigmas are then set to one value.
void LevelNoise(WeightedData* weighted, double misfit) {
  constexpr double kRuined = 0.01, kByFar = 3, kUsual = 1.5e-3;
  const double middle = UpperMedian(weighted->sigma);
  if (misfit < kRuined || misfit < kByFar * middle) return;
  weighted->sigma.assign(weighted->sigma.size(), std::max(kUsual, std::min(middle, 0.3 * misfit)));
}

void Widen(const std::vector<double>& rounding, WeightedData* weighted) {
  if (rounding.empty()) return;
  weighted->least_variance = 1;
  for (std::size_t k = 0; k < rounding.size(); ++k) {
    weighted->sigma[k] = std::hypot(weighted->sigma[k], rounding[k]);
  }
}

// Uses the sigma that the file states for each current.
void TakeStatedSigma(const Measurement& measurement, WeightedData* weighted) {
  for (std::size_t k = 0; k < weighted->sigma.size(); ++k) {
    weighted->sigma[k] = std::max(measurement.stated_sigma[k], kSmallestNoise);
  }
}

// Uses error sizes from the options. Errors of the voltage enter by the slope of the fitted curve.
void TakeStated(const Measurement& measurement, const LawFit& fit, WeightedData* weighted) {
  const ErrorSizes& sizes = measurement.errors.sizes;
  const std::vector<Reading>& points = measurement.readings.points;
  const ReadingScale& scale = measurement.readings.scale;
  const double voltage = sizes.voltage_V / scale.cells / measurement.readings.pivot_voltage;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t a = k > 0 ? k - 1 : k, b = k + 1 < points.size() ? k + 1 : k;
    const double span = points[b].voltage - points[a].voltage;
    const double slope = span != 0 ? (fit.current[b] - fit.current[a]) / span : 0;
    weighted->sigma[k] =
        std::max(std::hypot(sizes.current_A / scale.current_A, voltage * points[k].voltage * slope),
                 kSmallestNoise);
  }
  weighted->path = sizes.path;
  weighted->path_length = sizes.length;
}

}  // namespace

Noise TakeNoise(const Measurement& measurement, const LawFit& fit, WeightedData* weighted) {
  const Readings& readings = measurement.readings;
  std::vector<double> residual(readings.points.size());
  for (std::size_t k = 0; k < residual.size(); ++k) {
    residual[k] = fit.current[k] - readings.points[k].current;
  }
  Noise noise = EstimateNoise(measurement, residual, weighted->used);
  weighted->sigma = noise.sigma;
  const std::vector<double> rounding = CoarseRounding(measurement, noise);
  const bool exact = *std::max_element(noise.sigma.begin(), noise.sigma.end()) <
                     10 * kSmallestNoise;  // simulated readings: arithmetic rounding only
  if (exact) weighted->least_variance = 1;
  const bool stated = measurement.errors.kind == ErrorKind::kStated;
  if (measurement.has_path()) {
    weighted->least_variance = 1;
    if (stated) {
      TakeStated(measurement, fit, weighted);
    } else if (measurement.stated_sigma.empty()) {
      LevelNoise(weighted, Misfit(*weighted, residual, rounding));
    } else {
      TakeStatedSigma(measurement, weighted);
    }
  }
  if (!stated) Widen(rounding, weighted);
  for (std::size_t k = 0; k < weighted->sigma.size(); ++k)
    weighted->sigma[k] = std::hypot(weighted->sigma[k], TraceError(readings.points, k));
  return noise;
}

SettledFit SettleNoise(const Measurement& measurement, WeightedData weighted, LawFit fit) {
  const bool stated = measurement.errors.kind == ErrorKind::kStated;
  Noise noise;
  for (int round = 0; round < 2; ++round) {
    noise = TakeNoise(measurement, fit, &weighted);
    if (measurement.has_path() && !stated) weighted.path = FindPath(weighted, fit);
    LawFit again = FitLaw(weighted, fit.law, fit.p);
    if (again.usable) fit = std::move(again);
  }
  return {std::move(weighted), std::move(fit), std::move(noise)};
}

}  // namespace lyrefit
