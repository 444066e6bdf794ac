#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect CloudEdge() {
  Effect e;
  e.id = "cloud_edge";
  e.title = "irradiance that changed within a part of the sweep";
  e.finding = "irr_step";
  e.where = Where::kSweep;
  e.equation = "Iph -> Iph (1 + s / (1 + exp(-(x - c) / w)))";
  e.reference = "iec60904_1 (irradiance stable during the sweep)";
  e.sentence =
      "the light went over to another level while the curve was taken: the edge of a cloud";
  e.needs = "one sweep with many points; times or a reference cell confirm it";
  e.acts = "from one moment on, in the order of time";
  e.confused_with = {"irr_step", "transient", "shading", "substrings", "drift"};
  e.separate_by =
      "repeat the sweep: a cloud does not come back at the same voltage; a reference cell beside "
      "the module";
  e.action = "repeat the sweep under steady light with a reference cell beside the module";
  e.prior = {0.001, 0.005, kSkyPrior, {{InFlasher, 0, kPulsePrior}}};
  e.in_words = [](const FittedEffect& of) -> Phrases {
    return {fmt::format("near {:.4g} V the light went over to another level: it {}",
                        VoltageAtMoment(of), LightChange(of.Of("s"), of.Most(0), " than before"))};
  };
  e.parameters = {
      Parameter("s", "relative_change", "by how much the light changed")
          .Between(-0.8, 0.8)
          .Usual(0.05)
          .AboveLower()
          .BelowUpper(),
      Parameter("c", "centre", "when, -1/2 .. 1/2 over the measurement")
          .Between(-0.45, 0.45)
          .AboveLower()
          .BelowUpper(),
      Parameter("w", "width",
                "how fast, part of the measurement: 4.4 w from a tenth to nine tenths")
          .Between(0.001, 0.03)
          .From(0.01)
          .BelowUpper(),
  };
  e.conditions = [](const auto* p, const auto& reading, auto* conditions) {
    const auto passed = 1.0 / (1.0 + exp((p[1] - reading.x) / p[2]));
    conditions->irradiance = conditions->irradiance * (1.0 + p[0] * passed);
  };
  e.momentary = true;
  // Both levels must show, and differ by more than light flickers; or it is a bend of the device, and
  // at the turn of a sweep up and down the difference of the directions.
  e.imitates = [](const double* p, const DataTraits& traits) {
    constexpr double kLeast = 0.03;
    constexpr double kOver = 3, kShown = 0.03;  // widths until the change is over; of the sweep
    return std::fabs(p[0]) < kLeast || std::fabs(p[1]) + kOver * p[2] + kShown > 0.5 ||
           std::any_of(traits.turns.begin(), traits.turns.end(),
                       [p](double turn) { return std::fabs(p[1] - turn) < 2 * p[2]; });
  };
  e.why_not = NeedsOneLitCondition;
  e.probes = [](const DataTraits& traits) {
    constexpr double kApart = 0.03;
    std::vector<Probe> probes;
    for (const double width : {0.005, 0.01, 0.02}) {
      if (width * traits.readings < 1) continue;  // no reading lies within it
      for (double centre = -0.42; centre <= 0.42; centre += kApart) {
        probes.push_back({0.01, centre, width});
      }
    }
    return probes;
  };
  // Where the base fit is of no use: at any moment, darker or brighter.
  e.starts = [](const CurveShape&, const DataTraits&, const auto&) {
    std::vector<ShapeStart> starts;
    for (const double centre : {-0.35, -0.2, -0.05, 0.1, 0.25, 0.4}) {
      for (const double change : {-0.3, 0.4}) starts.push_back({{change, centre, 0.015}, {}});
    }
    return starts;
  };
  return e;
}

}  // namespace lyrefit
