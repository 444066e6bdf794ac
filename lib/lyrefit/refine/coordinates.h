#pragma once

#include <vector>

#include "lyrefit/refine/model.h"

namespace lyrefit {

// The coordinates in which a fit moves, one for every parameter that is not held, scaled so that
// none depends strongly on another:
//   photocurrents, series, plain   linear, in parts of I0, of R0 = V0 / I0, of the step
//   ideality                       1 / n
//   shunt                          R0 / Rsh, so that a perfect shunt is 0
//   dark shunt                     Rsh / Rsh0, between exp(-Rexp) and 1; held, but not fixed, it
//                                  keeps that ratio
//   saturation current             ln(Is / I0) + V0 / (n Ns Vt), the logarithm of the diode's
//                                  current at V0
// So each coordinate touches one parameter, but that the saturation current follows its n and the
// dark shunt its shunt.
class Coordinates {
 public:
  Coordinates(const ModelShape& shape, std::vector<double> p, std::vector<bool> held);

  int size() const { return static_cast<int>(moving_.size()); }
  int parameter(int coordinate) const { return moving_[coordinate]; }

  // Coordinates of the parameters it was made at.
  std::vector<double> Start() const;
  void ToParameters(const double* theta, double* p) const;

  // Derivatives of the parameters by the coordinates that are not 0, at parameters `p`.
  struct Slope {
    int parameter;
    int coordinate;
    double value;
  };
  std::vector<Slope> Slopes(const double* p) const;

  // Bounds of a coordinate; infinite where it has none, as a saturation current while its n moves.
  double lower(int coordinate) const { return lower_[coordinate]; }
  double upper(int coordinate) const { return upper_[coordinate]; }

  // The parameter of a coordinate by itself, linear in the coordinates (a saturation current: its
  // logarithm; the others: the coordinate), and its bounds there.
  double Own(int coordinate, const std::vector<double>& theta) const;
  double OwnLower(int coordinate) const;
  double OwnUpper(int coordinate) const;

  // What parameter a coordinate's lower or upper bound stands for, exactly, the others at `p`.
  double AtBound(int coordinate, bool lower, const std::vector<double>& p) const;

  // Whether a point is near enough to its bounds to be worth evaluating: a free solve may step over
  // a bound (its parameter is then held there), but not into regions where currents overflow.
  bool Sane(const double* theta) const;

 private:
  double Forward(int i, double value) const;
  double OwnForward(int i, double value) const;
  double Pivot() const { return shape_->voltage_scale_V / shape_->thermal_voltage_V; }
  bool Moves(int i) const { return slot_[i] >= 0; }
  bool FollowsShunt(int i) const;

  const ModelShape* shape_;
  std::vector<double> p_;
  std::vector<int> moving_;  // parameter of each coordinate
  std::vector<int> slot_;    // coordinate of each parameter, -1 where held
  std::vector<double> lower_;
  std::vector<double> upper_;
};

// Bounds of a parameter with the others at `p`: its own; a dark shunt's are relative to its shunt.
ParameterRange BoundsAt(const ModelShape& shape, int i, const std::vector<double>& p);

}  // namespace lyrefit
