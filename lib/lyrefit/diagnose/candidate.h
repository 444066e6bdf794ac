#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// One way an effect could show: the direction in which it would move the whitened currents, less
// what the present law absorbs.
struct Direction {
  int probe = 0;     // of the effect's probes
  double kept = 0;   // part of the signature's norm the law cannot absorb
  double norm = 0;   // of what is kept, at the probe's strength
  double score = 0;  // its length along the residual, signed: positive if the effect helps
};

// How an effect scores on the residuals of a law.
struct Score {
  const Effect* effect = nullptr;
  bool testable = false;
  std::string why_not;
  std::vector<Direction> directions;  // the best first
  double statistic = 0;               // F(1, dof - 1) of the best direction
  double p_value = 1;                 // all its directions counted, by simulated null_statistics
  double corrected_p = 1;             // the whole catalogue counted
  double charge = 0;                  // 2 ln of its effective number of directions
  double catalogue = 1;               // how many such effects the whole list is worth
  double kept = 0;                    // of its best kept direction
  int outlier = -1;                   // of what is found by single readings: the furthest off
};

// An effect on weighted data: its own part of a score, and how it would show in noise.
struct Candidate {
  Score score;
  bool two_sided = false;
  Eigen::MatrixXf directions;  // unit columns that no two are alike; none for single readings
};

// A law's candidates.
struct Prepared {
  Linearized linear;
  int degrees = 0;  // of the readings beyond the law's parameters
  std::vector<Candidate> candidates;
};

// What the probes of effects do to the currents of a fitted law, not whitened: a column a probe, 0
// where it cannot be had. Other fits of the same law that lie within the noise share it.
struct Signature {
  LawFit fit;
  std::map<const Effect*, Eigen::MatrixXd> moved;
};
using Signatures = std::vector<std::shared_ptr<const Signature>>;

// One of `known` that serves this fit and all of `effects`, else a new one, which is added.
std::shared_ptr<const Signature> FindSignature(const WeightedData& weighted, const LawFit& fit,
                                           const std::vector<const Effect*>& effects,
                                           Signatures* known);

// Every effect of `effects` beside the residuals of `fit`, not judged yet, each scored
// on what it is found by: its probes, smooth waves along each stretch, single readings.
Prepared PrepareAll(const WeightedData& weighted, const LawFit& fit,
                    const std::vector<const Effect*>& effects, Signatures* known);

// F(1, degrees - 1) of a score that takes its square off a sum of squares.
double Statistic(double score, double sum, int degrees, double least_variance);

}  // namespace lyrefit
