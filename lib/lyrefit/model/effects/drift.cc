#include "lyrefit/model/effects/catalogue_entries.h"
#include "lyrefit/model/effects/needs.h"

namespace lyrefit {

Effect Drift() {
  Effect e;
  e.id = "drift";
  e.title = "drift of the irradiance";
  e.where = Where::kSweep;
  e.equation = "Iph -> Iph (1 + d x), x = -1/2 .. 1/2 over the measurement";
  e.reference = "IEC 60904-1:2020 (irradiance stable during the sweep)";
  e.sentence = "the light grew or faded steadily while the curve was taken";
  e.needs =
      "a sweep up and down, or points in reverse; on one sweep only an impossible slope shows it";
  e.acts = "everywhere that light counts, in the order of time";
  e.confused_with = {"temp_drift", "irr_step", "collection"};
  e.separate_by = "a sweep up and down, or a reference cell beside the module";
  e.action = "repeat the sweep under steady light with a reference cell beside the module";
  e.parameters = {Parameter("d", "relative_change", "change of the light over the measurement")
                      .Between(-0.5, 0.5)
                      .Usual(0.03)};
  e.conditions = [](const auto* p, const auto& reading, auto* conditions) {
    conditions->irradiance = conditions->irradiance * (1.0 + p[0] * reading.x);
  };
  e.why_not = NeedsOneLitCondition;
  e.probes = [](const DataTraits&) { return Strengths({0.01}); };
  return e;
}

}  // namespace lyrefit
