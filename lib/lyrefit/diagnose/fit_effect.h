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

// Score of an effect on the residuals of a law: an estimate of what a fit would gain.
struct Score {
  const Effect* effect = nullptr;
  bool testable = false;
  std::string why_not;
  std::vector<Direction> directions;  // best first
  double statistic = 0;               // F(1, degrees - 1) of the best direction
  double kept = 0;                    // largest `kept` of its directions
  int outlier = -1;                   // if found by single readings: the one furthest off
};

// Changes of a fitted law's currents by the probes of effects, not whitened. Each matrix has one
// column per probe, 0 where the law cannot be evaluated. Fits of the same effects whose currents
// differ by less than the noise share them.
struct FitSignatures {
  LawFit fit;
  std::map<const Effect*, Eigen::MatrixXd> moved;
};
using Signatures = std::vector<std::shared_ptr<const FitSignatures>>;

// Returns those of `known` that apply to this fit and hold all of `effects`. If there are none,
// computes them and appends them to `known`.
std::shared_ptr<const FitSignatures> FindSignatures(const WeightedData& weighted, const LawFit& fit,
                                                    const std::vector<const Effect*>& effects,
                                                    Signatures* known);

// Scores every effect of `effects` on the residuals of `fit`, by its probes, by smooth waves along
// each monotone stretch, or by single readings.
std::vector<Score> ScoreEffects(const WeightedData& weighted, const LawFit& fit,
                                const std::vector<const Effect*>& effects, Signatures* known);

// The first score whose effect has this FoundBy value; at most one effect has a value other than a
// fit's. Null if there is none.
const Score* FindScore(const std::vector<Score>& scores, FoundBy found_by);

// Effort of a fit. kFull: several starts. kInPassing: the best probe only.
enum class Effort { kFull, kInPassing };

// Fits the law of `fit` with one more effect, all parameters free, from the best of the effect's
// probes. The sum of squares is never larger than that of `fit`, except for effects without a
// neutral value.
LawFit FitEffect(const WeightedData& weighted, const LawFit& fit, const Score& score,
                 Effort effort = Effort::kFull);

// Fits the law of `met` from its parameters. `met`: a fit with one more effect, to readings most of
// which are in these data too. Not usable if the effect ends at a bound that it must not reach.
LawFit FitOnwards(const WeightedData& weighted, const LawFit& met);

// Whether the misfit or the ideality of a fit is so large that scores and starts taken from it
// mislead.
bool LeadsAstray(const WeightedData& weighted, const LawFit& fit);

// Penalty for the parameters that a law frees beyond the default, in units of the noise variance:
// ln(readings) each (BIC).
double FreedomOf(const WeightedData& weighted, const Law& law);

// Fits the law of `fit` without effect number `index`, from the present parameters.
LawFit FitWithout(const WeightedData& weighted, const LawFit& fit, int index);

// Whether the last effect of a fit draws what it stands for, and not what another cause draws: it
// stays off the bounds that its parameters name and off what `Effect::imitates` rejects, and the cells
// without it give no more voltage than their technology can (DataTraits::most_open_circuit). Of an effect
// of the sweep or of the instrument also these: what changes from one reading to the next jumps
// there in the readings, no moment of light lies where a sweep from deep reverse passes 0 V, and none
// after which the light stays at another level lies in the knee or at a step of bypass diodes.
bool IsItself(const WeightedData& weighted, const LawFit& fit);

}  // namespace lyrefit
