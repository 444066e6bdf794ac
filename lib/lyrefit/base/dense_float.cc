// The single-precision functions of dense.h, which generate and score simulated noise.

#include <cmath>

#include "lyrefit/base/dense.h"

namespace lyrefit {

using Eigen::MatrixXf;
using Eigen::VectorXf;

MatrixXf Times(const MatrixXf& a, const MatrixXf& b) { return a * b; }
VectorXf Times(const MatrixXf& a, const VectorXf& x) { return a * x; }

MatrixXf TransposedTimes(const MatrixXf& a, const MatrixXf& b) { return a.transpose() * b; }
VectorXf TransposedTimes(const MatrixXf& a, const VectorXf& x) { return a.transpose() * x; }

MatrixXf OrthonormalUnder(const MatrixXf& a, const VectorXf& weight) {
  MatrixXf b = a;
  for (Eigen::Index j = 0; j < b.cols(); ++j) {
    for (Eigen::Index i = 0; i < j; ++i) {
      const float along = (weight.array() * b.col(i).array() * b.col(j).array()).sum();
      b.col(j) -= along * b.col(i);
    }
    b.col(j) /= std::sqrt((weight.array() * b.col(j).array().square()).sum());
  }
  return b;
}

}  // namespace lyrefit
