#include "lyrefit/estimate/refine/newton_ascent.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "lyrefit/base/dense.h"

namespace lyrefit {
namespace {

using Function = std::function<double(const std::vector<double>&)>;

struct Surroundings {
  double value = 0;
  Eigen::VectorXd slope;
  Eigen::MatrixXd curvature;
};

Surroundings LookAround(const Function& value, const std::vector<double>& at, double value_there) {
  constexpr double kStep = 0.05;
  const int size = static_cast<int>(at.size());
  const auto beside = [&](int i, double a, int j, double b) {
    std::vector<double> there = at;
    there[i] += a;
    there[j] += b;
    return value(there);
  };
  Surroundings found;
  found.value = value_there;
  found.slope.resize(size);
  found.curvature.resize(size, size);
  std::vector<double> up(size);
  for (int i = 0; i < size; ++i) {
    up[i] = beside(i, kStep, i, 0);
    const double down = beside(i, -kStep, i, 0);
    found.slope[i] = (up[i] - down) / (2 * kStep);
    found.curvature(i, i) = (up[i] - 2 * found.value + down) / (kStep * kStep);
    for (int j = 0; j < i; ++j) {
      const double both = beside(i, kStep, j, kStep);
      const double mixed = (both - up[i] - up[j] + found.value) / (kStep * kStep);
      found.curvature(i, j) = found.curvature(j, i) = mixed;
    }
  }
  return found;
}

}  // namespace

Eigen::MatrixXd CurvatureAt(const Function& value, const std::vector<double>& at) {
  return LookAround(value, at, value(at)).curvature;
}

std::vector<double> NewtonAscent(const Function& value, std::vector<double> at, int most_steps) {
  constexpr double kLongest = 2;     // step in any one coordinate
  constexpr double kSettled = 3e-3;  // step in any one coordinate at convergence
  const auto size = static_cast<Eigen::Index>(at.size());
  double value_there = value(at);
  for (int step = 0; step < most_steps; ++step) {
    const Surroundings here = LookAround(value, at, value_there);
    bool moved = false;
    double length = 0;
    for (double damping = 0; damping < 1e6 && !moved; damping = std::max(4 * damping, 0.1)) {
      Eigen::VectorXd way;
      const Eigen::MatrixXd damped =
          damping * Eigen::MatrixXd::Identity(size, size) - here.curvature;
      if (!SolvePositive(damped, here.slope, &way)) continue;
      length = way.cwiseAbs().maxCoeff();
      if (length > kLongest) way *= kLongest / length;
      std::vector<double> there = at;
      for (Eigen::Index i = 0; i < size; ++i) there[i] += way[i];
      value_there = value(there);
      moved = value_there >= here.value;
      if (moved) at = std::move(there);
    }
    if (!moved || length < kSettled) break;
  }
  return at;
}

}  // namespace lyrefit
