#include "lyrefit/effects/parts.h"

namespace lyrefit {

Effect Drift() {
  Effect e;
  e.id = "drift";
  e.title = "drift of the irradiance";
  e.where = Where::kSweep;
  e.equation = "Iph -> Iph (1 + d x (1 + k x + c x^2)), x = -1/2 .. 1/2 over the measurement";
  e.reference = "iec60904_1 (irradiance stable during the sweep)";
  e.sentence = "the light grew or faded steadily while the curve was taken";
  e.needs =
      "a sweep up and down, or points in reverse; on one sweep only an impossible slope shows it";
  e.acts = "everywhere that light counts, in the order of time";
  e.confused_with = {"temp_drift", "irr_step", "collection"};
  e.separate_by = "a sweep up and down, or a reference cell beside the module";
  e.action = "repeat the sweep under steady light with a reference cell beside the module";
  e.prior = {0.01, 0.01, kSkyPrior, {{InFlasher, 0, kPulsePrior}}};
  e.in_words = [](const FittedEffect& of) -> Phrases {
    return {"at the end of the sweep the light " +
            LightChange(of.Of("d"), of.Most(0), " than at its begin")};
  };
  e.parameters = {Parameter("d", "relative_change", "change of the light over the measurement")
                      .Between(-0.5, 0.5)
                      .AboveLower()
                      .BelowUpper()
                      .Usual(0.03),
                  Parameter("k", "curvature", "how much faster the light changes late than early")
                      .Between(-4, 4)
                      .Usual(0.5)
                      .FixedByDefault()
                      .AbsentAt(0),
                  Parameter("c", "slowing", "below 0: fastest in the middle of the measurement")
                      .Between(-4, 8)
                      .Usual(2)
                      .FixedByDefault()
                      .AbsentAt(0)};
  e.conditions = [](const auto* p, const auto& reading, auto* conditions) {
    const auto& x = reading.x;
    conditions->irradiance =
        conditions->irradiance * (1.0 + p[0] * x * (1.0 + x * (p[1] + p[2] * x)));
  };
  e.why_not = NeedsOneLitCondition;
  e.probes = [](const DataTraits&) { return std::vector<Probe>{{0.01, 0, 0}}; };
  // Light seldom changes steadily. One direction does not show it: the curve has a shape of its own.
  e.starts = [](const CurveShape&, const DataTraits& traits, const auto&) {
    const std::vector<int> freed = traits.turns.empty() ? std::vector<int>{} : std::vector{1, 2};
    std::vector<ShapeStart> starts;
    for (const double change : {-0.02, 0.02}) starts.push_back({{change, 0, 0}, freed});
    return starts;
  };
  return e;
}

}  // namespace lyrefit
