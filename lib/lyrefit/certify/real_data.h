#pragma once

#include "lyrefit/certify/interval.h"
#include "lyrefit/certify/mixture.h"

namespace lyrefit {

// The data of a mixture for code that is written once for doubles and for intervals.

template <class Real>
ArrayOf<Real> RealArray(const Eigen::VectorXd& values) {
  return values.array().template cast<Real>();
}

// V + Rs I.
template <class Real>
ArrayOf<Real> JunctionVoltage(const MixtureData& data, double rs) {
  return RealArray<Real>(data.voltage_V) + Real(rs) * RealArray<Real>(data.current_A);
}

// The residuals' weights times `y`; weights of 1 round nothing.
template <class Real>
ArrayOf<Real> WeightedArray(const MixtureData& data, const Eigen::VectorXd& y) {
  ArrayOf<Real> weighted = RealArray<Real>(data.weight) * RealArray<Real>(y);
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    if (data.weight[k] == 1) weighted[k] = Real(y[k]);
  }
  return weighted;
}

}  // namespace lyrefit
