#include "lyrefit/certify/solved_part.h"

#include <algorithm>
#include <cmath>

namespace lyrefit {
namespace {

// Replaces infinite and undefined uncertainties by 1e100, which linear algebra can process.
double Finite(double uncertainty) { return uncertainty < 1e100 ? uncertainty : 1e100; }

}  // namespace

double Allowed(const SolvedPart& part, Eigen::Index k) {
  return std::sqrt(2 * part.known) / part.data.weight[k];
}

// The currents at the points of the largest and the smallest junction voltage are known to within
// the allowed residuals. The sum of leak and diode currents is convex in the voltage, and zero at
// 0 V.
DarkCurrentBound CompetitorDarkCurrent(const SolvedPart& part) {
  const Eigen::Index points = part.data.target_A.size();
  Eigen::Index high = 0, low = 0;
  double v_high = -kInfinity, v_low = kInfinity;
  for (Eigen::Index k = 0; k < points; ++k) {
    const double least = part.data.target_A[k] - Allowed(part, k);
    const double most = part.data.target_A[k] + Allowed(part, k);
    const double v = part.data.voltage_V[k];
    const double from = v + std::min(part.region.rs0 * least, part.region.rs1 * least);
    const double to = v + std::max(part.region.rs0 * most, part.region.rs1 * most);
    if (from > v_high) high = k, v_high = from;
    if (to < v_low) low = k, v_low = to;
  }
  v_low = std::max(v_low, 0.0);
  if (!(v_low < v_high)) return {kInfinity, std::max(v_high, 1e-300)};
  const double difference =
      part.data.target_A[low] + Allowed(part, low) - part.data.target_A[high] + Allowed(part, high);
  return {std::max(difference, 0.0) / (1 - v_low / v_high), v_high};
}

bool NoneCompetes(const MixtureData& data, double rs_lower, double known) {
  const Eigen::Index points = data.target_A.size();
  const Eigen::ArrayXd square = data.weight.array().square().inverse();
  for (Eigen::Index m = 0; m < points; ++m) {
    for (Eigen::Index k = 0; k < points; ++k) {
      const double rise =
          data.target_A[m] - data.target_A[k] - std::sqrt(2 * known * (square[m] + square[k]));
      if (rise > 0 && data.voltage_V[m] - data.voltage_V[k] + rs_lower * rise >= 0) return true;
    }
  }
  return false;
}

double LargestLight(const SolvedPart& part, const DarkCurrentBound& dark_bound) {
  double largest = 0, v_low = kInfinity;
  for (Eigen::Index k = 0; k < part.data.target_A.size(); ++k) {
    const double most = part.data.target_A[k] + Allowed(part, k);
    largest = std::max(largest, most);
    v_low = std::min(
        v_low, part.data.voltage_V[k] + std::max(part.region.rs0 * most, part.region.rs1 * most));
  }
  return largest +
         dark_bound.current_A * std::min(std::max(v_low / dark_bound.voltage_V, 0.0), 1.0);
}

Eigen::ArrayXd RoughSlopes(const SolvedPart& part, double light_A, bool one_rs) {
  const Eigen::Index points = part.data.target_A.size();
  const double u = part.steepest;
  const double rs0 = part.region.rs0, rs1 = part.region.rs1;
  Eigen::ArrayXd slopes(points), least(points), most(points);
  for (Eigen::Index k = 0; k < points; ++k) {
    least[k] = part.data.target_A[k] - Allowed(part, k);
    most[k] = std::max(part.data.target_A[k] + Allowed(part, k), part.reference_A[k]);
    const double spread =
        rs1 * part.deviation_A[k] + (one_rs ? 0 : (rs1 - rs0) * std::fabs(part.reference_A[k]));
    const double voltage = part.data.voltage_V[k] + std::min(rs0 * least[k], rs1 * least[k]);
    slopes[k] = voltage > 0 ? std::max(light_A - least[k], 0.0) * u / -std::expm1(-u * voltage) *
                                  std::exp(std::min(u * spread, 500.0))
                            : kInfinity;
  }
  // The slope rises with the junction voltage. It is at most that of a point at a larger voltage,
  // and at most that of the chord to it.
  const Eigen::ArrayXd own = slopes;
  const auto distance = [&](Eigen::Index m, Eigen::Index k) {
    const auto at = [&](double rs_m, double rs_k) {
      return part.data.voltage_V[m] + rs_m * least[m] - part.data.voltage_V[k] - rs_k * most[k];
    };
    const double same = std::min(at(rs0, rs0), at(rs1, rs1));
    return one_rs ? same : std::min({same, at(rs0, rs1), at(rs1, rs0)});
  };
  for (Eigen::Index k = 0; k < points; ++k) {
    const double highest = part.data.target_A[k] + Allowed(part, k);
    for (Eigen::Index m = 0; m < points; ++m) {
      const double apart = distance(m, k);
      if (!(apart >= 0)) continue;
      slopes[k] = std::min(slopes[k], own[m]);
      if (apart > 0) slopes[k] = std::min(slopes[k], std::max(highest - least[m], 0.0) / apart);
    }
  }
  return slopes;
}

KnownValues ValuesFromDeviations(const SolvedPart& part) {
  KnownValues known;
  const double half = 0.5 * (part.region.rs1 - part.region.rs0);
  known.voltage_V = part.data.voltage_V + part.middle * part.reference_A;
  known.value_A = part.reference_A;
  known.each_A.resize(known.value_A.size());
  for (Eigen::Index k = 0; k < known.each_A.size(); ++k) {
    const double slope = part.highest_slope_S[k];
    known.each_A[k] = Finite(part.deviation_A[k] * (1 + part.region.rs1 * slope) +
                             half * slope * std::fabs(part.reference_A[k]));
  }
  known.shared = known.common_A = Eigen::VectorXd::Zero(known.voltage_V.size());
  return known;
}

Eigen::ArrayXd Departure(const SolvedPart& part) {
  return (part.residual - part.left.y.array())
      .abs()
      .max((part.residual - part.right.y.array()).abs());
}

KnownValues ValuesFromDuals(const SolvedPart& part, const std::vector<SlopeRange>& slopes,
                            double radius) {
  KnownValues known = ValuesFromDeviations(part);
  const double half = 0.5 * (part.region.rs1 - part.region.rs0);
  const Eigen::ArrayXd departure = Departure(part);
  for (Eigen::Index k = 0; k < known.each_A.size(); ++k) {
    const double slope_error =
        std::max(slopes[k].upper - part.slope_S[k], part.slope_S[k] - slopes[k].lower);
    const double reference = std::fabs(part.reference_A[k]);
    known.each_A[k] = Finite(departure[k] / part.linear.weight[k] + half * slope_error * reference);
    known.shared[k] = 1 / part.linear.weight[k];
    known.common_A[k] = half * part.slope_S[k] * part.reference_A[k];
  }
  known.radius_A = radius;
  return known;
}

void SetErrors(const std::vector<SlopeRange>& slopes, SolvedPart* part) {
  for (Eigen::Index k = 0; k < part->error.size(); ++k) {
    const double whole = 1 + part->middle * part->slope_S[k];
    const double high = whole / (1 + part->region.rs0 * slopes[k].lower);
    const double low = whole / (1 + part->region.rs1 * slopes[k].upper);
    part->error[k] = std::max(high - 1, 1 - low);
    part->highest_slope_S[k] = std::min(part->highest_slope_S[k], slopes[k].upper);
  }
}

double Loss(const SolvedPart& part) {
  const Eigen::ArrayXd y = part.left.y.array().abs().max(part.right.y.array().abs());
  const Eigen::ArrayXd departure = Departure(part);
  double loss = 0;
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    if (part.error[k] >= 1) return kInfinity;
    const double h = part.error[k] / (1 - part.error[k]);
    loss += h * departure[k] * y[k] + 0.5 * h * h * y[k] * y[k];
  }
  return loss;
}

// Uses that r = (1 - e) p + e r' is no longer than the residuals of the best mixture known.
double Radius(const SolvedPart& part, double linear_known) {
  const double from_linear = std::sqrt(std::max(2 * (linear_known - part.bound.lower), 0.0));
  const double largest = part.error.maxCoeff();
  if (largest >= 1) return from_linear;
  const Eigen::ArrayXd y = part.left.y.array().abs().max(part.right.y.array().abs());
  const Eigen::ArrayXd departure = Departure(part);
  const double square = (1 - largest) * (1 - largest);
  const double linear = (part.error * ((1 + part.error) * departure + y)).matrix().norm();
  const double constant = part.known - part.bound.lower + (part.error * departure * y).sum();
  const double root = std::sqrt(std::max(linear * linear + 2 * square * constant, 0.0));
  return std::min(from_linear, (linear + root) / square);
}

double LinearKnown(const SolvedPart& part) {
  const Eigen::ArrayXd weight = part.data.weight.array();
  const Eigen::ArrayXd factor =
      (1 + part.region.rs1 * part.highest_slope_S) / (1 + part.middle * part.slope_S.array());
  const double around =
      part.residual.matrix().norm() + (weight * part.deviation_A * factor).matrix().norm();
  double more = 0;
  for (Eigen::Index k = 0; k < part.error.size(); ++k) {
    if (part.error[k] >= 1) return 0.5 * around * around;
    const double share = part.error[k] / (1 - part.error[k]) * weight[k] * part.deviation_A[k];
    more += share * share;
  }
  const double near = std::sqrt(2 * part.known) + std::sqrt(more);
  return 0.5 * std::min(around, near) * std::min(around, near);
}

}  // namespace lyrefit
