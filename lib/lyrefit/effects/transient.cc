#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/effects/parts.h"

namespace lyrefit {
namespace {

constexpr double kNothing = 1e-9;  // added to z^2: keeps its logarithm finite

}  // namespace

Effect Transient() {
  Effect e;
  e.id = "transient";
  e.title = "passing dip or peak of the irradiance";
  e.where = Where::kSweep;
  e.equation = "Iph -> Iph (1 - a exp(-|z|^q / 2)), z = (x - c) / (w (1 + k sign(x - c)))";
  e.reference = "iec60904_1 (irradiance stable during the sweep)";
  e.sentence = "for a short while during the sweep the light was weaker (or stronger)";
  e.needs = "one sweep with many points; a reference cell confirms it";
  e.acts = "around one moment, in the order of time";
  e.confused_with = {"shading", "back_contact", "rs_current", "nonohmic_shunt"};
  e.separate_by = "repeat the sweep; a reference cell beside the module";
  e.action = "repeat the sweep under steady light with a reference cell beside the module";
  e.prior = {0.002,
             0.005,
             kLampPrior,
             {{InFlasher, 0, kPulsePrior}, {ModuleInLaboratory, 0.4, kLaboratoryLampPrior}}};
  e.in_words = [](const FittedEffect& of) -> Phrases {
    const Sized depth = of.Of("a");  // a loss
    return {fmt::format(
        "near {:.4g} V the light {}", VoltageAtMoment(of),
        LightChange({-depth.value, -depth.high_95, -depth.low_95}, of.Most(0), " for a moment"))};
  };
  e.parameters = {
      Parameter("a", "relative_depth", "how much light was missing")
          .Between(-0.8, 0.8)
          .Usual(0.05)
          .AboveLower()
          .BelowUpper(),
      Parameter("c", "centre", "when, -1/2 .. 1/2 over the measurement")
          .Between(-0.45, 0.45)
          .AboveLower()
          .BelowUpper(),
      Parameter("w", "width", "how long, part of the measurement")
          .Between(0.01, 0.13)
          .From(0.05)
          .BelowUpper(),
      // The shape of a cloud is arbitrary: skew and flatness are fitted only after a dip is found.
      Parameter("k", "skew", "how much slower it goes than it comes")
          .Between(-0.7, 0.7)
          .FixedByDefault(),
      Parameter("q", "flatness", "2: a bell, more: flat with steep sides")
          .Between(1, 6)
          .From(2)
          .FixedByDefault(),
  };
  e.conditions = [](const auto* p, const auto& reading, auto* conditions) {
    const auto from = reading.x - p[1];
    const auto side = Choose(ValueOf(p[1]) < reading.x, 1.0 + p[3], 1.0 - p[3]);
    const auto z = from / (p[2] * side);
    const auto power = exp(0.5 * p[4] * log(z * z + kNothing));
    conditions->irradiance = conditions->irradiance * (1.0 - p[0] * exp(-0.5 * power));
  };
  e.momentary = true;
  // A dip passes: it begins and ends within the measurement. One at an end is a bend of the device or
  // a start that settles, and one at the turn of a sweep up and down is the difference of the
  // directions.
  e.imitates = [](const double* p, const DataTraits& traits) {
    constexpr double kOver = 1.5;  // widths from the centre to where a third of the dip is left
    return std::fabs(p[1]) + kOver * p[2] > 0.5 ||
           std::any_of(traits.turns.begin(), traits.turns.end(),
                       [p](double turn) { return std::fabs(p[1] - turn) < 2 * p[2]; });
  };
  e.why_not = NeedsOneLitCondition;
  e.probes = [](const DataTraits& traits) {
    std::vector<Probe> probes;
    for (const double width : {0.0125, 0.025, 0.05, 0.1}) {
      if (width * traits.readings < 1) continue;  // a dip of one reading is an outlier
      for (double centre = -0.45; centre <= 0.45; centre += width) {
        probes.push_back({0.01, centre, width, 0, 2});
      }
    }
    return probes;
  };
  return e;
}

}  // namespace lyrefit
