#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// One possible signature of an effect: the direction in which it changes the whitened currents,
// after projection off the parameters of the present law.
struct Direction {
  int probe = 0;     // position among the effect's probes; -1: a wave or a single reading
  double kept = 0;   // fraction of the signature's norm that the law cannot absorb
  double norm = 0;   // norm of that remainder, at the probe's strength
  double score = 0;  // minus its dot product with the residual; positive: helps
};

// Score of an effect on the residuals of a law.
struct Score {
  const Effect* effect = nullptr;
  bool testable = false;
  std::string why_not;
  std::vector<Direction> directions;  // best first
  double statistic = 0;               // F(1, dof - 1) of the best direction
  double p_value = 1;                 // corrected for all its directions (null statistics)
  double corrected_p = 1;             // corrected for the whole catalogue
  double charge = 0;                  // penalty: 2 ln of its effective number of directions
  double catalogue = 1;               // effective number of independent effects in the list
  double kept = 0;                    // largest `kept` of its directions
  int outlier = -1;                   // if found by single readings: the one furthest off
};

// An effect on weighted data: its score before calibration, and its directions for null statistics.
struct CandidateEffect {
  Score score;
  bool two_sided = false;
  Eigen::MatrixXf directions;  // unit columns, nearly equal ones merged; empty for single readings
};

// All candidates of a law.
struct Prepared {
  Linearized linear;
  int degrees = 0;  // degrees of freedom: readings minus parameters of the law
  std::vector<CandidateEffect> candidates;
};

// Changes of a fitted law's currents by the probes of effects, not whitened. Each matrix has one
// column per probe, 0 where the law cannot be evaluated. Fits of the same effects whose currents
// differ by less than the noise share a signature.
struct Signature {
  LawFit fit;
  std::map<const Effect*, Eigen::MatrixXd> moved;
};
using Signatures = std::vector<std::shared_ptr<const Signature>>;

// Returns a signature of `known` that applies to this fit and holds all of `effects`. If there is
// none, computes one and appends it to `known`.
std::shared_ptr<const Signature> FindSignature(const WeightedData& weighted, const LawFit& fit,
                                               const std::vector<const Effect*>& effects,
                                               Signatures* known);

// Scores every effect of `effects` on the residuals of `fit`, without p-values. Depending on the
// effect, the score uses its probes, smooth waves along each monotone stretch, or single readings.
Prepared PrepareAll(const WeightedData& weighted, const LawFit& fit,
                    const std::vector<const Effect*>& effects, Signatures* known);

// F(1, degrees - 1) statistic of a score, whose square is the reduction of the sum of squares
// `sum`. `least_variance`: lower limit of the noise variance.
double Statistic(double score, double sum, int degrees, double least_variance);

}  // namespace lyrefit
