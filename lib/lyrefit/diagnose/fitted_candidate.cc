#include "lyrefit/diagnose/fitted_candidate.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "lyrefit/diagnose/decision_constants.h"
#include "lyrefit/effects/catalogue.h"

namespace lyrefit {

std::vector<FittedCandidate>::const_iterator MostProbable(
    const std::vector<FittedCandidate>& candidates) {
  return std::max_element(candidates.begin(), candidates.end(),
                          [](const FittedCandidate& a, const FittedCandidate& b) {
                            return a.LogComplete() < b.LogComplete();
                          });
}

LogEvidence EvidenceOf(const WeightedData& weighted, const LawFit& base,
                       const JudgeOptions& options, const LawFit& fit) {
  DeparturePrior departure{options.departure, options.departure_width};
  const bool stated = options.departure > 0 && options.departure_width == 0;
  if (!fit.law.effects.empty() && !stated) {
    const double size = LackOfFit(weighted, base, fit.current);
    departure.center = std::hypot(options.departure, kDepartureOfCauses * size);
    departure.width = kDepartureOfCausesWidth;
    if (weighted.readings->traits.single) {
      WeightedData rough = weighted;
      for (double& sigma : rough.sigma) sigma = std::hypot(sigma, kRoughPartOfCauses * size);
      return FindLogEvidence(rough, fit, departure);
    }
  }
  return FindLogEvidence(weighted, fit, departure);
}

double LogPriorOdds(const Effect& effect, const JudgeOptions& options) {
  const double prior = options.priors.Of(effect, options.module);
  return std::log(prior / (1 - prior));
}

double LogTotal(const LogEvidence& evidence) {
  return LogSum(evidence.complete + std::log1p(-kUnknownPrior),
                evidence.incomplete + std::log(kUnknownPrior));
}

double IncompleteProbability(const LogEvidence& evidence) {
  return std::exp(evidence.incomplete + std::log(kUnknownPrior) - LogTotal(evidence));
}

namespace {

// How much of the differences in evidence between causes counts.
struct Tempering {
  double part = 1;        // at most
  double least_part = 1;  // of what the plain misfit does not show
};

// Tempers the differences in evidence between causes; the sum of their probabilities stays. A law
// that is wrong in its details misses smoothly, by a few independent pieces of a sweep, however many
// readings it has and however often it is swept: a part of a difference counts as far as these
// pieces show it, and a smaller one beyond. Both causes must explain most of what there is: one that
// is hardly better than none misses alike only where the misfits show nothing.
void Temper(const WeightedData& weighted, const Tempering& by, double none,
            std::vector<FittedCandidate>* candidates) {
  constexpr double kMost = 0.5;  // of what the best gains against none
  const FittedCandidate* top = nullptr;
  double sum = -HUGE_VAL, tempered = -HUGE_VAL;
  const auto evidence_of = [](const FittedCandidate& candidate) {
    return candidate.log_posterior - candidate.log_prior;
  };
  for (const FittedCandidate& candidate : *candidates) {
    sum = LogSum(sum, candidate.log_posterior);
    if (top == nullptr || evidence_of(candidate) > evidence_of(*top)) top = &candidate;
  }
  if (top == nullptr || !std::isfinite(evidence_of(*top))) return;
  const double best = evidence_of(*top);
  const auto misfit_of = [&](const FittedCandidate& candidate) {
    return std::log(std::max(MissedBy(weighted, candidate.fit), 1e-300));
  };
  const bool pieces = by.least_part < by.part;
  const double least = pieces ? misfit_of(*top) : 0;
  for (FittedCandidate& candidate : *candidates) {
    const double below = evidence_of(candidate) - best;
    double counted = by.part * below;
    if (pieces && evidence_of(candidate) - none > kMost * (best - none)) {
      const double shown = kPiecesOfSweep * std::max(misfit_of(candidate) - least, 0.0);
      counted = std::max(counted, by.least_part * below - shown);
    }
    candidate.log_posterior = candidate.log_prior + counted;
    tempered = LogSum(tempered, candidate.log_posterior);
  }
  for (FittedCandidate& candidate : *candidates) candidate.log_posterior += sum - tempered;
}

// Part of a candidate's probability that belongs to the effect whose cells differ one by one. The
// light that groups of cells miss is even between 0 and 1 by itself; that of cells which differ has
// a half of Student's t with three degrees of freedom.
double PartOfSlight(const FittedCandidate& candidate, const DataTraits& traits,
                    const JudgeOptions& options) {
  const LawFit& fit = candidate.fit;
  const Effect& effect = *candidate.score.effect;
  if (effect.light_missing == nullptr) return 0;
  const auto& open = options.candidates;
  if (!open.empty() && std::none_of(open.begin(), open.end(), [&](const Effect* other) {
        return std::string_view(effect.slight_is) == other->id;
      })) {
    return 0;
  }
  const Effect* const slight = FindEffect(effect.slight_is);
  if (slight == nullptr) return 0;
  const auto odds_of = [&](const Effect& one) {
    const double prior = options.priors.Of(one, options.module);
    return prior / (1 - prior);
  };
  const double missing = effect.light_missing(fit.p.data() + ParametersAt(fit.law, effect), traits);
  if (!std::isfinite(missing)) return 0;
  const double z = missing / kUsualDimmest;
  const double density = 12 * std::sqrt(3.0) / M_PI / kUsualDimmest / std::pow(3 + z * z, 2);
  const double odds = odds_of(*slight) / odds_of(effect) * density;
  return odds / (1 + odds);
}

}  // namespace

void Judge(const WeightedData& weighted, const LawFit& base, const JudgeOptions& options,
           Hypotheses* hypotheses) {
  FittedCandidate& none = hypotheses->none;
  std::vector<FittedCandidate>& candidates = hypotheses->candidates;
  const double variance = NoiseVariance(weighted, none.fit);
  none.evidence = EvidenceOf(weighted, base, options, none.fit);
  none.log_posterior = LogTotal(none.evidence);
  for (FittedCandidate& candidate : candidates) {
    candidate.log_prior = LogPriorOdds(*candidate.score.effect, options);
    candidate.evidence = EvidenceOf(weighted, base, options, candidate.fit);
    candidate.log_posterior = LogTotal(candidate.evidence) + candidate.log_prior;
    candidate.statistic = (none.fit.sum - candidate.fit.sum) /
                          std::min(variance, NoiseVariance(weighted, candidate.fit));
  }
  const Tempering tempering = options.departure > 0
                                  ? Tempering{kEvidencePartOfDevices, kEvidencePartOfDetails}
                                  : Tempering{kEvidencePartOfLaws, kEvidencePartOfLaws};
  Temper(weighted, tempering, none.log_posterior, &candidates);
  double total = none.log_posterior;
  for (const FittedCandidate& candidate : candidates) {
    total = LogSum(total, candidate.log_posterior);
  }
  none.probability = std::exp(none.log_posterior - total);
  for (FittedCandidate& candidate : candidates) {
    candidate.probability = std::exp(candidate.log_posterior - total);
    candidate.as_slight =
        candidate.probability * PartOfSlight(candidate, weighted.readings->traits, options);
    candidate.probability -= candidate.as_slight;
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const FittedCandidate& a, const FittedCandidate& b) {
                     return a.log_posterior > b.log_posterior;
                   });
}

std::vector<const Effect*> RoomFor(const Law& law, const std::vector<const Effect*>& effects) {
  std::vector<const Effect*> open;
  for (const Effect* effect : effects) {
    if (CanAdd(law, *effect)) open.push_back(effect);
  }
  return open;
}

}  // namespace lyrefit
