#include "lyrefit/estimate/fit/error_degrees.h"

#include <algorithm>
#include <cmath>

namespace lyrefit {

std::vector<int> FindDegrees(const FoundErrors& found, const ErrorsAt& standard_errors, int most) {
  constexpr double kStep = 0.1;  // step of ln size
  constexpr int kFewest = 3;
  constexpr double ErrorSizes::*kSizes[] = {&ErrorSizes::current_A, &ErrorSizes::voltage_V,
                                            &ErrorSizes::path, &ErrorSizes::length,
                                            &ErrorSizes::current_part};
  using Slopes = Eigen::Matrix<double, 5, 1>;
  std::vector<Slopes> slopes;  // d ln variance / d ln sizes, per estimate
  for (int j = 0; j < 5; ++j) {
    if (!(found.sizes.*kSizes[j] > 0)) continue;
    const auto beside = [&](double step) {
      ErrorSizes there = found.sizes;
      there.*kSizes[j] *= std::exp(step);
      return standard_errors(there);
    };
    const std::vector<double> up = beside(kStep), down = beside(-kStep);
    slopes.resize(up.size(), Slopes::Zero());
    for (std::size_t i = 0; i < up.size(); ++i) slopes[i][j] = std::log(up[i] / down[i]) / kStep;
  }
  std::vector<int> degrees;
  for (const Slopes& slope : slopes) {
    const double variance = slope.dot(found.uncertainty * slope);  // variance of ln variance
    const bool well_known = !std::isfinite(variance) || variance * most < 2;
    const int few = std::min(kFewest, most);
    degrees.push_back(well_known ? most : std::max(static_cast<int>(2 / variance), few));
  }
  return degrees;
}

}  // namespace lyrefit
