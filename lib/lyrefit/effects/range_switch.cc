#include <fmt/format.h>

#include "lyrefit/effects/parts.h"

namespace lyrefit {

// An offset c of the finer range cannot be separated from a gain in one sweep. It equals a gain of
// c / Ir at the end Ir of that range, and a shift of the voltage near open circuit.
Effect RangeSwitch() {
  Effect e;
  e.id = "range_switch";
  e.title = "jump at a change of range";
  e.where = Where::kInstrument;
  e.equation = "I -> I (1 + g) where I < Ir";
  e.reference = "instrument manual (gain errors of the ranges); no published model";
  e.sentence = "the instrument changed its range, and its two ranges do not agree";
  e.needs = "one sweep past the knee; a sweep up and down tells it from a step of the light";
  e.acts = "at all currents below one current, in sweeps up and down alike";
  e.confused_with = {"irr_step", "shading", "transient"};
  e.separate_by = "repeat the sweep in one fixed range, or read a resistor in both ranges";
  e.action = "repeat the sweep in one fixed range";
  e.prior = {0.005, 0.005, kTracerPrior};
  e.in_words = [](const FittedEffect& of) -> Phrases {
    return {fmt::format("below {} the currents are {} than above", AmpereText(of.Of("Ir").value),
                        SignedSize(Scaled(of.Of("g"), 100), "%", "larger", "smaller"))};
  };
  e.parameters = {
      Parameter("g", "relative_gain", "of the range of small currents over the other")
          .Between(-0.2, 0.2)
          .AboveLower()
          .BelowUpper()
          .Usual(0.01),
      Parameter("Ir", "range_end", "current at which the range changes")
          .Unit("A")
          .Between(0.02, 0.98)
          .From(0.5)
          .Searched()
          .CurrentPower(1),
  };
  e.instrument = [](const auto* p, const auto&, auto* solved) {
    const auto changed = solved->current * (1.0 + p[0]);
    solved->current = Choose(ValueOf(solved->current) < ValueOf(p[1]), changed, solved->current);
  };
  e.why_not = NeedsOneLitCondition;
  e.probes = [](const DataTraits& traits) {
    std::vector<Probe> probes;
    for (const double current : traits.range_currents) probes.push_back({0.01, current});
    return probes;
  };
  return e;
}

}  // namespace lyrefit
