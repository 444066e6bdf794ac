#pragma once

#include <vector>

#include "lyrefit/certify/part_bound.h"
#include "lyrefit/certify/relaxation.h"
#include "lyrefit/certify/slope_bounds.h"

namespace lyrefit {

// One part of the region of solved_relaxation.h on the way to its bound: the linear problem around its
// references, and what is known of the mixtures that compete there, whose half sum of squares is at
// most `known`.
struct SolvedPart {
  const MixtureData& data;
  const BranchPart& region;
  std::vector<Window> windows = {};
  double known = 0;     // the best half sum of squares
  double steepest = 0;  // largest u
  double middle = 0;    // Rs of the references
  MixtureData linear = {};
  Eigen::VectorXd reference_A = {}, slope_S = {};  // J', s'
  Eigen::ArrayXd residual = {};                    // measured - J', weighted
  Mixture left = {}, right = {};
  PartBound bound = {};
  Eigen::ArrayXd deviation_A = {};      // |J - J'| is at most this
  Eigen::ArrayXd highest_slope_S = {};  // near the point, for every Rs of the part
  Eigen::ArrayXd error = {};            // |e| is at most this
  double loss = kInfinity;
};

// The residual that a competing mixture may have at one point, in ampere.
double Allowed(const SolvedPart& part, Eigen::Index k);

// No competing mixture has a larger sum of leak and diode currents at this voltage.
DualGain CompetitorDualGain(const SolvedPart& part);

// True if no mixture with an Rs of this or more competes: of two points the one of larger junction
// voltage would have the larger current.
bool NoneCompetes(const MixtureData& data, double rs_lower, double known);

// The sum of the light terms of a competing mixture at most.
double LargestLight(const SolvedPart& part, const DualGain& dual_gain);

// Upper bounds of the slopes of competing mixtures from the largest light alone. They hold for every
// junction voltage between V + J' Rs and V + J Rs of the point, at one Rs of the part after the other
// (`one_rs`) or for all of them at once.
Eigen::ArrayXd RoughSlopes(const SolvedPart& part, double light_A, bool one_rs);

// The values at the junction voltages V + J' Rs for the middle Rs that all competing mixtures share:
// from their deviations alone, or from the dual vectors, which they miss by `radius` at most.
KnownValues ValuesFromDeviations(const SolvedPart& part);
KnownValues ValuesFromDuals(const SolvedPart& part, const std::vector<SlopeRange>& slopes,
                            double radius);

// Takes over what is known of the slopes between V + J' Rs and V + J Rs.
void SetErrors(const std::vector<SlopeRange>& slopes, SolvedPart* part);

// |r' - y| at most, weighted, for any Rs of the part.
Eigen::ArrayXd Departure(const SolvedPart& part);

// What of the linear problem's bound does not hold for the true residuals.
double Loss(const SolvedPart& part);

// Half the sum of squares of the linear problem that a competing mixture has at most, and |p - y|.
double LinearKnown(const SolvedPart& part);
double Radius(const SolvedPart& part, double linear_known);

}  // namespace lyrefit
