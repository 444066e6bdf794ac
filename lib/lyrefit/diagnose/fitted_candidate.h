#pragma once

#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/diagnose/fit_effect.h"
#include "lyrefit/diagnose/priors.h"
#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// Prior of the departure of a device from a law that has the right causes: ln of the size of the
// rough path (estimate/refine/error_model.h) is normal.
struct DeparturePrior {
  double center = 0;  // in current scales; 0: none, the law is exact
  double width = 0;   // standard deviation of the logarithm; 0: the size is stated
};

// ln of the marginal likelihood of the readings under a law: the likelihood times the priors of the
// parameters, integrated over them by Laplace's approximation at the fit and over the size of the
// path on a grid. Differences are comparable between laws on the same readings and sigma.
struct LogEvidence {
  double complete = -HUGE_VAL;  // the departure has its prior
  // Something else bends the curve as well: the departure is larger, by an unknown factor.
  double incomplete = -HUGE_VAL;
  double path = 0;  // most probable size of the path in the complete case, in scales
};

// `fit`: an optimum of its law. Parameters at bounds count with the part of their likelihood that
// lies inside. Kass and Raftery 1995, doi:10.1080/01621459.1995.10476572; the integral over the
// parameters is that of the restricted likelihood (doi:10.1093/biomet/58.3.545).
LogEvidence FindLogEvidence(const WeightedData& weighted, const LawFit& fit,
                            const DeparturePrior& departure);

// ln(exp a + exp b).
double LogSum(double a, double b);

// A hypothesis: a law with one effect more than another law, fitted, or that law itself.
struct FittedCandidate {
  Score score;
  LawFit fit;
  double statistic = 0;  // reduction of the sum of squares, in units of the noise variance
  LogEvidence evidence = {};
  double log_prior = 0;              // ln of the prior odds of its effect
  double log_posterior = -HUGE_VAL;  // ln of prior times marginal likelihood, up to a constant
  double probability = 0;            // among the hypotheses compared
  double as_slight = 0;              // probability that its curve is one of Effect::slight_is
  double material = 1;               // probability that its effect, if there, exceeds a floor

  // As log_posterior, if nothing unknown acts as well. An unknown departure bends to everything,
  // so that causes are looked for as if there were none.
  double LogComplete() const { return evidence.complete + log_prior; }
};

// Hypotheses on one place of a law: that nothing belongs there, or one of the candidates.
struct Hypotheses {
  FittedCandidate none;                     // `score` is empty
  std::vector<FittedCandidate> candidates;  // most probable first
};

// The candidate with the largest LogComplete.
std::vector<FittedCandidate>::const_iterator MostProbable(
    const std::vector<FittedCandidate>& candidates);

// What the probabilities depend on beside the readings.
struct JudgeOptions {
  double departure = 0;        // usual departure of devices from a right law, in scales; 0: none
  double departure_width = 0;  // see DeparturePrior
  CausePriors priors;
  bool module = false;
  std::vector<const Effect*> candidates = {};  // that may be named; empty: all
};

// Sets evidence and probability of every hypothesis and sorts the candidates. `base`: the fit
// without any cause.
void Judge(const WeightedData& weighted, const LawFit& base, const JudgeOptions& options,
           Hypotheses* hypotheses);

// Evidence of a law. Its causes are described to a fraction of their size only, so that large ones
// leave a larger departure.
LogEvidence EvidenceOf(const WeightedData& weighted, const LawFit& base,
                       const JudgeOptions& options, const LawFit& fit);

// ln of the prior odds of a cause.
double LogPriorOdds(const Effect& effect, const JudgeOptions& options);

// ln of the evidence whether or not something unknown acts as well.
double LogTotal(const LogEvidence& evidence);
// Probability that something unknown acts beside the causes of a law.
double IncompleteProbability(const LogEvidence& evidence);

// The effects of `effects` that can be added to a law.
std::vector<const Effect*> RoomFor(const Law& law, const std::vector<const Effect*>& effects);

}  // namespace lyrefit
