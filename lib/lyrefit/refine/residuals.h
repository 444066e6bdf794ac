#pragma once

#include <vector>

#include "lyrefit/refine/coordinates.h"

namespace lyrefit {

// Widest dual number of the polish: every model fits, so one pass gives all derivatives.
constexpr int kJetWidth = 10;

// sqrt(weight) x residual of every point in units of `unit_A`, and its derivatives with respect to
// the coordinates. The solved current comes from the kernel and its derivatives follow from the
// implicit function theorem: those of the explicit right-hand side at the root, divided by
// 1 - Rs F'. Differentiating the Newton iteration would cost more and be less exact.
class CurveResiduals {
 public:
  // At most kJetWidth coordinates. Keeps references.
  CurveResiduals(const RefineProblem& problem, const Coordinates& coordinates, double unit_A)
      : problem_(problem), coordinates_(coordinates), unit_A_(unit_A) {}

  // `residuals` of all points at the coordinates `theta` and, where `jacobian` is given, their
  // derivatives row by row. False where the model cannot be evaluated.
  bool Evaluate(const double* theta, double* residuals, double* jacobian) const;

 private:
  bool Differentiate(const double* theta, const std::vector<double>& at, double* residuals,
                     double* jacobian) const;

  const RefineProblem& problem_;
  const Coordinates& coordinates_;
  double unit_A_;
};

}  // namespace lyrefit
