#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect AgedContacts() {
  Effect e;
  e.id = "aged_contacts";
  e.title = "aged contacts behind a part of the cells";
  e.finding = "distributed_rs";
  e.where = Where::kDevice;
  e.equation = "two parts of every cell, I = (1 - s) F(Va) + s F(Vb), Vb = Va + Rc F(Vb)";
  e.reference = "araujo1986 (distributed series resistance, here in parts of unlike area)";
  e.sentence =
      "fingers or ribbons have corroded: a part of every cell passes its current through a "
      "resistance that the rest does not have";
  e.needs = "little noise before the knee";
  e.acts = "from half of the open-circuit voltage on: the part gives less and less";
  e.confused_with = {"distributed_rs", "weak_cell",  "leaky_cell", "graded_shunt",
                     "substrings",     "rs_current", "scatter",    "mismatch"};
  e.separate_by =
      "the Suns-Voc curve of the same module, without its resistances, or a dark curve, or a "
      "second irradiance: the loss falls with the light";
  e.action =
      "look for dark fingers and ribbons in an electroluminescence image, and at the ribbons for "
      "corrosion; nothing repairs it, and it grows";
  e.prior = {0.001,
             0.01,
             kFaultPrior,
             {{OfThinFilm, 0.3, "thin films have no fingers that corrode: T13-01, section 5"},
              {AsNew, 0.1, kInfantPrior},
              {OfOldAge, 3, kWornPrior}}};
  e.parameters = {Parameter("Rc", "contact_resistance",
                            "of the aged part beside Rs, as if the whole device were behind it")
                      .Unit("ohm")
                      .Between(0, 2)
                      .Usual(0.3)
                      .CurrentPower(-1)
                      .CellsPower(1),
                  Parameter("s", "aged_share", "part of the area of every cell behind it")
                      .Between(0.01, 0.9)
                      .From(0.3)};
  e.cell = [](const auto* p, auto* cell) {
    cell->two_parts = true;
    cell->far_share = p[1];
    cell->far_resistance = p[0];
  };
  e.parts = true;
  e.resistance = true;
  e.why_not = [](const DataTraits& traits) -> WhyNot {
    if (auto why = NeedsLight(traits)) return why;
    if (!traits.module) return "needs cells in series";
    return {};
  };
  e.probes = [](const DataTraits&) {
    return std::vector<Probe>{{0.1, 0.2}, {0.2, 0.4}, {0.5, 0.2}, {0.5, 0.5}, {1.0, 0.1}};
  };
  e.starts = [](const CurveShape&, const DataTraits&,
                const std::vector<ParameterBounds>&) -> std::vector<ShapeStart> {
    return {{{0.15, 0.4}, {}}, {{0.4, 0.4}, {}}, {{0.4, 0.7}, {}}, {{1.0, 0.3}, {}}};
  };
  return e;
}

}  // namespace lyrefit
