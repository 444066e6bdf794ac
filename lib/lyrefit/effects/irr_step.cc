#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect IrradianceStep() {
  Effect e;
  e.id = "irr_step";
  e.title = "step of the irradiance";
  e.where = Where::kSweep;
  e.equation = "Iph -> Iph (1 + s) after x0";
  e.reference = "iec60904_1 (irradiance stable during the sweep)";
  e.sentence = "the light jumped while the curve was taken: a cloud edge, a lamp";
  e.needs = "one sweep; times or a reference cell confirm it";
  e.acts = "from one reading on, in the order of time";
  e.confused_with = {"shading", "transient", "capacitance", "drift"};
  e.separate_by =
      "repeat the sweep: a cloud does not come back at the same voltage; a reference cell beside "
      "the module";
  e.action = "repeat the sweep under steady light with a reference cell beside the module";
  e.prior = {0.003,
             0.02,
             kLampPrior,
             {{InFlasher, 0, kPulsePrior}, {ModuleInLaboratory, 0.15, kLaboratoryLampPrior}}};
  e.in_words = [](const FittedEffect& of) -> Phrases {
    for (const Reading& reading : of.readings.points) {
      if (reading.x <= of.p[1]) continue;
      return {fmt::format("from {:.4g} V on the light {}", VoltageAt(of, reading),
                          LightChange(of.Of("s"), of.Most(0), " than before"))};
    }
    return {};
  };
  e.parameters = {
      Parameter("s", "relative_step", "jump of the light")
          .Between(-0.8, 0.8)
          .AboveLower()
          .BelowUpper()
          .Usual(0.05),
      Parameter("x0", "step_time", "when, -1/2 .. 1/2 over the measurement")
          .Between(-0.5, 0.5)
          .Searched(),
  };
  e.conditions = [](const auto* p, const auto& reading, auto* conditions) {
    const auto changed = conditions->irradiance * (1.0 + p[0]);
    conditions->irradiance = Choose(ValueOf(p[1]) < reading.x, changed, conditions->irradiance);
  };
  e.momentary = true;
  e.why_not = NeedsOneLitCondition;
  e.probes = [](const DataTraits& traits) {
    // What shows only in so few readings at an end may as well be wrong readings.
    constexpr double kFewest = 3, kLeastPart = 0.05;
    const double from_end = std::max((kFewest + 0.5) / std::max(traits.readings, 1), kLeastPart);
    std::vector<Probe> probes;
    for (const double x : traits.step_times) {
      if (std::fabs(x) < 0.5 - from_end) probes.push_back({0.01, x});
    }
    return probes;
  };
  return e;
}

}  // namespace lyrefit
