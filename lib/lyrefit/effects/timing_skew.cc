#include <fmt/format.h>

#include <cmath>

#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect TimingSkew() {
  Effect e;
  e.id = "timing_skew";
  e.title = "voltage and current not read together";
  e.finding = "hysteresis";
  e.where = Where::kInstrument;
  e.equation = "V -> V - ts dV/dt";
  e.reference = "iec60904_1 (simultaneous readings)";
  e.sentence = "current and voltage were read one after the other, so that up and down disagree";
  e.needs = "a sweep up and a sweep down with times";
  e.acts = "between the sweeps up and down, where the curve is steep";
  e.confused_with = {"capacitance", "temp_drift"};
  e.separate_by = "two sweep speeds and two irradiances; a resistor in the place of the device";
  e.action = "repeat the sweep five times slower";
  e.prior = {0.02, 0.02, kTracerPrior};
  e.in_words = [](const FittedEffect& of) -> Phrases {
    const ReadingScale& scale = of.readings.scale;
    const Sized skew = of.Of("ts");
    if (scale.times) {
      return {"the voltage was read " + SignedSize(Scaled(skew, 1e3), "ms", "after", "before") +
              " the current"};
    }
    // Without times the shift is known in readings and in volts only.
    return {fmt::format(
        "the voltage was read {} the current, {} mV along the sweep; the file has no times",
        SignedSize(skew, "readings", "after", "before"),
        PlainDigits(1e3 * std::fabs(of.p[0]) * scale.cells))};
  };
  e.parameters = {Parameter("ts", "skew", "from the reading of the current to that of the voltage")
                      .Unit("s")
                      .Between(-0.05, 0.05)
                      .Usual(0.003)
                      .RatePower(-1)};
  e.conditions = [](const auto* p, const auto& reading, auto* conditions) {
    conditions->voltage = conditions->voltage - p[0] * reading.rate;
  };
  e.why_not = NeedsUpDown;
  e.probes = [](const DataTraits&) { return Strengths({0.0005}); };
  return e;
}

}  // namespace lyrefit
