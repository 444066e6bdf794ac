#include <algorithm>
#include <utility>

#include "lyrefit/diagnose/fit_effect.h"
#include "lyrefit/diagnose/prefer.h"
#include "lyrefit/diagnose/select.h"

namespace lyrefit {

void FindRivals(const SelectOptions& options, Selection* selection) {
  for (std::size_t c = 0; c < selection->causes.size(); ++c) {
    const Workbench& bench = selection->bench;
    Begin(options.watch, "rivals", static_cast<std::int64_t>(options.candidates.size()));
    selection->without.push_back(FitWithout(bench, selection->extended, static_cast<int>(c)));
    const LawFit& without = selection->without.back();
    if (!without.usable || Stopped(options.watch)) continue;
    if (selection->causes[c].in_values) continue;
    std::vector<const Effect*> open;
    for (const Effect* effect : options.candidates) {
      if (effect->probes != nullptr && CanAdd(without.law, *effect)) open.push_back(effect);
    }
    const LawFit& extended = selection->extended;
    const double variance = NoiseVariance(bench, extended);
    std::vector<Rival>& rivals = selection->causes[c].rivals;
    const std::vector<Score> scores =
        JudgeScores(PrepareAll(bench, without, open, &selection->imprints), *selection->worth);
    const double hopeless = HopelessStatistic(scores);
    for (const Score& score : scores) {
      Step(options.watch);
      if (!score.testable) continue;
      if (Stopped(options.watch)) break;
      if (score.statistic < hopeless && score.effect != selection->causes[c].effect) continue;
      Rival rival{score, FitEffect(bench, without, score), 0};
      if (!rival.fit.usable) continue;
      const bool own = score.effect == selection->causes[c].effect;
      const double sum = own ? std::min(rival.fit.sum, selection->extended.sum) : rival.fit.sum;
      rival.statistic = (without.sum - sum) / variance;
      rival.freedom = FreedomOf(bench, rival.fit.law);
      const bool has_floors = options.floors.current > 0 || options.floors.power > 0;
      if (has_floors && !own && !HasPossibleSize(*bench.readings, without, rival)) continue;
      rivals.push_back(std::move(rival));
    }
    std::stable_sort(rivals.begin(), rivals.end(),
                     [](const Rival& a, const Rival& b) { return a.Charged() > b.Charged(); });
  }
}

}  // namespace lyrefit
