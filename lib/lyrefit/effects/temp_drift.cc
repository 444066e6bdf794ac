#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect TemperatureDrift() {
  Effect e;
  e.id = "temp_drift";
  e.title = "drift of the cell temperature";
  e.where = Where::kSweep;
  e.equation = "T -> T + r x, x = -1/2 .. 1/2 over the measurement";
  e.reference = "iec60904_1 (temperature stable during the sweep)";
  e.sentence = "the cells warmed or cooled while the curve was taken";
  e.needs = "a sweep up and down";
  e.acts = "near open circuit, in the order of time";
  e.confused_with = {"drift", "timing_skew", "capacitance"};
  e.separate_by = "a sweep up and down; a shorter sweep";
  e.action = "repeat the sweep faster, after the module has settled in the light";
  e.prior = {0.003, 0.003, kSkyPrior, {{InFlasher, 0, "a flash does not warm the cells"}}};
  e.in_words = [](const FittedEffect& of) -> Phrases {
    return {SignedSize(of.Of("r"), "K", "warmer", "colder") + " at the end than at the begin"};
  };
  e.parameters = {Parameter("r", "temperature_change", "warming over the measurement")
                      .Unit("K")
                      .Between(-10, 10)
                      .AboveLower()
                      .BelowUpper()
                      .Usual(0.5)};
  e.conditions = [](const auto* p, const auto& reading, auto* conditions) {
    conditions->temperature_K = conditions->temperature_K + p[0] * reading.x;
  };
  e.why_not = NeedsOneLitCondition;
  e.probes = [](const DataTraits&) { return Strengths({1}); };
  return e;
}

}  // namespace lyrefit
