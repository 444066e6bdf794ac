#include "lyrefit/model/effects/catalogue_entries.h"
#include "lyrefit/model/effects/needs.h"

namespace lyrefit {

Effect BackContact() {
  Effect e;
  e.id = "back_contact";
  e.title = "blocking back contact (rollover)";
  e.where = Where::kDevice;
  e.equation = "V = Vj - I Rs - Vt ln(1 + I / Ib)";
  e.reference = "Demtsu and Sites 2006, Thin Solid Films 510, 320";
  e.sentence = "a barrier at the back contact blocks: the curve bends over beyond open circuit";
  e.needs = "points beyond open circuit";
  e.acts = "at open circuit and beyond";
  e.confused_with = {"rs_current", "transient"};
  e.separate_by = "points further beyond open circuit, or another irradiance";
  e.action = "sweep further beyond open circuit: it belongs to the cells, and nothing repairs it";
  e.parameters = {Parameter("1/Ib", "barrier", "inverse saturation current of the barrier")
                      .Unit("1/A")
                      .Between(0, 60)
                      .Usual(5)
                      .CurrentPower(-1)};
  e.series = [](const auto* p, const auto& cell, const auto& current) {
    constexpr double kSmallest = 1e-2;  // below it the tangent replaces the logarithm
    const auto inside = 1.0 + current * p[0];
    const auto within = Larger(inside, kSmallest);
    return cell.thermal_voltage * (log(within) + (inside - within) * (1 / kSmallest));
  };
  e.why_not = [](const DataTraits& traits) -> WhyNot {
    if (traits.beyond_voc) return {};
    return "needs points beyond open circuit";
  };
  e.probes = [](const DataTraits&) { return Strengths({0.5, 3, 12, 40}); };
  return e;
}

}  // namespace lyrefit
