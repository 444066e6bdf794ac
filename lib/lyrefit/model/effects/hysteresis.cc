#include "lyrefit/model/effects/catalogue_entries.h"
#include "lyrefit/model/effects/needs.h"

namespace lyrefit {
namespace {

// `value` in sweeps with rising voltage, its negative in those with falling voltage.
template <class S, class Reading>
S BySweep(const S& value, const Reading& reading) {
  return Choose(0.0 * ValueOf(value) < reading.rate, value, -value);
}

}  // namespace

Effect Hysteresis() {
  Effect e;
  e.id = "hysteresis";
  e.title = "hysteresis by ions or traps";
  e.where = Where::kDevice;
  e.equation = "Iph -> Iph (1 + a s), V -> V - (b + c V) s; s = 1 up, -1 down";
  e.reference = "Unger et al. 2014, doi:10.1039/C4EE02465F; Calado et al. 2016, "
                "doi:10.1038/ncomms13831";
  e.sentence = "the state of the device depends on the direction of the sweep, as with mobile ions "
               "or slow traps";
  e.needs = "a sweep up and a sweep down";
  e.acts = "between the sweeps up and down, most at the knee";
  e.confused_with = {"timing_skew", "capacitance", "drift", "temp_drift"};
  e.separate_by = "two sweep rates: charge and timing grow with the rate, ions have a rate at which "
                  "they are largest";
  e.action = "measure the stabilised power, and both directions at a tenth of the rate";
  e.parameters = {
      Parameter("a", "collection_change", "half the difference of the photocurrents")
          .Between(-0.3, 0.3)
          .Usual(0.01),
      Parameter("b", "voltage_shift", "half the difference of the voltages of a cell, at 0 V")
          .Unit("V")
          .Between(-0.2, 0.2)
          .Usual(0.005),
      Parameter("c", "voltage_change", "growth of that difference with the voltage")
          .Between(-0.3, 0.3)
          .Usual(0.01),
  };
  e.conditions = [](const auto* p, const auto& reading, auto* conditions) {
    const auto shift = p[1] + p[2] * conditions->voltage;
    conditions->irradiance = conditions->irradiance * (1.0 + BySweep(p[0], reading));
    conditions->voltage = conditions->voltage - BySweep(shift, reading);
  };
  e.why_not = NeedsUpDown;
  e.probes = [](const DataTraits&) {
    return std::vector<Probe>{{0.002, 0, 0}, {0, 0.001, 0}, {0, 0, 0.002}};
  };
  return e;
}

}  // namespace lyrefit
