#include "lyrefit/diagnose/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/diagnose/decision_constants.h"
#include "lyrefit/diagnose/effect_size.h"
#include "lyrefit/diagnose/known_effects.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/fit/statistics.h"

namespace lyrefit {
namespace {

// Readings at which a cause changes the current by more than half of its largest change.
std::vector<int> WhereItActs(const WeightedData& weighted, const LawFit& with, int index) {
  const LawFit rest = TakenOut(with, index);
  std::vector<double> current(with.current.size());
  LawWorkspace workspace;
  if (!EvaluateLaw(rest.law, *weighted.readings, rest.p.data(), &workspace, current.data(),
                   nullptr)) {
    return {};
  }
  std::vector<double> moves;
  double largest = 0;
  for (std::size_t k = 0; k < current.size(); ++k) {
    moves.push_back(std::fabs(with.current[k] - current[k]));
    largest = std::max(largest, moves.back());
  }
  std::vector<int> points;
  for (std::size_t k = 0; k < moves.size(); ++k) {
    if (largest > 0 && moves[k] > 0.5 * largest) points.push_back(static_cast<int>(k));
  }
  return points;
}

void AddSeparation(const Effect& effect, std::vector<std::string>* separate_by) {
  const std::string text = effect.separate_by;
  if (text.empty()) return;
  if (std::find(separate_by->begin(), separate_by->end(), text) == separate_by->end()) {
    separate_by->push_back(text);
  }
}

void AddProbability(const std::string& id, const std::string& title, double probability,
                    std::vector<Alternative>* list) {
  const auto at = std::find_if(list->begin(), list->end(),
                               [&](const Alternative& other) { return other.id == id; });
  if (at == list->end()) {
    list->push_back({id, title, probability});
  } else {
    at->probability += probability;
  }
}

void SortAndCut(std::vector<Alternative>* list) {
  constexpr double kLeast = 0.005;
  list->erase(std::remove_if(list->begin(), list->end(),
                             [](const Alternative& a) { return a.probability < kLeast; }),
              list->end());
  std::stable_sort(list->begin(), list->end(), [](const Alternative& a, const Alternative& b) {
    return a.probability > b.probability;
  });
}

// Adds the probability of an effect to that of its finding.
void AddFinding(const Effect& effect, double probability, std::vector<Alternative>* list) {
  const Effect* finding = FindEffect(effect.Finding());  // null: of an effect of the user's
  AddProbability(effect.Finding(), (finding != nullptr ? *finding : effect).title, probability,
                 list);
}

// Probabilities of a cause: of the mechanisms of its finding, and of what else may stand in its
// place.
void AddProbabilities(const ChosenCause& chosen, Cause* cause) {
  const FittedCandidate& none = chosen.others.none;
  if (chosen.others.candidates.empty()) return;
  cause->probability = 0;
  for (const FittedCandidate& other : chosen.others.candidates) {
    const Effect& effect = *other.score.effect;
    if (other.as_slight > 0) {
      const Effect& slight = *FindEffect(effect.slight_is);
      AddProbability(slight.id, slight.title, other.as_slight, &cause->alternatives);
    }
    if (effect.Finding() == cause->id) {
      cause->probability += other.probability;
      AddProbability(effect.id, effect.title, other.probability, &cause->mechanisms);
    } else {
      AddFinding(effect, other.probability, &cause->alternatives);
    }
  }
  const double unknown = none.probability * IncompleteProbability(none.evidence);
  const Effect& structure = *FindEffect("unknown_structure");
  AddProbability("none", "no cause", none.probability - unknown, &cause->alternatives);
  AddProbability(structure.id, structure.title, unknown, &cause->alternatives);
  SortAndCut(&cause->alternatives);
  SortAndCut(&cause->mechanisms);
}

// Adds an id that the data cannot separate from the cause, once.
void AddEquivalent(const std::string& id, Cause* cause) {
  std::vector<std::string>& ids = cause->equivalents;
  if (id == cause->id || std::find(ids.begin(), ids.end(), id) != ids.end()) return;
  ids.push_back(id);
}

// Whether a law stands for another finding in this setup than its id says elsewhere.
bool StandsForAnother(const Effect& effect) {
  const Effect* const usual = FindEffect(effect.id);  // null: an effect of the user's
  return usual != nullptr && usual->Finding() != effect.Finding();
}

std::string CauseSentence(const Cause& cause, const Effect& effect) {
  std::string text = effect.sentence;
  for (const std::string& words : cause.in_words) text += "; " + words;
  return text;
}

// Standard errors of a fit's parameters for the report of one effect. The path of an effect of the
// sweep is widened: such an effect absorbs part of the module's departure from the model, so that
// the path is underestimated. Its shape parameters that are fixed by default are freed, since its
// true shape is unknown.
std::vector<double> AllowedErrors(const WeightedData& weighted, const LawFit& fit,
                                  const Effect& effect) {
  constexpr double kUnlike = 3;  // scatter between modules / estimate of one sweep
  if (weighted.path == 0 || effect.where != Where::kSweep) {
    return StandardErrors(Linearize(weighted, fit));
  }
  WeightedData allowed = weighted;
  allowed.path *= kUnlike;
  LawFit freed = fit;
  for (int k = 0; k < effect.size(); ++k) {
    if (effect.parameters[k].fixed_by_default) freed.law.freed.emplace_back(&effect, k);
  }
  return StandardErrors(Linearize(allowed, freed));
}

}  // namespace

Cause MakeCause(const Effect& effect, const char* evidence, double probability) {
  Cause cause;
  cause.id = effect.Finding();
  cause.effect = effect.id;
  cause.title = effect.title;
  cause.sentence = effect.sentence;
  cause.acts = effect.acts;
  cause.group = GroupOf(effect);
  cause.action = effect.action;
  cause.fact_sheet = effect.fact_sheet;
  cause.evidence = evidence;
  cause.probability = probability;
  return cause;
}

std::vector<CauseParameter> DescribeParameters(const WeightedData& weighted, const LawFit& fit,
                                               int index) {
  const Effect& effect = *fit.law.effects[index];
  const int first = fit.law.Offset(index);
  const std::vector<double> errors = AllowedErrors(weighted, fit, effect);
  const double spread =
      StudentT95(Degrees(weighted, fit.law)) * std::sqrt(NoiseVariance(weighted, fit));
  std::vector<CauseParameter> described;
  for (int k = 0; k < effect.size(); ++k) {
    const EffectParameter& info = effect.parameters[k];
    const double value = fit.p[first + k];
    if (value == info.absent_at) continue;
    const double factor = info.ReportedFactor(fit.p.data() + first, weighted.readings->scale);
    CauseParameter parameter{info.symbol, info.name, info.unit, value * factor,
                             kUnknown,    kUnknown,  false};
    const double slack = 1e-6 * (info.upper - info.lower);
    parameter.at_bound = value <= info.lower + slack || value >= info.upper - slack;
    if (errors[first + k] > 0) {
      const double scatter = weighted.path > 0 ? kNormal95 * info.scatter : 0;
      const double half = std::hypot(spread * errors[first + k], scatter);
      const double low = std::max(value - half, info.lower) * factor;
      const double high = std::min(value + half, info.upper) * factor;
      parameter.low_95 = std::min(low, high);
      parameter.high_95 = std::max(low, high);
    }
    described.push_back(parameter);
  }
  return described;
}

Sized NotBelowZero(const Sized& size) {
  return {size.value, std::max(size.low_95, 0.0), size.high_95};
}

Sized Recoverable(const PowerGain& gain) {
  return NotBelowZero({gain.power_W, gain.power_W - gain.half_W, gain.power_W + gain.half_W});
}

// Fills sizes and their meaning. `without`: the fit without effect `index`.
void DescribeSize(const WeightedData& weighted, const LawFit& with, int index,
                  const LawFit& without, Cause* cause) {
  cause->strength = DescribeParameters(weighted, with, index);
  cause->in_words = InWords(weighted, with, index, cause->strength);
  if (!without.usable) return;
  const EffectSize size = SizeOf(weighted, with, index, MakeWithout(weighted, without));
  const double half = size.current * size.reach;
  cause->current_effect = {size.current, std::max(size.current - half, 0.0), size.current + half};
  cause->power_effect = {size.power, size.power - size.power_error, size.power + size.power_error};
  if (size.recoverable > 0) {
    cause->recoverable_power_W = Recoverable(GainWithout(weighted, with, index));
  }
}

// Widens the interval of a power to gain, that of one cause, to what the removal of an equivalent one
// would give.
void WidenPower(const WeightedData& weighted, const FittedCandidate& equivalent, Sized* power) {
  if (!std::isfinite(power->value) || equivalent.score.effect->where != Where::kDevice) return;
  const int last = static_cast<int>(equivalent.fit.law.effects.size()) - 1;
  const double other = GainWithout(weighted, equivalent.fit, last).power_W;
  if (!std::isfinite(other)) return;
  power->low_95 = std::min(power->low_95, std::max(other, 0.0));
  power->high_95 = std::max(power->high_95, other);
}

std::vector<Cause> DescribeBelow(const Selection& selection) {
  std::vector<Cause> causes;
  for (const FittedCandidate& fitted : selection.below.candidates) {
    const Effect& effect = *fitted.score.effect;
    if (!causes.empty()) {
      Cause& first = causes.front();
      const double best = selection.below.candidates.front().probability;
      if (effect.Finding() == first.id) {
        first.probability += fitted.probability;
      } else if (fitted.probability >= kNotable * best) {
        AddEquivalent(effect.Finding(), &first);
        AddFinding(effect, fitted.probability, &first.alternatives);
      }
      continue;
    }
    Cause cause = MakeCause(effect, "fit", fitted.probability);
    DescribeSize(selection.weighted, fitted.fit,
                 static_cast<int>(fitted.fit.law.effects.size()) - 1, selection.extended, &cause);
    cause.sentence = CauseSentence(cause, effect);
    cause.in_words.clear();  // too small to act on
    cause.recoverable_power_W = {};
    causes.push_back(std::move(cause));
  }
  if (!causes.empty()) SortAndCut(&causes.front().alternatives);
  return causes;
}

std::vector<Alternative> TriedAlone(const Selection& selection) {
  std::vector<Alternative> findings;
  for (const FittedCandidate& trial : selection.trials.candidates) {
    AddFinding(*trial.score.effect, trial.probability * trial.material, &findings);
  }
  SortAndCut(&findings);
  return findings;
}

std::vector<Cause> DescribeCauses(const Selection& selection, const AtReadings& at,
                                  const ValueFindings& values) {
  std::vector<Cause> causes;
  const WeightedData& weighted = selection.weighted;
  for (std::size_t c = 0; c < selection.causes.size(); ++c) {
    const ChosenCause& chosen = selection.causes[c];
    const Effect& effect = *chosen.effect;
    const bool by_values = chosen.in_values;
    Cause cause = MakeCause(effect, by_values ? "values" : "fit", chosen.probability);
    DescribeSize(weighted, selection.extended, static_cast<int>(c), chosen.others.none.fit, &cause);
    AddProbabilities(chosen, &cause);
    if (!by_values && !StandsForAnother(effect)) AddEquivalent(effect.id, &cause);
    for (const FittedCandidate* fitted : EquivalentsOf(chosen)) {
      WidenPower(weighted, *fitted, &cause.recoverable_power_W);
      const Effect& other = *fitted->score.effect;
      const bool by_id = other.Finding() == cause.id && !StandsForAnother(other);
      AddEquivalent(by_id ? other.id : other.Finding(), &cause);
      AddSeparation(effect, &cause.separate_by);
      AddSeparation(*fitted->score.effect, &cause.separate_by);
    }
    for (const Alternative& other : cause.alternatives) {
      const bool is_slight = effect.light_missing != nullptr && other.id == effect.slight_is;
      if (!is_slight || other.probability < kNotable * cause.probability) continue;
      AddEquivalent(other.id, &cause);
      AddSeparation(*FindEffect(other.id), &cause.separate_by);
    }
    if (by_values) {
      cause.points = values.clipped;
      for (const auto* more : {&values.at_lower, &values.at_voltage_limit}) {
        cause.points.insert(cause.points.end(), more->begin(), more->end());
      }
      if (!values.at_voltage_limit.empty()) {
        const double limit = values.voltage_limit * weighted.readings->scale.cells;
        cause.strength.push_back({"Vc", "voltage_limit", "V", limit, limit, limit, false});
        cause.in_words.push_back(fmt::format("no voltage above {:.4g} V", limit));
      }
      std::sort(cause.points.begin(), cause.points.end());
    } else {
      cause.points =
          PointsIn(at.first, WhereItActs(weighted, selection.extended, static_cast<int>(c)));
    }
    if (by_values) {
      cause.in_words.push_back(std::to_string(cause.points.size()) +
                               " readings at that limit, left out of the fit");
    }
    cause.sentence = CauseSentence(cause, effect);
    causes.push_back(std::move(cause));
  }
  std::stable_sort(causes.begin(), causes.end(), [](const Cause& a, const Cause& b) {
    return a.current_effect.value > b.current_effect.value;  // false where it is unknown
  });
  if (!selection.outliers.empty()) {
    Cause cause = MakeCause(*FindEffect("outliers"), "fit", 1);
    cause.points = PointsIn(at.first, selection.outliers);
    std::sort(cause.points.begin(), cause.points.end());
    cause.in_words = {std::to_string(cause.points.size()) + " of " +
                      std::to_string(at.weighted.readings->points.size()) + " readings, left out"};
    cause.sentence = CauseSentence(cause, *FindEffect("outliers"));
    causes.push_back(std::move(cause));
  }
  return causes;
}

namespace {

// Whether one curve hides a part of an effect of the fit.
bool Hides(const Selection& selection, const std::string& id) {
  const LawFit& fit = selection.extended;
  for (std::size_t e = 0; e < fit.law.effects.size(); ++e) {
    const Effect& effect = *fit.law.effects[e];
    if (id != effect.id || effect.hides == nullptr) continue;
    return effect.hides(fit.p.data() + fit.law.Offset(static_cast<int>(e)),
                        selection.weighted.readings->traits);
  }
  return false;
}

}  // namespace

void DescribeRecoverable(const Selection& selection, Verdict* verdict) {
  // A smaller n beside named causes means that the model lacks part of them: its brightest cells
  // are darker than the device's would be.
  constexpr double kIncomplete = 0.8;
  const LawFit& fit = selection.extended;
  const std::vector<Cause>& causes = verdict->causes;
  if (std::none_of(causes.begin(), causes.end(), [](const Cause& cause) {
        return std::isfinite(cause.recoverable_power_W.value);
      })) {
    return;
  }
  verdict->recoverable_power_W = causes.size() == 1
                                     ? causes.front().recoverable_power_W
                                     : Recoverable(GainWithoutEffects(selection.weighted, fit));
  const auto limit = [](Sized* power) { *power = {kUnknown, power->low_95, kUnknown}; };
  bool any = false;
  for (Cause& cause : verdict->causes) {
    cause.at_least = std::isfinite(cause.recoverable_power_W.value) &&
                     (Ideality(fit) < kIncomplete || Hides(selection, cause.effect));
    if (cause.at_least) limit(&cause.recoverable_power_W);
    any = any || cause.at_least;
  }
  if (any) limit(&verdict->recoverable_power_W);
}

std::vector<ParameterShift> DescribeShifts(const Selection& selection) {
  const WeightedData& weighted = selection.weighted;
  const Readings& readings = *weighted.readings;
  const LawFit &before = selection.base, &after = selection.extended;
  const std::vector<double> errors = StandardErrors(Linearize(weighted, after));
  const double sd = std::sqrt(NoiseVariance(weighted, after));
  std::vector<ParameterShift> shifts;
  const std::vector<ParameterInfo> infos = after.law.BaseInfos();
  const auto add = [&](int k) {
    const double error = std::isfinite(after.p[k]) ? errors[k] * sd : kUnknown;
    shifts.push_back(
        {infos[k].symbol, infos[k].name, infos[k].unit, before.p[k], after.p[k], error});
  };
  add(kIph);
  if (readings.traits.single && !readings.traits.only_dark) {
    ParameterShift& shift = shifts.back();
    for (double* value : {&shift.before, &shift.after, &shift.standard_error}) {
      *value *= readings.points.front().irradiance;
    }
  }
  add(SaturationCurrentIndex(0));
  shifts.back().standard_error = kUnknown;  // it spreads over decades, not evenly about its value
  add(IdealityIndex(0));
  add(kRs);
  for (int k = after.law.TempcoAt(); k < after.law.base_size(); ++k) add(k);
  add(kRsh);
  if (!readings.traits.only_dark) {
    const PowerAndError now = DevicePowerAndError(weighted, after);
    shifts.push_back({"Pmax", "max_power", "W", DevicePower(weighted, before),
                      DevicePower(weighted, after), now.error * now.power_W});
  }
  return shifts;
}

}  // namespace lyrefit
