#pragma once

#include <memory>
#include <vector>

#include "lyrefit/diagnose/measurement.h"

namespace lyrefit {

// Noise of the readings, in current scales: sd^2 = constant^2 + (relative I)^2 + (voltage dI/dV)^2,
// of lit and of dark curves apart. Noise of the voltage (per cell) is believed only where the data
// insist.
struct NoiseLaw {
  double constant = 0;
  double relative = 0;
  double voltage = 0;
};

// No reading is believed to be better than this.
constexpr double kSmallestNoise = 1e-7;

// Whether noise of the voltage is one of the parts: for null_statistics it is what the data had.
enum class VoltageNoise { kIfInsisted, kAlways, kNever };

struct Noise {
  NoiseLaw lit;
  NoiseLaw dark;
  std::vector<double> sigma;  // of each reading
};

// From second differences of the residuals inside each monotone stretch, which smooth misfit does
// not reach. Noise that the notes state decides the shape, never the size. The readings stay
// what they are: for many residuals of one measurement, as null_statistics have them. The measurement
// outlives it.
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

// The same, once.
Noise EstimateNoise(const Measurement& measurement, const std::vector<double>& residual,
                    const std::vector<char>& used,
                    VoltageNoise voltage = VoltageNoise::kIfInsisted);

// A grid coarser than this many noise deviations is a finding.
constexpr double kCoarseGrid = 2.1;
bool IsCoarse(const Measurement& measurement, const Noise& noise);
// The same of voltages in bins, where the curve is steep.
bool HasCoarseBins(const Measurement& measurement, const Noise& noise);

// Lag-1 correlation of whitened residuals with their smooth part removed, and its standard error.
struct Autocorrelation {
  double value = 0;
  double standard_error = 1;
};
Autocorrelation EstimateAutocorrelation(const Readings& readings,
                                        const std::vector<double>& residual,
                                        const std::vector<char>& used, int parameters);

}  // namespace lyrefit
