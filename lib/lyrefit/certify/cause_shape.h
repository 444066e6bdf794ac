#pragma once

#include <Eigen/Core>
#include <functional>

#include "lyrefit/base/numbers.h"

namespace lyrefit {

// A closed range of values.
struct Span {
  double lower = 0;
  double upper = 0;
};

// A cause is a loss mechanism whose current is linear in its strength. It reduces the terminal
// current by strength x value(v, theta), with v the junction voltage of the whole device in volt
// and theta one parameter of its own. `value` is 0 at 0 V, never falls with v, and is convex at
// forward voltages. `slopes` and `bends` are ranges over all v and theta of two spans. They are
// infinite where there is no bound.
struct CauseShape {
  Span theta;              // range of theta; equal ends: the shape has no parameter
  double strongest_A = 0;  // largest strength
  std::function<double(double v, double theta)> value;
  std::function<double(double v, double theta)> slope;  // derivative by v
  std::function<Span(Span v, Span theta)> slopes;       // range of the slope
  std::function<Span(Span v, Span theta)> bends;        // range of the second derivative by v
  // Range of the second derivative by theta at one v; may be empty if the shape has no parameter.
  std::function<Span(double v, Span theta)> theta_bends;

  Eigen::VectorXd Values(const Eigen::VectorXd& v, double at) const {
    return v.unaryExpr([&](double x) { return value(x, at); });
  }
  Eigen::VectorXd Slopes(const Eigen::VectorXd& v, double at) const {
    return v.unaryExpr([&](double x) { return slope(x, at); });
  }
};

// Collection loss that grows with the voltage: 1 / (Vbi - v / cells) - 1 / Vbi, with Vbi = 0.9 V.
// Above 0.87 V per cell the curve continues along its tangent. The constant part cannot be
// distinguished from the photocurrent. Strengths go up to 0.3 of `photocurrent_A`.
CauseShape CollectionShape(int cells, double photocurrent_A);

// A diode with the given u = 1 / (n Ns Vt): its current at v relative to its current at `pivot_V`.
// Strengths go up to `strongest_A`.
CauseShape DiodeShape(double u, double pivot_V, double strongest_A);

// A non-ohmic shunt: sign(v) |v / reach_V|^theta. The span of exponents `theta` starts above 1.
CauseShape PowerShape(double reach_V, Span theta, double strongest_A);

// Upper bounds of the pull -value(v, theta) . z of a shape along a dual vector z, over all theta of
// a span and at one Rs. `v` and `z` have one element per point. Inside the span the pull exceeds
// its larger end value by at most `bulge`.
struct ShapePull {
  double ends = 0;   // the larger of the two ends of the span
  double bulge = 0;  // never below 0
};
ShapePull BoundPull(const CauseShape& shape, Span theta, const Eigen::VectorXd& v,
                    const Eigen::VectorXd& z);

// Bounds how far the pull -value(v, theta) . z exceeds linear interpolation while v moves from v0
// to v1 and z from z0 to z1, both with t from 0 to 1. For every theta of the span the excess is at
// most t (1 - t) / 2 times the returned value.
double BoundRise(const CauseShape& shape, Span theta, const Eigen::VectorXd& v0,
                 const Eigen::VectorXd& v1, const Eigen::VectorXd& z0, const Eigen::VectorXd& z1);

}  // namespace lyrefit
