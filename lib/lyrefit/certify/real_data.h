#pragma once

#include "lyrefit/certify/interval.h"
#include "lyrefit/certify/mixture.h"

namespace lyrefit {

// Data of a mixture as arrays of `Real`, for templates over double and Interval.

template <class Real>
ArrayOf<Real> RealArray(const Eigen::VectorXd& values) {
  return values.array().template cast<Real>();
}

// Junction voltages V + Rs I, in volt.
template <class Real>
ArrayOf<Real> JunctionVoltage(const MixtureData& data, double rs) {
  return RealArray<Real>(data.voltage_V) + Real(rs) * RealArray<Real>(data.current_A);
}

// The weights of the residuals times `y`. Weights of 1 leave `y` exact.
template <class Real>
ArrayOf<Real> WeightedArray(const MixtureData& data, const Eigen::VectorXd& y) {
  ArrayOf<Real> weighted = RealArray<Real>(data.weight) * RealArray<Real>(y);
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    if (data.weight[k] == 1) weighted[k] = Real(y[k]);
  }
  return weighted;
}

}  // namespace lyrefit
