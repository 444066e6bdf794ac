#include <algorithm>

#include "lyrefit/effects/catalogue.h"
#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect Clip() {
  Effect e;
  e.id = "clip";
  e.title = "clipped readings";
  e.where = Where::kInstrument;
  e.equation = "I -> max(Il, min(I, Ic)), V -> min(V, Vc)";
  e.reference = "instrument manual (range, compliance)";
  e.sentence = "the instrument or its load ran into the end of its range: readings stand still";
  e.needs =
      "any lit curve; exact repeats of the largest or smallest current, or of the largest voltage, "
      "give it away";
  e.acts = "at the largest or smallest currents, or at the largest voltages";
  e.confused_with = {"transient", "collection"};
  e.separate_by = "repeat with a larger range or compliance";
  e.action = "repeat the sweep with a larger range or compliance";
  e.prior = {0.002, 0.002, kTracerPrior};
  e.in_words = [](const FittedEffect& of) -> Phrases {
    Phrases words;
    const Sized most = of.Of("Ic"), least = of.Of("Il");
    const double scale = of.readings.scale.current_A;
    if (most.value < 1.4 * scale) words.push_back("no current above " + AmpereText(most.value));
    if (least.value > -10 * scale) words.push_back("no current below " + AmpereText(least.value));
    return words;
  };
  e.parameters = {
      Parameter("Ic", "limit", "largest current that is recorded")
          .Unit("A")
          .Between(0.05, kNoUpperLimit)
          .From(1.3)
          .CurrentPower(1)
          .AbsentAt(kNoUpperLimit),
      Parameter("Il", "lower_limit", "smallest current that is recorded")
          .Unit("A")
          .Between(kNoLowerLimit, 0.9)
          .From(kNoLowerLimit)
          .Searched()
          .CurrentPower(1)
          .AbsentAt(kNoLowerLimit),
  };
  e.instrument = [](const auto* p, const auto&, auto* solved) {
    const auto above = (p[0] < solved->current) & (p[0] < kNoUpperLimit);
    solved->current = Choose(above, p[0], solved->current);
    const auto below = (solved->current < p[1]) & (kNoLowerLimit < p[1]);
    solved->current = Choose(below, p[1], solved->current);
  };
  e.why_not = NeedsLight;
  e.probes = [](const DataTraits& traits) {
    std::vector<Probe> probes;
    const double largest = traits.reverse ? std::max(traits.largest_current, 1.0) : 1;
    for (const double limit : {0.995, 0.99, 0.98, 0.965, 0.94, 0.9}) {
      probes.push_back({limit * largest, kNoLowerLimit});
    }
    if (traits.reverse) probes.push_back({largest, kNoLowerLimit});
    return probes;
  };
  return e;
}

}  // namespace lyrefit
