#pragma once

#include <memory>
#include <vector>

#include "lyrefit/diagnose/measurement.h"

namespace lyrefit {

// Noise of a reading, in current scales: sd^2 = constant^2 + (relative I)^2 + (voltage dI/dV)^2.
// Lit and dark curves have separate parameters. The voltage term (V per cell) is used only if it
// raises the likelihood clearly.
struct NoiseLaw {
  double constant = 0;
  double relative = 0;
  double voltage = 0;
};

// Smallest noise of a reading, in current scales.
constexpr double kSmallestNoise = 1e-7;

// Whether the voltage term is part of the model. Null statistics use the choice made for the data.
enum class VoltageNoise { kIfInsisted, kAlways, kNever };

struct Noise {
  NoiseLaw lit;
  NoiseLaw dark;
  std::vector<double> sigma;  // of each reading
};

// Estimates noise from second differences of residuals within each monotone stretch, which are
// insensitive to smooth misfit. Noise stated in the notes fixes the ratio of the terms, never the
// size. The object is built once per measurement and reused for many residuals, as by null
// statistics. The measurement must outlive it.
class NoiseEstimator {
 public:
  NoiseEstimator(const Measurement& measurement, const std::vector<char>& used,
                 VoltageNoise voltage = VoltageNoise::kIfInsisted);
  ~NoiseEstimator();
  NoiseEstimator(const NoiseEstimator&) = delete;
  NoiseEstimator& operator=(const NoiseEstimator&) = delete;

  Noise Estimate(const std::vector<double>& residual) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// One estimate, without reuse of the estimator.
Noise EstimateNoise(const Measurement& measurement, const std::vector<double>& residual,
                    const std::vector<char>& used,
                    VoltageNoise voltage = VoltageNoise::kIfInsisted);

// A current grid with steps above this number of noise deviations is coarse and becomes a finding.
constexpr double kCoarseGrid = 2.1;
bool IsCoarse(const Measurement& measurement, const Noise& noise);
// Whether voltage bins, times dI/dV in the steep part of the curve, exceed the limit kCoarseGrid.
bool HasCoarseBins(const Measurement& measurement, const Noise& noise);

// Lag-1 correlation of whitened residuals after removal of their smooth part, and its standard
// error.
struct Autocorrelation {
  double value = 0;
  double standard_error = 1;
};
Autocorrelation EstimateAutocorrelation(const Readings& readings,
                                        const std::vector<double>& residual,
                                        const std::vector<char>& used, int parameters);

}  // namespace lyrefit
