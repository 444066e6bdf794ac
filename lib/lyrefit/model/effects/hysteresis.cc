#include "lyrefit/model/effects/catalogue_entries.h"
#include "lyrefit/model/effects/needs.h"

namespace lyrefit {
namespace {

// Voltages, in parts of Voc, between which the difference of the directions is linear.
constexpr double kKnots[] = {0, 0.4, 0.65, 0.8, 0.9, 1.0, 1.1};
constexpr int kKnotCount = 7;

// A straight line of slope 1 / length through 0 at `from`, cut to 0..1.
Pack Ramp(const Pack& u, double from, double length) {
  const Pack line = (u - from) * (1 / length);
  const Pack low = Choose(line < Pack(0.0), Pack(0.0), line);
  return Choose(low < Pack(1.0), low, Pack(1.0));
}

// Weight of knot `k` at `u`: 1 there, 0 at its neighbours, constant beyond the ends.
Pack Hat(const Pack& u, int k) {
  Pack weight(1.0);
  if (k > 0) weight = Ramp(u, kKnots[k - 1], kKnots[k] - kKnots[k - 1]);
  if (k + 1 < kKnotCount) weight = weight * (1.0 - Ramp(u, kKnots[k], kKnots[k + 1] - kKnots[k]));
  return weight;
}

std::vector<EffectParameter> HysteresisParameters() {
  static const char* const kNames[kKnotCount][2] = {
      {"h0", "difference_at_0"},   {"h40", "difference_at_0_40"}, {"h65", "difference_at_0_65"},
      {"h80", "difference_at_0_80"}, {"h90", "difference_at_0_90"}, {"h100", "difference_at_voc"},
      {"h110", "difference_beyond_voc"}};
  std::vector<EffectParameter> parameters;
  for (const auto& [symbol, name] : kNames) {
    parameters.push_back(Parameter(symbol, name,
                                   "current up minus current down, half of it, at that part of Voc")
                             .Unit("A")
                             .Between(-0.5, 0.5)
                             .Usual(0.01)
                             .CurrentPower(1));
  }
  parameters.push_back(Parameter("Voc", "voltage_unit", "voltage to which the parts refer, per cell")
                           .Unit("V")
                           .Between(0.01, 3)
                           .From(0.6)
                           .FixedByDefault());
  return parameters;
}

}  // namespace

Effect Hysteresis() {
  Effect e;
  e.id = "hysteresis";
  e.title = "hysteresis";
  e.where = Where::kSweep;
  e.equation = "I -> I + s h(V), s = 1 up, -1 down; h linear between 0, 0.4, 0.65, 0.8, 0.9, 1, 1.1 "
               "of Voc";
  e.reference = "Unger et al. 2014, doi:10.1039/C4EE02465F; Calado et al. 2016, "
                "doi:10.1038/ncomms13831";
  e.sentence = "the current depends on the direction of the sweep, as with mobile ions, slow traps, "
               "stored charge or readings that are not simultaneous";
  e.needs = "a sweep up and a sweep down";
  e.acts = "between the sweeps up and down";
  e.confused_with = {"timing_skew", "capacitance", "drift", "temp_drift"};
  e.separate_by = "two sweep rates: charge and timing grow with the rate, ions have a rate at which "
                  "they are largest";
  e.action = "measure the stabilised power, and both directions at a tenth of the rate";
  e.parameters = HysteresisParameters();
  e.instrument = [](const auto* p, const auto& reading, auto* solved) {
    const Pack u = reading.voltage * (1.0 / ValueOf(p[kKnotCount]));
    auto change = p[0] * Hat(u, 0);
    for (int k = 1; k < kKnotCount; ++k) change = change + p[k] * Hat(u, k);
    solved->current =
        solved->current + Choose(Pack(0.0) < reading.rate, change, change * Pack(-1.0));
  };
  e.why_not = NeedsUpDown;
  e.probes = [](const DataTraits& traits) {
    std::vector<Probe> probes;
    for (int k = 0; k < kKnotCount; ++k) {
      Probe probe(kKnotCount + 1, 0.0);
      probe[k] = 0.002;
      probe[kKnotCount] = traits.open_circuit > 0 ? traits.open_circuit : traits.highest_voltage;
      probes.push_back(std::move(probe));
    }
    return probes;
  };
  return e;
}

}  // namespace lyrefit
