#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/diagnose/describe.h"
#include "lyrefit/diagnose/effect_size.h"
#include "lyrefit/diagnose/known_effects.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/effects/fitted_effect.h"
#include "lyrefit/estimate/fit/statistics.h"

namespace lyrefit {
namespace {

// The largest change of the current by the effect.
std::vector<std::string> LargestChange(const WeightedData& weighted, const LawFit& fit, int index) {
  const Readings& readings = *weighted.readings;
  const LawFit rest = TakenOut(fit, index);
  const std::vector<Reading>& points = readings.points;
  std::vector<double> without(points.size());
  LawWorkspace workspace;
  if (!EvaluateLaw(rest.law, readings, rest.p.data(), &workspace, without.data(), nullptr)) {
    return {};
  }
  // Where the device delivers power, if any reading is there: beyond, currents grow without limit.
  const auto change = [&](std::size_t k) { return fit.current[k] - without[k]; };
  const auto delivers = [&](std::size_t k) {
    return points[k].current > 0 && points[k].voltage > 0;
  };
  std::size_t most = points.size();
  for (const bool anywhere : {false, true}) {
    if (most < points.size()) break;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (!anywhere && !delivers(k)) continue;
      if (most == points.size() || std::fabs(change(k)) > std::fabs(change(most))) most = k;
    }
  }
  if (most == points.size() || !(std::fabs(change(most)) > 0)) return {};
  const double percent = 100 * std::fabs(change(most));
  return {fmt::format("it {} up to {:.{}f} % of Isc, most at {:.4g} V",
                      change(most) < 0 ? "takes" : "adds", percent, percent < 10 ? 1 : 0,
                      points[most].voltage * readings.scale.cells)};
}

// What is said of a parameter out of range beside its sentence.
struct FindingWords {
  const char* finding;
  bool low;  // below its limit rather than above
  const char* id;
  const char* title;
  const char* about;
  const char* action;
  const char* separate_by;
};

constexpr FindingWords kFindingWords[] = {
    {"fill_factor", true, "fill_factor", "fill factor below that of healthy devices", "device",
     "measure before any work: a Suns-Voc trace or a dark curve tells which part of the device "
     "loses "
     "it",
     "a Suns-Voc trace or a dark curve"},
    {"leak", false, "leak", "leak above that of healthy devices", "device",
     "look for dark modules or cells in an electroluminescence image; test the insulation and the "
     "earthing, since potential-induced degradation can be reversed; exchange what is shunted",
     "an electroluminescence image, or a sweep at low light, where leaks take most of the voltage"},
    {"ideality", false, "ideality", "ideality above that of healthy devices", "device",
     "take the curve again with the temperature of the cells measured, and compare it with a sound "
     "module of the same type",
     "a second sweep at another light with the temperature of the cells measured"},
    {"ideality", true, "low_ideality", "ideality below that of any junction", "conditions",
     "check the stated number of cells and the sensor of the temperature; take the curve again",
     "the number of cells on the label, and a second thermometer"},
    {"series_resistance", false, "series_resistance",
     "series resistance above that of healthy devices", "device",
     "look for hot connectors, clamps and ribbons in a thermal picture under load; renew them",
     "a Suns-Voc trace, or the voltage drop along leads and connectors under load"},
};

}  // namespace

std::vector<std::string> InWords(const WeightedData& weighted, const LawFit& fit, int index,
                                 const std::vector<CauseParameter>& strength) {
  const Effect& effect = *fit.law.effects[index];
  if (effect.in_words == nullptr) return LargestChange(weighted, fit, index);
  return effect.in_words(
      {*weighted.readings, fit.law, fit.p, index, fit.p.data() + fit.law.Offset(index), strength});
}

Cause CauseOf(const DeviceFinding& finding) {
  Cause cause;
  const bool low = finding.value.value < finding.healthy_limit;
  for (const FindingWords& words : kFindingWords) {
    if (words.finding != finding.id || words.low != low) continue;
    cause.id = words.id;
    cause.title = words.title;
    cause.group = words.about;
    cause.action = words.action;
    cause.separate_by = {words.separate_by};
  }
  cause.sentence = "it " + finding.sentence;
  cause.power_effect.value = finding.power_loss;
  cause.recoverable_power_W = finding.recoverable_power_W;
  return cause;
}

Cause MainCause(const Diagnosis& diagnosis) {
  const auto about = [](const Cause& cause) {
    const Effect* const effect = FindEffect(cause.id);
    return effect == nullptr ? std::string() : std::string(ToText(effect->where));
  };
  const std::vector<Cause>& causes = diagnosis.verdict.causes;
  const auto of_device = std::find_if(causes.begin(), causes.end(), [&](const Cause& cause) {
    return about(cause) == ToText(Where::kDevice);
  });
  // What the instrument does to single readings leaves the parameters what they are.
  const bool undisturbed = std::all_of(causes.begin(), causes.end(), [&](const Cause& cause) {
    return about(cause) == ToText(Where::kInstrument);
  });
  if (of_device == causes.end() && undisturbed && !diagnosis.device_findings.empty()) {
    return CauseOf(diagnosis.device_findings.front());
  }
  if (causes.empty()) return Cause();
  Cause cause = of_device == causes.end() ? causes.front() : *of_device;
  cause.group = about(cause);
  return cause;
}

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
