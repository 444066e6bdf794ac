#include "lyrefit/effects/parts.h"

namespace lyrefit {
namespace {

enum { kBarrier, kBarrierIdeality, kBarrierLeak };

// U / (nb Vt) at a current, both in units of Ib: the root x of exp(x) - 1 + leak x = current. The
// left side is convex: Newton's steps from above the root stay there. The last has the derivatives.
template <class T, class S>
T BarrierVoltage(const T& current, const S& leak) {
  constexpr int kSteps = 10;
  const Pack slope = ValueOf(leak), target = ValueOf(current);
  Pack x = Choose(target < 0.0, Pack(0.0), log(1.0 + abs(target)));
  for (int k = 0; k < kSteps; ++k) {
    const Pack e = exp(x);
    x = x - (e - 1.0 + slope * x - target) / (e + slope);
  }
  const Pack e = exp(x);
  return x - (e - 1.0 + x * leak - current) * (1.0 / (e + slope));
}

std::vector<EffectParameter> BarrierParameters() {
  return {
      Parameter("1/Ib", "barrier", "inverse saturation current of the barrier")
          .Unit("1/A")
          .Between(0, 1e5)
          .Usual(5)
          .CurrentPower(-1),
      Parameter("nb", "barrier_ideality", "ideality of the barrier's diode")
          .Between(0.5, 20)
          .From(1)
          .FixedByDefault()
          .AbsentAt(1),
      Parameter("Gb", "barrier_leak", "conductance beside the barrier, of a cell")
          .Unit("S")
          .Between(0, 10)
          .Usual(0.2)
          .CurrentPower(1)
          .FixedByDefault()
          .AbsentAt(0),
  };
}

}  // namespace

Effect BackContact() {
  Effect e;
  e.id = "back_contact";
  e.title = "a barrier at a contact";
  e.where = Where::kDevice;
  e.equation = "V = Vj - I Rs - U, I = Ib (exp(U / (nb Vt)) - 1) + Gb U";
  e.reference = "demtsu2006; romero2012";
  e.sentence =
      "a barrier at a contact blocks like a reversed diode: the curve bends over near open circuit";
  e.needs = "points beyond open circuit";
  e.acts = "at open circuit and beyond: rollover, or an S-shape";
  e.confused_with = {"rs_current", "transient"};
  e.separate_by = "points further beyond open circuit, or another irradiance";
  e.action = "sweep further beyond open circuit: it belongs to the cells, and nothing repairs it";
  e.prior = {0.02, 0.01, kCellPrior};
  e.parameters = BarrierParameters();
  e.series = [](const auto* p, const auto& cell, const auto& current) {
    constexpr double kLeast = 3e-3;  // leak of a barrier in Ib / (nb Vt): a finite slope
    const auto unit = cell.thermal_voltage * p[kBarrierIdeality];
    const auto leak = unit * p[kBarrierLeak] * p[kBarrier] + kLeast;
    return BarrierVoltage(current * p[kBarrier], leak) * unit;
  };
  e.why_not = [](const DataTraits& traits) -> WhyNot {
    if (traits.beyond_voc) return {};
    return "needs points beyond open circuit";
  };
  e.probes = [](const DataTraits&) {
    std::vector<Probe> probes;
    for (const double barrier : {0.5, 3.0, 12.0, 40.0}) probes.push_back({barrier, 1, 0});
    return probes;
  };
  // S-shapes: barriers that leak, or that take much of the voltage while current is delivered.
  e.starts = [](const CurveShape&, const DataTraits&, const auto&) {
    std::vector<ShapeStart> starts;
    for (const double barrier : {1.0, 10.0, 100.0}) {
      for (const double ideality : {1.0, 5.0}) {
        for (const double leak : {0.02, 0.3}) {
          starts.push_back({{barrier, ideality, leak}, {kBarrierIdeality, kBarrierLeak}});
        }
      }
    }
    return starts;
  };
  return e;
}

}  // namespace lyrefit
