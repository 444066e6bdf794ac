#include "lyrefit/diagnose/select.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "lyrefit/diagnose/choose_base.h"
#include "lyrefit/diagnose/equivalents.h"
#include "lyrefit/diagnose/fit_effect.h"
#include "lyrefit/diagnose/prefer.h"
#include "lyrefit/diagnose/weigh_rivals.h"
#include "lyrefit/diagnose/wrong_readings.h"
#include "lyrefit/effects/catalogue.h"

namespace lyrefit {
namespace {

class Selector {
 public:
  Selector(const Measurement& measurement, const std::vector<char>& used, double correlation,
           const SelectOptions& options)
      : measurement_(measurement),
        readings_(measurement.readings),
        values_(measurement.values),
        options_(options),
        worth_(options.worth),
        imprints_(options.imprints),
        bench_{&readings_,
               std::vector<double>(readings_.points.size(), 1e-3),
               used,
               correlation,
               0,
               0,
               options.watch} {
    for (const int k : values_.at_lower) bench_.used[k] = 0;
    for (const int k : values_.at_voltage_limit) bench_.used[k] = 0;
  }

  Selection Run() {
    Stage("base fit", 3);
    Law law = options_.base;
    if (readings_.points.size() <= kQuickToFit) bench_.watch = nullptr;
    FitBaseLaw(law);
    bench_.watch = options_.watch;
    Selection selection;
    selection.base = selection.extended = fit_;
    selection.bench = selection.base_bench = bench_;
    if (!fit_.usable) return selection;
    CountStep();
    SettleNoise();
    CountStep();
    if (options_.start.empty()) law = ChooseLaw(bench_, law);
    FitBaseLaw(law);
    if (Stopped(bench_.watch)) fit_ = selection.base;
    selection.base = fit_;
    selection.base_bench = bench_;
    if (values_.HasLimits()) AddClip();
    Prepared prepared = PrepareAll(bench_, fit_, Open(), &imprints_);
    FindWorth(prepared);
    Extend(std::move(prepared), &selection);
    selection.extended = fit_;
    selection.causes = causes_;
    selection.outliers = wrong_.readings;
    selection.at_rest = wrong_.at_rest;
    selection.outlier_p = wrong_.p;
    selection.bench = bench_;
    selection.noise = noise_;
    selection.worth = worth_;
    selection.imprints = imprints_;
    return selection;
  }

 private:
  void SettleNoise() { noise_ = lyrefit::SettleNoise(measurement_, &bench_, &fit_); }

  void FitBaseLaw(const Law& law) {
    fit_ = options_.start.empty() ? FitBase(bench_, law) : FitLaw(bench_, law, options_.start);
  }

  // The watch hears of the selection itself, not of its repetitions.
  void Stage(const char* name, std::size_t steps) const {
    if (options_.trials) Begin(bench_.watch, name, static_cast<std::int64_t>(steps));
  }
  void CountStep() const {
    if (options_.trials) Step(bench_.watch);
  }

  // Clipped readings say no more than that they were clipped: they are left out, and the limit
  // stays what the values show.
  void AddClip() {
    for (const int k : values_.clipped) bench_.used[k] = 0;
    const Effect* clip = FindEffect("clip");
    Law law = fit_.law;
    law.effects.push_back(clip);
    std::vector<double> start = fit_.p;
    start.push_back(values_.clip_level > 0 ? values_.clip_level : kNoUpperLimit);
    start.push_back(values_.limited ? values_.lower_limit : kNoLowerLimit);
    fit_ = FitLaw(bench_, law, start);
    causes_.push_back({clip, 0, {}, {}, true});
    SettleNoise();
  }

  void FindWorth(const Prepared& prepared) {
    if (worth_ != nullptr) return;
    const bool voltage = noise_.lit.voltage > 0 || noise_.dark.voltage > 0;
    const NoiseEstimator noise(measurement_, bench_.used,
                               voltage ? VoltageNoise::kAlways : VoltageNoise::kNever);
    worth_ = std::make_shared<const ScoreWorth>(
        SimulateWorth(bench_, prepared, &noise, options_.draws, options_.seed));
  }

  std::vector<const Effect*> Open() const {
    std::vector<const Effect*> open;
    for (const Effect* effect : options_.candidates) {
      if (CanAdd(fit_.law, *effect)) open.push_back(effect);
    }
    return open;
  }

  double Variance(const LawFit& fit) const { return NoiseVariance(bench_, fit); }

  // Fits the effects that stand a chance; with `all` the others as well, for the record. Where
  // nothing `is_there` all are.
  std::vector<Rival> FitAll(const std::vector<Score>& scores, bool all = false,
                            bool is_there = true) const {
    std::vector<Rival> rivals;
    Stage("selection", scores.size());
    const double hopeless =
        std::max(HopelessStatistic(scores), LeastOfTheBest(scores, options_.most_rivals));
    // Nothing is worth a name that is smaller than what the present law misses.
    const bool may_matter =
        options_.floors.current > 0 && MissedBy(bench_, fit_) > options_.floors.current;
    const bool astray = may_matter || LeadsAstray(bench_, fit_);
    for (const Score& score : scores) {
      CountStep();
      // What the shape of the curve suggests does not hang on scores that a fault ruins.
      const bool by_shape =
          astray && is_there && score.effect->starts != nullptr && readings_.traits.single;
      const bool fits = by_shape || (score.testable && (all || score.statistic >= hopeless) &&
                                     score.effect->probes != nullptr);
      if (!fits || Stopped(bench_.watch)) continue;
      const bool briefly = !by_shape && (!is_there || score.statistic < hopeless);
      const Effort effort = briefly               ? Effort::kForTheRecord
                            : options_.in_passing ? Effort::kInPassing
                                                  : Effort::kFull;
      const LawFit* met = FindMet(*score.effect);
      Rival rival{score, {}, 0};
      if (met != nullptr) rival.fit = FitOnwards(bench_, *met);
      if (!rival.fit.usable) rival.fit = FitEffect(bench_, fit_, score, effort);
      FitFromHint(&rival);
      if (rival.fit.usable) rivals.push_back(std::move(rival));
    }
    double variance = Variance(fit_);
    for (const Rival& rival : rivals) variance = std::min(variance, Variance(rival.fit));
    for (Rival& rival : rivals) {
      rival.statistic = (fit_.sum - rival.fit.sum) / variance;
      rival.freedom = FreedomOf(bench_, rival.fit.law);
      rival.corrected_p = CorrectedP(rival.score, rival.statistic, Degrees(bench_, rival.fit.law),
                                     worth_->calibration);
    }
    std::stable_sort(rivals.begin(), rivals.end(),
                     [](const Rival& a, const Rival& b) { return a.Charged() > b.Charged(); });
    return rivals;
  }

  bool HasFloors() const { return options_.floors.current > 0 || options_.floors.power > 0; }

  // Without floors a later cause explains its part in units of the noise: what remains of a first
  // cause whose own model is a little wrong is no second cause.
  bool ExplainsEnough(const Rival& rival) const {
    constexpr double kLaterPart = 0.02, kGenericPart = 0.05;
    const bool generic = IsGeneric(readings_, *rival.score.effect);
    return rival.statistic >= (generic ? kGenericPart : kLaterPart) * first_gain_;
  }

  // Whether the base model is so far off that scores beside it say nothing.
  bool IsRuined() const {
    constexpr double kMisfit = 0.01;
    if (!measurement_.has_path()) return false;
    return MissedBy(bench_, fit_) > kMisfit;
  }

  std::vector<Rival> Weigh(const std::vector<Rival>& all, std::vector<Rival>* below) const {
    return WeighRivals(bench_, fit_, all, {options_.floors, level_, first_misfit_}, below);
  }

  // The fit with one more effect of the selection that this one repeats. What is searched there is
  // searched here as well.
  const LawFit* FindMet(const Effect& effect) const {
    const auto searched = [](const EffectParameter& parameter) { return parameter.searched; };
    if (options_.met == nullptr || !fit_.law.effects.empty()) return nullptr;
    if (std::any_of(effect.parameters.begin(), effect.parameters.end(), searched)) return nullptr;
    const auto at = std::find_if(options_.met->begin(), options_.met->end(),
                                 [&](const Rival& r) { return r.score.effect == &effect; });
    return at != options_.met->end() && at->fit.usable ? &at->fit : nullptr;
  }

  // Once more from where the effect was found before.
  void FitFromHint(Rival* rival) const {
    const Law& hint = options_.hint.law;
    const auto at = std::find(hint.effects.begin(), hint.effects.end(), rival->score.effect);
    if (!options_.hint.usable || at == hint.effects.end()) return;
    const std::vector<double>& p = options_.hint.p;
    const auto own = p.begin() + hint.Offset(static_cast<int>(at - hint.effects.begin()));
    Law law = fit_.law;
    law.effects.push_back(*at);
    law.freed = hint.freed;
    std::vector<double> start = fit_.p;
    std::copy(p.begin(), p.begin() + law.base_size(), start.begin());
    start.insert(start.end(), own, own + (*at)->size());
    LawFit end = FitLaw(bench_, law, start, UpTo(20, 1e-6));
    if (end.usable && (!rival->fit.usable || end.sum < rival->fit.sum)) rival->fit = std::move(end);
  }

  void Extend(Prepared prepared, Selection* selection) {
    const int most = options_.largest_causes + static_cast<int>(causes_.size());
    std::set<std::set<const Effect*>> seen;
    std::vector<Rival> rivals;  // of the step before where that took a single reading
    for (int step = 0;; ++step) {
      if (step > 0) prepared = PrepareAll(bench_, fit_, Open(), &imprints_);
      const std::vector<Score> scores = JudgeScores(prepared, *worth_);
      if (Stopped(bench_.watch)) return;
      double smallest = 1;
      for (const Score& score : scores) {
        if (score.testable) smallest = std::min(smallest, score.corrected_p);
      }
      const Score* unknown = FindScore(scores, FoundBy::kWaves);
      selection->unknown_p = unknown != nullptr && unknown->testable ? unknown->corrected_p : 1;
      const bool later = !causes_.empty() || !wrong_.readings.empty();
      level_ = options_.level * (later ? kLaterLevel : 1);
      const bool is_there = smallest < level_ || (step == 0 && IsRuined());
      if (step == 0 && options_.trials) {
        selection->trials = rivals = FitAll(scores, true, is_there);
        AddUntried(scores, &selection->trials);
      }
      if (!is_there) return;
      if (static_cast<int>(causes_.size()) >= most) return;
      // Causes gain little from a reading less: no new fits where the next stands out by far.
      const bool left = step > 0 && !rivals.empty();
      if (left && StandsOut(scores) && LeaveOut(scores, rivals)) continue;
      if (step > 0 || !options_.trials) rivals = FitAll(scores);
      if (Stopped(bench_.watch)) return;
      if (LeaveOut(scores, rivals)) continue;
      if (HasFloors()) {
        selection->below.clear();
        rivals = Weigh(rivals, &selection->below);
        if (rivals.empty()) return;
        if (causes_.empty())
          first_misfit_ = std::pow(Departure(bench_, fit_, rivals.front().fit.current), 2);
      }
      if (!HasFloors() && !rivals.empty()) {
        if (causes_.empty()) first_gain_ = rivals.front().statistic;
        if (!ExplainsEnough(rivals.front())) return;
      }
      if (rivals.empty() || !Accept(rivals.front())) {
        selection->unknown =
            causes_.empty() && wrong_.readings.empty() && selection->unknown_p < level_;
        return;
      }
      selection->below.clear();  // beside a model that is the past
      Exchange();
      Prune();
      if (Readmit(&bench_, &fit_, &wrong_)) SettleNoise();
      const std::set<const Effect*> present(fit_.law.effects.begin(), fit_.law.effects.end());
      if (!seen.insert(present).second) return;  // what was dropped came back
      rivals.clear();
    }
  }

  // Effects that were scored but have nothing to fit are trials as well.
  static void AddUntried(const std::vector<Score>& scores, std::vector<Rival>* trials) {
    for (const Score& score : scores) {
      const bool there = std::any_of(trials->begin(), trials->end(), [&](const Rival& r) {
        return r.score.effect == score.effect;
      });
      if (!there) trials->push_back({score, {}, 0});
    }
  }

  bool LeaveOut(const std::vector<Score>& scores, const std::vector<Rival>& rivals) {
    const bool left_out = LeaveOutFurthest(scores, rivals, level_, &bench_, &fit_, &wrong_);
    if (left_out) SettleNoise();
    return left_out;
  }

  bool Accept(const Rival& rival) {
    double p = rival.corrected_p;
    const bool proven = HasFloors() && causes_.empty() &&
                        rival.score.effect->where == Where::kSweep && LightMoved(readings_);
    if (proven) p = 0;
    if (!(p < level_)) return false;
    fit_ = rival.fit;
    causes_.push_back({rival.score.effect, p, rival.score, {}});
    SettleNoise();
    if (HasFloors() && rival.score.effect->momentary) FreeShape(*rival.score.effect);
    return true;
  }

  // A moment of the light that is there has the shape that it has, where that is worth its freedom.
  void FreeShape(const Effect& effect) {
    Law law = fit_.law;
    for (int k = 0; k < effect.size(); ++k) {
      if (effect.parameters[k].held) law.freed.emplace_back(&effect, k);
    }
    if (law.freed.size() == fit_.law.freed.size()) return;
    LawFit freed = FitLaw(bench_, law, fit_.p);
    const double paid = FreedomOf(bench_, law) - FreedomOf(bench_, fit_.law);
    if (!freed.usable || !(freed.sum + paid * Variance(freed) < fit_.sum)) return;
    fit_ = std::move(freed);
    SettleNoise();
  }

  // Every cause but the last gives its place to any effect that does better beside the others.
  void Exchange() {
    if (options_.in_passing) return;
    for (int round = 0; round < 2; ++round) {
      bool changed = false;
      for (int c = 0; c + 1 < static_cast<int>(causes_.size()); ++c) {
        if (causes_[c].in_values) continue;
        if (Stopped(bench_.watch)) return;
        changed = ExchangeOne(c) || changed;
      }
      if (!changed) return;
    }
  }

  bool ExchangeOne(int c) {
    const LawFit present = fit_;
    const std::vector<ChosenCause> chosen = causes_;
    const Effect* effect = causes_[c].effect;
    fit_ = FitWithout(bench_, present, c);
    causes_.erase(causes_.begin() + c);
    if (fit_.usable) {
      std::vector<Rival> rivals =
          FitAll(JudgeScores(PrepareAll(bench_, fit_, Open(), &imprints_), *worth_));
      const auto own = std::find_if(rivals.begin(), rivals.end(),
                                    [&](const Rival& r) { return r.score.effect == effect; });
      const double kept =
          own == rivals.end()
              ? 0
              : own->Charged() + std::max(0.0, own->fit.sum - present.sum) / Variance(present);
      const bool stopped = Stopped(bench_.watch);
      std::vector<Rival> below;
      if (HasFloors()) rivals = Weigh(rivals, &below);
      if (!stopped && !rivals.empty() && rivals.front().score.effect != effect &&
          rivals.front().Charged() > kept + 1) {
        fit_ = rivals.front().fit;
        causes_.push_back(
            {rivals.front().score.effect, chosen[c].corrected_p, rivals.front().score, {}});
        SettleNoise();
        return true;
      }
    }
    fit_ = present;
    causes_ = chosen;
    return false;
  }

  // Drops causes that the later ones made idle.
  void Prune() {
    for (int c = static_cast<int>(causes_.size()) - 1; c >= 0 && causes_.size() > 1; --c) {
      if (causes_[c].in_values) continue;
      LawFit without = FitWithout(bench_, fit_, c);
      if (!without.usable || Stopped(bench_.watch)) continue;
      const double loss = (without.sum - fit_.sum) / Variance(fit_);
      if (CorrectedP(causes_[c].score, loss, Degrees(bench_, fit_.law), worth_->calibration) <
          options_.level * kLaterLevel)
        continue;
      fit_ = std::move(without);
      causes_.erase(causes_.begin() + c);
      SettleNoise();
    }
  }

  const Measurement& measurement_;
  const Readings& readings_;
  const ValueFindings& values_;
  const SelectOptions& options_;
  std::shared_ptr<const ScoreWorth> worth_;
  Imprints imprints_;
  Workbench bench_;
  Noise noise_;
  LawFit fit_;
  std::vector<ChosenCause> causes_;
  WrongReadings wrong_;
  double level_ = 0;         // of the present step
  double first_gain_ = 0;    // statistic of the first cause that was fitted
  double first_misfit_ = 0;  // mean square of what the first cause took away, in scales
};

}  // namespace

Selection SelectCauses(const Measurement& measurement, const std::vector<char>& used,
                       double correlation, const SelectOptions& options) {
  return Selector(measurement, used, correlation, options).Run();
}

}  // namespace lyrefit
