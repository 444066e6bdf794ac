#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect SeriesResistance() {
  Effect e;
  e.id = "series_resistance";
  e.title = "series resistance above that of new modules";
  e.where = Where::kDevice;
  e.equation = "pseudo fill factor - fill factor";
  e.reference = "pysch2007 (series resistance by Suns-Voc and a lit curve)";
  e.sentence =
      "the module loses more of its fill factor to series resistance than new ones do: corroded "
      "fingers and ribbons, broken joints, a connector";
  e.needs = "a Suns-Voc trace of the same module";
  e.acts = "over the whole voltage, most at the knee";
  e.confused_with = {"aged_contacts", "distributed_rs", "rs_current"};
  e.separate_by =
      "the voltages between module terminals and connectors under current, and an "
      "electroluminescence image";
  e.action =
      "measure the voltage across connectors and leads under current, then look for dark fingers "
      "and ribbons in an electroluminescence image";
  e.found_by = FoundBy::kValues;
  e.resistance = true;
  e.why_not = [](const DataTraits& traits) -> WhyNot {
    if (!traits.suns_voc) return "needs a Suns-Voc trace beside the sweep";
    return {};
  };
  return e;
}

}  // namespace lyrefit
