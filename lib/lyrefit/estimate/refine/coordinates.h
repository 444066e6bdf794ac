#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

#include "lyrefit/base/dense.h"
#include "lyrefit/estimate/refine/model.h"

namespace lyrefit {

// Coordinates of a fit, one for every parameter that is free to move, scaled so that none depends
// strongly on another:
//   photocurrents, series, plain   linear, in units of I0, of R0 = V0 / I0, of the step
//   ideality                       1 / n
//   shunt                          R0 / Rsh, so that a perfect shunt is 0
//   dark shunt                     Rsh / Rsh0, between exp(-Rexp) and 1; at a bound it
//                                  keeps that ratio
//   saturation current             ln(Is / I0) + V / (n Ns Vt), the logarithm of the diode's
//                                  current at V, its own voltage at V0 for the parameters passed
//                                  to the constructor
// Each coordinate changes one parameter, with two exceptions: the saturation current also depends
// on its n, and the dark shunt on its shunt.
class Coordinates {
 public:
  Coordinates(const ModelShape& shape, std::vector<double> p, std::vector<bool> active);

  int size() const { return static_cast<int>(moving_.size()); }
  int parameter(int coordinate) const { return moving_[coordinate]; }

  // Coordinates of the parameters passed to the constructor.
  std::vector<double> Start() const;
  void ToParameters(const double* theta, double* p) const;

  // Derivatives of the parameters by the coordinates at parameters `p`; zeros are left out.
  struct Slope {
    int parameter;
    int coordinate;
    double value;
  };
  std::vector<Slope> Slopes(const double* p) const;

  // Bounds of a coordinate; infinite for a saturation current whose n is free.
  double lower(int coordinate) const { return lower_[coordinate]; }
  double upper(int coordinate) const { return upper_[coordinate]; }

  // The parameter of a coordinate alone, linear in the coordinates: the logarithm of a saturation
  // current, otherwise the coordinate. OwnLower and OwnUpper are its bounds.
  double Own(int coordinate, const std::vector<double>& theta) const;
  double OwnLower(int coordinate) const;
  double OwnUpper(int coordinate) const;

  // Exact parameter value at a coordinate's lower or upper bound, the other parameters at `p`.
  double AtBound(int coordinate, bool lower, const std::vector<double>& p) const;

  // Whether a point is near enough to its bounds to be evaluated. A solve without bounds may step
  // over a bound (the parameter is then set to that bound), but not to currents that overflow.
  bool Sane(const double* theta) const;

 private:
  double Forward(int i, double value) const;
  double OwnForward(int i, double value) const;
  bool Moves(int i) const { return slot_[i] >= 0; }
  bool FollowsShunt(int i) const;

  const ModelShape* shape_;
  std::vector<double> p_;
  double pivot_;             // V / (Ns Vt)
  std::vector<int> moving_;  // parameter of each coordinate
  std::vector<int> slot_;    // coordinate of each parameter, -1 at an active bound
  std::vector<double> lower_;
  std::vector<double> upper_;
};

// Bounds of a parameter, the others at `p`. Those of a dark shunt are relative to its shunt.
ParameterRange BoundsAt(const ModelShape& shape, int i, const std::vector<double>& p);

// Ceres writes to the log if it receives a number that is not finite; this check comes before.
inline bool AllFinite(const double* x, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    if (!std::isfinite(x[k])) return false;
  }
  return true;
}

// Residuals of a block in units of `unit_A` at the coordinates `theta`. If requested, also their
// derivatives row by row by the coordinates (`slopes`) and by the block's local unknowns
// (`local_slopes`). False if the model cannot be evaluated or a number is not finite.
bool EvaluateBlock(const FitModel& model, const Coordinates& coordinates, int block,
                   const double* theta, const double* local, double unit_A, double* residuals,
                   double* slopes, double* local_slopes);

// All residuals of a model in ampere and their derivatives at a point. Blocks that cannot be
// evaluated are 0.
struct Linearization {
  Eigen::VectorXd residual;
  RowMatrix jacobian;             // residuals x coordinates of the free parameters
  std::vector<RowMatrix> local;   // of each block: its residuals x its local unknowns
  std::vector<int> first_row;     // of each block
  std::vector<int> parameter;     // parameter of each column of `jacobian`
  Eigen::MatrixXd natural_slope;  // derivatives of the parameters by the coordinates
};

Linearization Linearize(const FitModel& model, const FitPoint& point,
                        const std::vector<bool>& active);

}  // namespace lyrefit
