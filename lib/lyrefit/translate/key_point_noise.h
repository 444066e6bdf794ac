#pragma once

#include <cstdint>
#include <vector>

#include "lyrefit/curve/key_points.h"
#include "lyrefit/translate/procedures.h"
#include "lyrefit/translate/uncertainty.h"

namespace lyrefit {

// Isc, Voc, Imp, Vmp, Pmax, FF: the results of every translation, in this order, and the key points
// as a vector of them.
std::vector<OutputQuantity> KeyPointQuantities();
constexpr int kMaxPowerOutput = 4;
std::vector<double> KeyPointVector(const KeyPoints& key);

// What the noise of the readings does to the key points: a parametric bootstrap. `current_A` is a
// smooth curve through the readings (the fitted model; the readings themselves double the noise
// that decides which one is the highest), `sigma_A` the standard deviation of every reading, as
// `sigma_V` of the voltages (empty: none). Key points by `method` have the noise of that method:
// interpolated ones lean on a few readings each.
struct KeyPointNoise {
  std::vector<std::vector<double>> relative_covariance;  // in parts of the key points
  std::vector<double> relative_bias;  // mean of the draws less the smooth curve's, in parts
  int draws = 0;
  int failed = 0;  // draws without one of the key points that the smooth curve has
};
KeyPointNoise EstimateKeyPointNoise(const std::vector<double>& voltage_V,
                                    const std::vector<double>& current_A,
                                    const std::vector<double>& sigma_A,
                                    const std::vector<double>& sigma_V, int draws,
                                    std::uint64_t seed,
                                    KeyPointMethod method = KeyPointMethod::kInterpolated);

// The same of a curve made ready: about its single diode (about the readings where there is none),
// with the noise that was found there.
KeyPointNoise NoiseOfCurve(const PreparedCurve& curve, std::uint64_t seed);

// The line of a budget: the noise at the conditions of the measurement, in parts, carried over to
// `translated` as it is. A translation scales key points smoothly; what it adds to noise is of
// second order.
OutputTerm NoiseTerm(const KeyPointNoise& noise, const std::vector<double>& translated);

}  // namespace lyrefit
