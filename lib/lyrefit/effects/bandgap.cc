#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect Bandgap() {
  Effect e;
  e.id = "bandgap";
  e.title = "band gap not as stated";
  e.where = Where::kConditions;
  e.equation = "Eg -> Eg + c";
  e.reference = "desoto2006";
  e.sentence = "the open-circuit voltage falls with temperature as with another band gap";
  e.needs = "several temperatures, and a stated band gap";
  e.acts = "open-circuit voltage against temperature";
  e.confused_with = {"temp_offset", "voltage_offset", "temp_gradient"};
  e.separate_by = "a second thermometer on the cell; four temperatures or more";
  e.action = "check the technology and the thermometer";
  e.in_words = [](const FittedEffect& of) -> Phrases {
    return {SignedSize(of.Of("c"), "eV", "more", "less") + " than stated"};
  };
  e.parameters = {
      Parameter("c", "bandgap_error", "true minus stated").Unit("eV").Between(-0.5, 0.5)};
  e.conditions = [](const auto* p, const auto&, auto* conditions) {
    conditions->bandgap_eV = conditions->bandgap_eV + p[0];
  };
  e.why_not = [](const DataTraits& traits) -> WhyNot {
    if (auto why = NeedsTemperatures(traits)) return why;
    if (!traits.bandgap_known) return "no band gap is stated: the base model estimates it";
    return {};
  };
  e.probes = [](const DataTraits&) { return Strengths({0.01}); };
  return e;
}

}  // namespace lyrefit
