#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace lyrefit {

// Newton's steps uphill from `at`, by differences and shortened until they lead there, on a smooth
// function of a handful of logarithms; at most so many steps. -infinity where there is no value.
std::vector<double> NewtonAscent(const std::function<double(const std::vector<double>&)>& value,
                          std::vector<double> at, int most_steps);

// The second derivatives of such a function, by differences.
Eigen::MatrixXd CurvatureAt(const std::function<double(const std::vector<double>&)>& value,
                            const std::vector<double>& at);

}  // namespace lyrefit
