#include <algorithm>
#include <cmath>

#include "lyrefit/diagnose/describe.h"
#include "lyrefit/diagnose/known_effects.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/fit/statistics.h"

namespace lyrefit {
namespace {

// Adds the probability that a candidate shares with cells that differ one by one to their trial.
void AddSlight(const FittedCandidate& fitted, std::vector<Trial>* trials) {
  for (Trial& trial : *trials) {
    if (trial.effect != fitted.score.effect->slight_is) continue;
    const double before = std::isfinite(trial.probability) ? trial.probability : 0;
    if (before == 0) trial.probability_material = fitted.material;
    trial.probability = before + fitted.as_slight;
  }
}

}  // namespace

std::vector<Trial> DescribeTrials(const Readings& readings, const Selection& selection,
                                  const std::vector<const Effect*>& known,
                                  const std::vector<const Effect*>& candidates,
                                  const HeldOutErrors& held_out, const DiagnoseOptions& options) {
  const WeightedData& weighted = selection.base_weighted;
  const int points = weighted.count();
  const double base_aicc =
      FindInformation(selection.base.sum / points, points, FreeCount(weighted, selection.base.law))
          .aicc;
  std::vector<Trial> trials;
  for (const Effect* effect : known) {
    Trial trial;
    trial.effect = effect->id;
    trial.title = effect->title;
    const bool allowed =
        std::find(candidates.begin(), candidates.end(), effect) != candidates.end();
    const auto reason = effect->WhyNot(readings.traits);
    if (!IsWanted(*effect, options)) {
      trial.why_not = "excluded: not among the effects asked for";
    } else if (reason) {
      trial.why_not = *reason;
    } else if (const char* const excluded = WhyExcluded(*effect, options)) {
      trial.why_not = excluded;
    } else if (effect->found_by == FoundBy::kRequest && !allowed) {
      trial.why_not = "only tried where it is asked for";
    } else if (effect->probes == nullptr && !allowed) {
      trial.why_not = "looked for in the values and the base model's parameters, not fitted";
    } else if (!allowed) {
      trial.why_not = "part of the base model";
    }
    const auto error = held_out.effects_A.find(trial.effect);
    if (error != held_out.effects_A.end()) trial.held_out_rmse_A = error->second;
    for (const FittedCandidate& fitted : selection.trials.candidates) {
      if (fitted.score.effect != effect) continue;
      trial.kept = fitted.score.kept;
      if (!fitted.score.testable) {
        trial.why_not = fitted.score.why_not;
        continue;
      }
      trial.tried = true;
      if (fitted.fit.usable) {
        trial.log_evidence = LogTotal(fitted.evidence) - LogTotal(selection.trials.none.evidence);
        trial.probability = fitted.probability;
        trial.probability_material = fitted.material;
      }
      trial.misfit = std::sqrt(std::max(fitted.statistic, fitted.score.statistic));
      if (!fitted.fit.usable) continue;
      trial.rmse_A = RmseOf(weighted, fitted.fit.current);
      trial.delta_aicc =
          FindInformation(fitted.fit.sum / points, points, FreeCount(weighted, fitted.fit.law))
              .aicc -
          base_aicc;
      trial.parameters =
          DescribeParameters(weighted, fitted.fit, fitted.fit.law.effects.size() - 1);
    }
    trials.push_back(trial);
  }
  for (const FittedCandidate& fitted : selection.trials.candidates) {
    if (fitted.as_slight > 0) AddSlight(fitted, &trials);
  }
  return trials;
}

}  // namespace lyrefit
