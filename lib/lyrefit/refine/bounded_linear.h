#pragma once

#include <Eigen/Core>

namespace lyrefit {

// Largest number of linear unknowns: Iph, 1/Rsh and one per diode, with some to spare.
constexpr int kMostLinear = 8;
using SmallMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostLinear, kMostLinear>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostLinear, 1>;

// Minimises |A x - b|^2 over lower <= x <= upper, given the Gram matrix G = A'A and A'b. Active-set
// method for a few variables (Stark and Parker 1995, "Bounded-variable least squares", on the
// normal equations). Columns should be scaled to similar length. Returns x; the objective less
// |b|^2 is x'G x - 2 x'A'b.
SmallVector SolveBoundedLinear(const SmallMatrix& gram, const SmallVector& atb,
                               const SmallVector& lower, const SmallVector& upper);

}  // namespace lyrefit
