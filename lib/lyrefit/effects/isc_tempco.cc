#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect IscTemperatureCoefficient() {
  Effect e;
  e.id = "isc_tempco";
  e.title = "temperature coefficient of Isc not as stated";
  e.where = Where::kConditions;
  e.equation = "alpha -> alpha + c";
  e.reference = "iec60891";
  e.sentence = "the short-circuit current follows the temperature otherwise than stated";
  e.needs = "several temperatures, and a stated coefficient";
  e.acts = "short-circuit current against temperature";
  e.confused_with = {"sensor_nonlin"};
  e.separate_by = "a measurement of the coefficient at constant light";
  e.action = "check the temperature coefficient of Isc that was stated";
  e.in_words = [](const FittedEffect& of) -> Phrases {
    return {SignedSize(Scaled(of.Of("c"), 100), "%/K", "more", "less") + " than stated"};
  };
  e.parameters = {Parameter("c", "tempco_error", "true minus stated, relative")
                      .Unit("1/K")
                      .Between(-0.01, 0.01)};
  e.conditions = [](const auto* p, const auto&, auto* conditions) {
    conditions->isc_tempco_per_K = conditions->isc_tempco_per_K + p[0];
  };
  e.why_not = [](const DataTraits& traits) -> WhyNot {
    if (auto why = NeedsTemperatures(traits)) return why;
    if (!traits.tempco_known) return "no coefficient is stated: the base model estimates it";
    return {};
  };
  e.probes = [](const DataTraits&) { return Strengths({0.0001}); };
  return e;
}

}  // namespace lyrefit
