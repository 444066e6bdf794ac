#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lyrefit/model/kernel.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {

// Expects bit-identical currents from all kernels, and agreement with the scalar solver to 1e-12 of
// |I| + Iph.
inline void ExpectKernelsAgree(const Device& device, const std::vector<double>& p,
                               const std::vector<double>& voltage_V) {
  const std::vector<double> first =
      SolveCurrents(device, p.data(), voltage_V, AvailableKernels()[0]);
  for (std::size_t k = 0; k < voltage_V.size(); ++k) {
    const double scalar = SolveOperatingPoint(device, p.data(), voltage_V[k]).current_A;
    ASSERT_NEAR(first[k], scalar, 1e-12 * (std::fabs(scalar) + p[kIph]));
  }
  for (const Kernel& kernel : AvailableKernels()) {
    ASSERT_EQ(SolveCurrents(device, p.data(), voltage_V, kernel), first) << kernel.name;
  }
}

}  // namespace lyrefit
