#pragma once

#include <vector>

#include "lyrefit/certify/mixture.h"
#include "lyrefit/certify/part_bound.h"
#include "lyrefit/certify/relaxation.h"

namespace lyrefit {

// Enclosure of the current of all competing mixtures of a part at given junction voltages. (A
// mixture competes if it is as good as the best one known.) A combination of the values with the
// coefficients c is known to within
//
//   each . |c| + radius |shared o c| + |common . c|
//
// where o is the product by element. Vectors have one element per voltage.
struct KnownValues {
  Eigen::VectorXd voltage_V;
  Eigen::VectorXd value_A;
  Eigen::VectorXd each_A;
  Eigen::VectorXd shared;
  double radius_A = 0;
  Eigen::VectorXd common_A;
  double largest_light_A = 0;  // upper bound of the sum of the light terms
  DarkCurrentBound dark_bound;
};

// Bounds of the slope -dI/dVd, in S: `lower` at one junction voltage, `upper` at another.
struct SlopeRange {
  double lower = 0;
  double upper = kInfinity;
};

// Bounds the slopes of every competing mixture over the windows: from below at below_V[k] and from
// above at above_V[k]. A law is a constant less a line and exponentials, so differences of third
// order bound its slope from one side. These differences are replaced by combinations of the known
// values. The remainder is bounded over all exponentials of the windows. Remainders below
// `precision_S` are not bounded more closely.
std::vector<SlopeRange> BoundSlopes(const KnownValues& known, const std::vector<Window>& windows,
                                    const std::vector<double>& below_V,
                                    const std::vector<double>& above_V, double precision_S);

// Working data of one part of the region of solved_relaxation.h, which defines J, J', s', r', p, y
// and e. It has the problem linearised around the references J' and s', and bounds on the competing
// mixtures. A mixture competes if its half sum of squares is at most `known`.
struct SolvedPart {
  const MixtureData& data;
  const BranchPart& region;
  std::vector<Window> windows = {};
  double known = 0;     // half sum of squares of the best mixture known
  double steepest = 0;  // largest u of the windows
  double middle = 0;    // Rs of the references
  MixtureData linear = {};
  Eigen::VectorXd reference_A = {}, slope_S = {};  // J', s'
  Eigen::ArrayXd residual = {};                    // I - J' = -r', weighted
  Mixture left = {}, right = {};
  PartBound bound = {};
  Eigen::ArrayXd deviation_A = {};      // upper bound of |J - J'|
  Eigen::ArrayXd highest_slope_S = {};  // slope bound near the point for every Rs of the part
  Eigen::ArrayXd error = {};            // upper bound of |e|
  double loss = kInfinity;
};

// The largest residual of a competing mixture at point k, in ampere.
double Allowed(const SolvedPart& part, Eigen::Index k);

// Upper bound of the sum of leak and diode currents of every competing mixture at one voltage.
DarkCurrentBound CompetitorDarkCurrent(const SolvedPart& part);

// True if no mixture with an Rs of `rs_lower` (ohm) or more competes. The proof is a pair of points
// of which the one of larger junction voltage would have the larger current.
bool NoneCompetes(const MixtureData& data, double rs_lower, double known);

// Upper bound of the sum of the light terms of a competing mixture, in ampere.
double LargestLight(const SolvedPart& part, const DarkCurrentBound& dark_bound);

// Upper bounds of the slopes of competing mixtures at each point (S), from the largest light alone.
// They hold at every junction voltage between V + J' Rs and V + J Rs. With `one_rs` they hold at
// each Rs of the part separately, otherwise for all Rs of the part together.
Eigen::ArrayXd RoughSlopes(const SolvedPart& part, double light_A, bool one_rs);

// The values at the junction voltages V + J' Rs, with the middle Rs, that all competing mixtures
// share. ValuesFromDeviations() uses deviation_A alone. ValuesFromDuals() uses the dual vectors,
// from which competing mixtures differ by at most `radius`.
KnownValues ValuesFromDeviations(const SolvedPart& part);
KnownValues ValuesFromDuals(const SolvedPart& part, const std::vector<SlopeRange>& slopes,
                            double radius);

// Sets `error` and `highest_slope_S` from bounds of the slopes between V + J' Rs and V + J Rs.
void SetErrors(const std::vector<SlopeRange>& slopes, SolvedPart* part);

// Upper bound of |r' - y| at each point, weighted, for any Rs of the part.
Eigen::ArrayXd Departure(const SolvedPart& part);

// Upper bound of the loss when the linear problem's bound is transferred to the true residuals.
double Loss(const SolvedPart& part);

// LinearKnown() bounds half the sum of squares of the linear problem for a competing mixture.
// Radius() bounds |p - y|.
double LinearKnown(const SolvedPart& part);
double Radius(const SolvedPart& part, double linear_known);

}  // namespace lyrefit
