#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/diagnose/decision_constants.h"
#include "lyrefit/diagnose/describe.h"
#include "lyrefit/diagnose/device_findings.h"
#include "lyrefit/diagnose/effect_size.h"
#include "lyrefit/diagnose/fit_effect.h"
#include "lyrefit/diagnose/known_effects.h"
#include "lyrefit/effects/catalogue.h"

namespace lyrefit {
namespace {

// Scatter of the fill factor among modules of silicon without a fault, about that of a junction with
// n = 1.15 less the usual loss by resistance, one standard deviation: eight new modules in a flasher
// have -0.01 to +0.03, 30 sound sweeps outdoors, with their cables and warm, -0.045 to +0.05.
constexpr double kScatter = 0.025;
constexpr double kDeviations = 2.5;
// The least of thin-film modules on data sheets: CdTe, CIGS and a-Si go down to it.
constexpr double kLeastOfFilms = 0.6;

// The member of a set that stands for a parameter of the base model out of range.
const char* EffectOf(const std::string& finding) {
  if (finding == "leak") return "graded_shunt";
  if (finding == "ideality") return "second_diode";
  return "distributed_rs";
}

// Effects that lower the fill factor of a sweep without a step: of the device, and none of them lets
// a bypass diode conduct.
bool Lowers(const Effect& effect) {
  static constexpr std::string_view kIds[] = {"second_diode", "distributed_rs", "aged_contacts",
                                              "rs_current",   "graded_shunt",   "leaky_cell",
                                              "weak_cell",    "mismatch",       "scatter"};
  return std::find(std::begin(kIds), std::end(kIds), effect.id) != std::end(kIds);
}

// The base model with one more effect: the trial of the selection, or a fit that starts from the base
// model and from typical parameters, whichever is better.
LawFit FitMember(const Selection& selection, const Effect& effect) {
  const WeightedData& weighted = selection.base_weighted;
  Signatures signatures;
  const std::vector<Score> scores = ScoreEffects(weighted, selection.base, {&effect}, &signatures);
  LawFit fit = scores.empty() ? LawFit() : FitEffect(weighted, selection.base, scores.front());
  for (const FittedCandidate& trial : selection.trials.candidates) {
    if (trial.score.effect != &effect || !trial.fit.usable) continue;
    if (!fit.usable || trial.fit.sum < fit.sum) fit = trial.fit;
  }
  return fit;
}

double RelativeError(const WeightedData& weighted) {
  constexpr double kLeast = 0.002;
  return std::max(kLeast, weighted.path);
}

// None for cells and thin films, before the knee, and where light or cells are not stated.
std::optional<FillFactor> FindFillFactor(const Selection& selection, const DeviceKind& kind) {
  const WeightedData& weighted = selection.weighted;
  const Readings& readings = *weighted.readings;
  const DataTraits& traits = readings.traits;
  const bool counted = traits.cells_known && traits.cells == traits.stated_cells;
  if (!traits.module || traits.only_dark || !traits.single || !counted || !kind.irradiance_known ||
      IsThinFilm(kind.technology) || !ReachesPastKnee(readings)) {
    return {};
  }
  LawFit with_resistance = selection.extended;
  for (int e = static_cast<int>(with_resistance.law.effects.size()) - 1; e >= 0; --e) {
    if (with_resistance.law.effects[e]->resistance) continue;
    with_resistance = TakenOut(with_resistance, e);
  }
  const KeyPoints own = DeviceKeyPoints(weighted, with_resistance);
  if (!(own.fill_factor > 0)) return {};
  const double light = InBrightestLight(readings).points.front().irradiance;
  const double thermal_V = ThermalVoltage(readings.reference_temperature_K) * readings.scale.cells;
  FillFactor fill;
  const double half = kNormal95 * RelativeError(weighted) * own.fill_factor;
  fill.value = {own.fill_factor, own.fill_factor - half, own.fill_factor + half};
  fill.usual = GreenFillFactor(own.open_circuit_voltage_V, kUsualIdeality * thermal_V) -
               kUsualResistanceLoss * light;
  fill.least = fill.usual - kDeviations * kScatter;
  fill.if_silicon = kind.technology.empty() && own.fill_factor > kLeastOfFilms;
  const double product = own.short_circuit_current_A * own.open_circuit_voltage_V;
  const double lost = fill.usual - own.fill_factor;
  const double reach = std::hypot(half, kNormal95 * kScatter);
  fill.lost_W = {product * lost, product * (lost - reach), product * (lost + reach)};
  const double whole = fill.usual * product;
  fill.lost = {fill.lost_W.value / whole, fill.lost_W.low_95 / whole, fill.lost_W.high_95 / whole};
  return fill;
}

std::optional<Cause> CauseOfFillFactor(const FillFactor& fill_factor, const Selection& selection,
                                       const std::vector<DeviceFinding>& findings,
                                       const std::vector<const Effect*>& candidates,
                                       bool resistance_is_known, const JudgeOptions& judge) {
  if (!IsLow(fill_factor) || fill_factor.if_silicon) return {};
  constexpr double kMostOfIt = 0.5;
  for (const DeviceFinding& finding : findings) {
    const bool most = finding.power_loss > kMostOfIt * fill_factor.lost.value;
    if (finding.id != "leak" && most) return {};  // shunts draw what aged contacts do
  }
  Hypotheses set;
  set.none.fit = selection.base;
  if (!findings.empty()) {  // n beside a leak is what the leak leaves
    const auto leak =
        std::find_if(findings.begin(), findings.end(),
                     [](const DeviceFinding& finding) { return finding.id == "leak"; });
    Score score;
    score.effect = FindEffect(EffectOf(leak != findings.end() ? leak->id : findings.front().id));
    set.candidates.push_back({score, selection.base});
  }
  for (const Effect* effect : candidates) {
    if (!Lowers(*effect) || (resistance_is_known && effect->resistance)) continue;
    Score score;
    score.effect = effect;
    LawFit fit = FitMember(selection, *effect);
    if (fit.usable) set.candidates.push_back({score, std::move(fit)});
  }
  Judge(selection.base_weighted, selection.base, judge, &set);
  std::map<std::string, double> weights;
  for (const FittedCandidate& member : set.candidates) {
    weights[member.score.effect->Finding()] += member.probability + member.as_slight;
  }
  if (weights.empty()) return {};
  double sum = 0;
  for (const auto& [id, weight] : weights) sum += weight;
  const auto best =
      std::max_element(weights.begin(), weights.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  const Effect& effect = *FindEffect(best->first);
  Cause cause = MakeCause(effect, "fit", best->second / sum);
  cause.separate_by = {effect.separate_by};
  for (const auto& [id, weight] : weights) {
    constexpr double kLeast = 0.005;
    if (id == best->first || weight < kLeast * sum) continue;
    const Effect& other = *FindEffect(id);
    cause.alternatives.push_back({id, other.title, weight / sum});
  }
  std::stable_sort(
      cause.alternatives.begin(), cause.alternatives.end(),
      [](const Alternative& a, const Alternative& b) { return a.probability > b.probability; });
  for (const Alternative& other : cause.alternatives) {
    if (other.probability < kNotable * cause.probability) continue;
    cause.equivalents.push_back(other.id);
    const std::string separate_by = FindEffect(other.id)->separate_by;
    if (std::find(cause.separate_by.begin(), cause.separate_by.end(), separate_by) ==
        cause.separate_by.end()) {
      cause.separate_by.push_back(separate_by);
    }
  }
  cause.in_words = {fmt::format(
      "the fill factor is {:.3f}, modules without a fault of this voltage have {:.3f}: {:.0f} % of "
      "Pmax ({:.0f} to {:.0f}) whichever it is; one sweep does not tell which",
      fill_factor.value.value, fill_factor.usual, 100 * fill_factor.lost.value,
      100 * fill_factor.lost.low_95, 100 * fill_factor.lost.high_95)};
  cause.sentence += "; " + cause.in_words.front();
  cause.action =
      "before any work a measurement that decides, as each of them asks for another: a Suns-Voc "
      "trace or a dark curve, or the sweep at a third of the light";
  cause.fact_sheet.clear();
  cause.recoverable_power_W = NotBelowZero(fill_factor.lost_W);
  return cause;
}

// What all causes cost, where one of them is sized against modules without a fault: their sum.
// Unknown without a cause of known power.
void AddUpRecoverable(Verdict* verdict) {
  Sized sum;
  for (const Cause& cause : verdict->causes) {
    const Sized& one = cause.recoverable_power_W;
    if (!std::isfinite(one.low_95)) continue;
    const bool first = !std::isfinite(sum.low_95);
    sum = first ? one
                : Sized{sum.value + one.value, sum.low_95 + one.low_95, sum.high_95 + one.high_95};
  }
  verdict->recoverable_power_W = sum;
}

}  // namespace

bool IsLow(const FillFactor& fill_factor) { return fill_factor.value.high_95 < fill_factor.least; }

void JudgeFillFactor(const Selection& selection, const DeviceKind& kind,
                     const DiagnoseOptions& options, Verdict* verdict) {
  verdict->resistance_loss = FindResistanceLoss(selection, kind.technology);
  verdict->fill_factor = FindFillFactor(selection, kind);
  const std::vector<Cause>& causes = verdict->causes;
  const auto any = [&] { return std::any_of(causes.begin(), causes.end(), IsResistance); };
  const bool before = any();
  if (!(options.floor_power > 0)) return;
  if (verdict->resistance_loss) {
    const bool wanted = IsWanted(*FindEffect("series_resistance"), options);
    JudgeResistance(*verdict->resistance_loss, selection, wanted, verdict);
  } else if (verdict->fill_factor) {
    for (Cause& cause : verdict->causes) {
      if (IsResistance(cause))
        cause.recoverable_power_W = NotBelowZero(verdict->fill_factor->lost_W);
    }
  }
  if ((before || any()) && verdict->fill_factor) AddUpRecoverable(verdict);
}

void NameFillFactor(const Selection& selection, const std::vector<DeviceFinding>& findings,
                    const std::vector<const Effect*>& candidates, const JudgeOptions& judge,
                    const DiagnoseOptions& options, Verdict* verdict) {
  const bool asked = options.floor_power > 0 && options.effects.empty();
  if (!asked || !verdict->fill_factor || !verdict->causes.empty()) return;
  auto cause = CauseOfFillFactor(*verdict->fill_factor, selection, findings, candidates,
                                 verdict->resistance_loss.has_value(), judge);
  if (!cause) return;
  verdict->causes.push_back(std::move(*cause));
  verdict->found = true;
  AddUpRecoverable(verdict);
}

}  // namespace lyrefit
