#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace lyrefit {

// Maximises a smooth function of a few logarithms from `at` by Newton steps, with derivatives by
// differences. Steps are damped until the function rises; at most `most_steps`. The function
// returns -infinity where it is undefined.
std::vector<double> NewtonAscent(const std::function<double(const std::vector<double>&)>& value,
                                 std::vector<double> at, int most_steps);

// The second derivatives of such a function at a point, by differences.
Eigen::MatrixXd CurvatureAt(const std::function<double(const std::vector<double>&)>& value,
                            const std::vector<double>& at);

}  // namespace lyrefit
