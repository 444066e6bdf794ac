#include <type_traits>

#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect Capacitance() {
  Effect e;
  e.id = "capacitance";
  e.title = "capacitive hysteresis";
  e.finding = "hysteresis";
  e.where = Where::kInstrument;
  e.equation = "I = ... - (C0 + tau gd(Vj)) exp(-b I / Isc) dVj/dt, b = 0 for silicon";
  e.reference = "friesen1997";
  e.sentence =
      "the sweep was too fast: charging the cells adds to the current upwards and takes from it "
      "downwards";
  e.needs = "a sweep up and a sweep down with times";
  e.acts = "between the sweeps up and down, near open circuit if the diffusion part rules";
  e.confused_with = {"timing_skew", "irr_step"};
  e.separate_by =
      "two sweep speeds: this current is in proportion to the speed; a turn at another voltage";
  e.action = "repeat the sweep five times slower";
  e.prior = {0.03,
             0.03,
             kTracerPrior,
             {{SlowOutdoors, 0,
               "a sweep of half a second or more is slower than cells charge (friesen1997)"},
              {Heterojunction, 3, "the charge of a junction grows with exp(Voc): friesen1997"}}};
  e.parameters = {
      Parameter("C0", "capacitance", "of the whole device")
          .Unit("F")
          .Between(0, 0.3)
          .Usual(0.02)
          .CurrentPower(1)
          .CellsPower(-1)
          .RatePower(-1),
      Parameter("tau", "lifetime", "diffusion capacitance over the conductance of the diode")
          .Unit("s")
          .Between(0, 0.3)
          .Usual(0.02)
          .RatePower(-1),
      Parameter("b", "fall",
                "e-folds by which both fall from open circuit to short circuit, as in perovskites")
          .Between(0, 10)
          .FixedByDefault()
          .AbsentAt(0),
  };
  e.instrument = [](const auto* p, const auto& reading, auto* solved) {
    const auto divider = 1.0 + solved->resistance * solved->conductance;
    using T = std::decay_t<decltype(solved->current)>;
    const T delivered = Smaller(Larger(solved->current, T(0.0)), T(2.0));
    const T charge = (p[0] + p[1] * solved->diode_conductance) * exp(-p[2] * delivered);
    solved->current = solved->current - charge * reading.rate / (divider * divider);
  };
  e.starts = [](const CurveShape&, const DataTraits&, const auto&) {
    std::vector<ShapeStart> starts = {{{0.002, 0.002, 0}, {}}};
    for (const double fall : {0.5, 2.0, 5.0}) {
      starts.push_back({{0.002, 0.002, fall}, {2}});
      starts.push_back({{0.02, 0.002, fall}, {2}});
    }
    return starts;
  };
  e.why_not = NeedsUpDown;
  e.probes = [](const DataTraits&) {
    return std::vector<Probe>{{0.002, 0, 0}, {0, 0.002, 0}, {0.001, 0.001, 0}, {0.004, 0.001, 0}};
  };
  return e;
}

}  // namespace lyrefit
