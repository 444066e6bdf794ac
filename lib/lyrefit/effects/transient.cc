#include "lyrefit/effects/catalogue_entries.h"
#include "lyrefit/effects/needs.h"

namespace lyrefit {

Effect Transient() {
  Effect e;
  e.id = "transient";
  e.title = "passing dip of the irradiance";
  e.where = Where::kSweep;
  e.equation = "Iph -> Iph (1 - a exp(-(x - c)^2 / 2 w^2))";
  e.reference = "IEC 60904-1:2020 (irradiance stable during the sweep)";
  e.sentence = "for a short while during the sweep the light was weaker (or stronger)";
  e.needs = "one sweep with many points; a reference cell confirms it";
  e.acts = "around one moment, in the order of time";
  e.confused_with = {"shading", "back_contact", "rs_current", "nonohmic_shunt"};
  e.separate_by = "repeat the sweep; a reference cell beside the module";
  e.parameters = {{"a", "relative_depth", "", "how much light was missing", -0.8, 0.8, 0},
                  {"c", "centre", "", "when, -1/2 .. 1/2 over the measurement", -0.45, 0.45, 0},
                  {"w", "width", "", "how long, part of the measurement", 0.01, 0.13, 0.05}};
  e.parameters[1].above_lower = e.parameters[1].below_upper = true;
  e.parameters[2].below_upper = true;
  e.sky = [](const auto* p, const auto& reading, auto* sky) {
    const auto z = (reading.x - p[1]) / p[2];
    sky->irradiance = sky->irradiance * (1.0 - p[0] * exp(-0.5 * z * z));
  };
  e.momentary = true;
  e.why_not = NeedsOneLitCondition;
  e.probes = [](const DataTraits& traits) {
    std::vector<Probe> probes;
    for (const double width : {0.0125, 0.025, 0.05, 0.1}) {
      if (width * traits.readings < 1) continue;  // a dip of one reading is an outlier
      for (double centre = -0.45; centre <= 0.45; centre += width) {
        probes.push_back({0.01, centre, width});
      }
    }
    return probes;
  };
  return e;
}

}  // namespace lyrefit
