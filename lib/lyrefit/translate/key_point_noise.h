#pragma once

#include <cstdint>
#include <vector>

#include "lyrefit/curve/key_points.h"
#include "lyrefit/translate/procedures.h"
#include "lyrefit/translate/uncertainty.h"

namespace lyrefit {

// Isc, Voc, Imp, Vmp, Pmax, FF: the outputs of every translation, in this order, and a vector of
// the key points in this order.
std::vector<OutputQuantity> KeyPointQuantities();
constexpr int kMaxPowerOutput = 4;
std::vector<double> KeyPointVector(const KeyPoints& key);

// Noise of the key points due to the noise of the readings, by a parametric bootstrap. `current_A`
// is a smooth curve through the readings, the fitted model: about the readings themselves, the
// noise that selects the highest one would count twice. `sigma_A` and `sigma_V` are standard
// deviations of each reading's current and voltage; an empty `sigma_V` is none. The noise depends
// on `method`: interpolated key points use only a few readings each.
struct KeyPointNoise {
  std::vector<std::vector<double>> relative_covariance;  // relative to the key points
  std::vector<double> relative_bias;  // mean of the draws minus the smooth curve's, relative
  int draws = 0;
  int failed = 0;  // draws that lack a key point of the smooth curve
};
KeyPointNoise EstimateKeyPointNoise(const std::vector<double>& voltage_V,
                                    const std::vector<double>& current_A,
                                    const std::vector<double>& sigma_A,
                                    const std::vector<double>& sigma_V, int draws,
                                    std::uint64_t seed,
                                    KeyPointMethod method = KeyPointMethod::kInterpolated);

// Key-point noise of a prepared curve about its single diode, or about its readings without a fit,
// with the noise `noise_A` of the fit.
KeyPointNoise NoiseOfCurve(const PreparedCurve& curve, std::uint64_t seed);

// The budget term of noise: the relative noise at the measured conditions, applied to `translated`.
// A translation scales key points smoothly, so its effect on noise is of second order.
OutputTerm NoiseTerm(const KeyPointNoise& noise, const std::vector<double>& translated);

}  // namespace lyrefit
