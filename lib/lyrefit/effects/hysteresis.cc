#include <fmt/format.h>

#include <cmath>

#include "lyrefit/curve/key_points.h"
#include "lyrefit/effects/parts.h"

namespace lyrefit {
namespace {

enum { kLight, kSaturation, kIdeality, kResistance, kConductance, kPivot, kHysteresisParameters };

// Each direction has five parameters of its own. The saturation current is changed at the pivot
// voltage, so that its change hardly depends on that of the ideality.
template <class S>
void SetDirection(const S* p, Cell<S>* cell) {
  const auto change = [&](int k) { return p[k] * cell->sweep; };
  cell->photocurrent = cell->photocurrent * (1.0 + change(kLight));
  for (int d = 0; d < cell->diodes; ++d) {
    Diode<S>& diode = cell->diode[d];
    const S slope = diode.inverse_n_vt * change(kIdeality);
    diode.saturation = diode.saturation * exp(change(kSaturation) - slope * p[kPivot]);
    diode.inverse_n_vt = diode.inverse_n_vt + slope;
  }
  cell->resistance = cell->resistance * exp(change(kResistance));
  cell->conductance = cell->conductance + change(kConductance);
}

Probe Equal(const DataTraits& traits) {
  Probe equal(kHysteresisParameters, 0.0);
  equal[kPivot] = traits.open_circuit > 0 ? traits.open_circuit : traits.highest_voltage;
  return equal;
}

std::vector<EffectParameter> HysteresisChanges() {
  return {
      Parameter("a", "photocurrent_change", "of the photocurrent, relative, up; the opposite down")
          .Between(-0.4, 0.4)
          .Usual(0.02),
      Parameter("b", "saturation_change", "of ln of the diode's current at Voc, likewise")
          .Between(-4, 4)
          .Usual(0.2),
      Parameter("c", "ideality_change", "of 1 / n, relative, likewise")
          .Between(-0.8, 0.8)
          .Usual(0.1),
      Parameter("r", "resistance_change", "of ln Rs, likewise").Between(-3, 3).Usual(0.2),
      Parameter("g", "conductance_change", "of the conductance of a cell, likewise")
          .Unit("S")
          .Between(-0.5, 0.5)
          .Usual(0.02)
          .CurrentPower(1),
      Parameter("Voc", "pivot_voltage", "of a cell, to which b refers")
          .Unit("V")
          .Between(0.01, 3)
          .From(0.6)
          .FixedByDefault(),
  };
}

// Key points of the readings of one direction: 1 up, -1 down.
KeyPoints InDirection(const Readings& readings, double sign) {
  std::vector<double> voltage, current;
  for (const Reading& reading : readings.points) {
    if (reading.dark || !(sign * reading.rate > 0)) continue;
    voltage.push_back(reading.voltage);
    current.push_back(reading.current);
  }
  return FindKeyPoints(voltage, current);
}

Phrases HysteresisInWords(const FittedEffect& of) {
  const double index = HysteresisIndex(InDirection(of.readings, 1), InDirection(of.readings, -1));
  if (!std::isfinite(index)) return {};
  return {fmt::format(
      "index (Pmp_rev - Pmp_fwd) / Pmp_rev = {:.1f} %: {}", 100 * index,
      index < 0 ? "inverted, the sweep up gives more" : "normal, the sweep down gives more")};
}

}  // namespace

Effect Hysteresis() {
  Effect e;
  e.id = "hysteresis";
  e.title = "hysteresis by ions or traps";
  e.where = Where::kDevice;
  e.equation =
      "Iph (1 + a s), Is exp(b s) at Voc, (1 / n) (1 + c s), Rs exp(r s), Gsh + g s; "
      "s = 1 up, -1 down";
  e.reference = "unger2014; calado2016";
  e.sentence =
      "the state of the device depends on the direction of the sweep, as with mobile ions "
      "or slow traps";
  e.needs = "a sweep up and a sweep down";
  e.acts = "between the sweeps up and down, most at the knee";
  e.confused_with = {"timing_skew", "capacitance", "drift", "temp_drift"};
  e.separate_by =
      "two sweep rates: charge and timing grow with the rate, ions have a rate at which "
      "they are largest";
  e.action = "measure the stabilised power, and both directions at a tenth of the rate";
  e.prior = {0.1, 0.02, "28 of 44 real pairs of sweeps of thin films"};
  e.in_words = HysteresisInWords;
  e.parameters = HysteresisChanges();
  e.cell = [](const auto* p, auto* cell) { SetDirection(p, cell); };
  e.by_sweep = true;
  e.why_not = NeedsUpDown;
  // A device whose directions differ much has no base fit to start from.
  e.starts = [](const CurveShape&, const DataTraits& traits, const auto&) {
    return std::vector<ShapeStart>{{Equal(traits), {}}};
  };
  e.probes = [](const DataTraits& traits) {
    std::vector<Probe> probes;
    constexpr double kSizes[] = {0.002, 0.02, 0.01, 0.05, 0.005};
    for (int k = 0; k < kPivot; ++k) {
      probes.push_back(Equal(traits));
      probes.back()[k] = kSizes[k];
    }
    return probes;
  };
  return e;
}

}  // namespace lyrefit
