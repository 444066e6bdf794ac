#include "lyrefit/effects/catalogue_entries.h"
#include "lyrefit/effects/needs.h"

namespace lyrefit {

Effect Clip() {
  Effect e;
  e.id = "clip";
  e.title = "clipped current";
  e.where = "instrument";
  e.equation = "I -> min(I, Ic)";
  e.reference = "instrument manual (range, compliance)";
  e.sentence = "the instrument ran into the end of its range: the top of the curve is flat";
  e.needs = "any lit curve; exact repeats of the largest current give it away";
  e.acts = "at the largest currents";
  e.confused_with = {"transient", "collection"};
  e.separate_by = "repeat with a larger current range";
  e.parameters = {
      {"Ic", "limit", "A", "largest current that is recorded", 0.05, 1.5, 1.3, false, 1, 1}};
  e.instrument = [](const auto* p, const Reading&, auto* solved) {
    if (p[0] < solved->current) solved->current = p[0];
  };
  e.why_not = NeedsLight;
  e.probes = [](const DataTraits&) { return Strengths({0.995, 0.99, 0.98, 0.965, 0.94, 0.9}); };
  return e;
}

}  // namespace lyrefit
