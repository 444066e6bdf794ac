#pragma once

#include <Eigen/Core>
#include <functional>

#include "lyrefit/base/numbers.h"

namespace lyrefit {

// A range of values.
struct Span {
  double lower = 0;
  double upper = 0;
};

// The current that a cause takes from the terminals, as it hangs on the junction voltage v of the
// whole device: strength x value(v, theta), theta one parameter of its own. It is 0 at 0 V, never
// falls with v, and is convex from 0 V on. What bounds it from piece to piece stands beside it:
// ranges over all v and theta of two spans, infinite where there is no bound.
struct CauseShape {
  Span theta;              // both ends the same: there is no such parameter
  double strongest_A = 0;  // largest strength
  std::function<double(double v, double theta)> value;
  std::function<double(double v, double theta)> slope;  // by v
  std::function<Span(Span v, Span theta)> slopes;       // range of the slope
  std::function<Span(Span v, Span theta)> bends;        // range of the second derivative by v
  // Range of the second derivative by theta at one v; may be empty without such a parameter.
  std::function<Span(double v, Span theta)> theta_bends;

  Eigen::VectorXd Values(const Eigen::VectorXd& v, double at) const {
    return v.unaryExpr([&](double x) { return value(x, at); });
  }
  Eigen::VectorXd Slopes(const Eigen::VectorXd& v, double at) const {
    return v.unaryExpr([&](double x) { return slope(x, at); });
  }
};

// Collection that falls with the voltage: 1 / (Vbi - v / cells) - 1 / Vbi, Vbi = 0.9 V, beyond
// 0.87 V of a cell its tangent. The constant part is one with the photocurrent. Strengths up to 0.3
// of `photocurrent_A`.
CauseShape CollectionShape(int cells, double photocurrent_A);

// A diode with this u = 1 / (n Ns Vt): its current at v over that at `pivot_V`, strengths up to
// `strongest_A`.
CauseShape DiodeShape(double u, double pivot_V, double strongest_A);

// sign(v) |v / reach_V|^theta, exponents of `theta`, which begins above 1.
CauseShape PowerShape(double reach_V, Span theta, double strongest_A);

// What a shape can gain along dual vectors: bounds of -value(v, theta) . z over all theta of a span.
// At one Rs. At the ends of the span the pull may be looked up; between them it rises above the
// larger by the bulge at most.
struct ShapePull {
  double ends = 0;   // the larger of the two ends of the span
  double bulge = 0;  // never below 0
};
ShapePull BoundPull(const CauseShape& shape, Span theta, const Eigen::VectorXd& v,
                    const Eigen::VectorXd& z);

// On the way from v0 and z0 to v1 and z1, t from 0 to 1 in all of them at once: whatever theta is of
// the span, the pull exceeds what is interpolated between its ends by t (1 - t) / 2 times this at
// most.
double BoundRise(const CauseShape& shape, Span theta, const Eigen::VectorXd& v0,
                 const Eigen::VectorXd& v1, const Eigen::VectorXd& z0, const Eigen::VectorXd& z1);

}  // namespace lyrefit
