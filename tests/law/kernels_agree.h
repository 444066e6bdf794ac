#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lyrefit/law/current.h"
#include "lyrefit/law/kernel.h"

namespace lyrefit {

// Every kernel gives the bits of the first, and that one the currents of the scalar solver.
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
