#pragma once

#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "lyrefit/base/dual.h"
#include "lyrefit/law/reading.h"

namespace lyrefit {

// The terminal law, reading by reading (voltages per cell, currents in parts of the scale; I is
// delivered, Vj the junction voltage of a cell):
//
//   sky         what really held when the reading was taken: irradiance, temperature, voltage
//   cell        the five parameters there
//   junction    I = Iph - Is (exp(Vj / n Vt) - 1) - Gsh Vj + what effects add over Vj
//   series      Vj = V + I Rs + what effects drop at I
//   instrument  the current as it was recorded
//
// An effect is a named cause that changes one or several of these stages. It owns a stretch of the
// parameter vector, `p` points to its beginning. Every hook is written once, as a lambda over its
// number type: plain numbers for the solver, duals for the derivatives.
using Slope1 = Dual<1>;  // derivative by the junction voltage
using Narrow = Dual<8>;  // models with up to 8 parameters
using Wide = Dual<20>;   // up to 20

template <class S>
struct Sky {
  S voltage;        // at the terminals, per cell
  S irradiance;     // suns
  S temperature_K;  // of the cell
  S bandgap_eV;
  S isc_tempco_per_K;
};

template <class S>
struct Cell {
  S irradiance;
  S photocurrent;
  S saturation;         // of the first diode
  S inverse_n_vt;       // 1 / (n Vt)
  bool second = false;  // there is a second diode, with n = 2
  S saturation_2;
  S inverse_2_vt;
  S saturation_2_unit;  // saturation current of a second diode that carries 1 at the pivot voltage
  S conductance;
  S resistance;
  S thermal_voltage;
  double reach = 1;            // largest |voltage| of the readings: where shunts are quoted
  double substring_cells = 1;  // cells that share a bypass diode
  // Part of the cells under a part of the light, with bypass diodes or without.
  bool grouped = false;
  S share;
  S light;
  bool bypassed = false;
  S bypass;  // voltage over a bypass diode that carries the current scale
  // Every cell in two halves, the second reached through a lateral resistance.
  bool halved = false;
  S lateral;
};

// A reading solved for: what instruments make of it.
template <class S>
struct Solved {
  S current;            // to be changed into the recorded one
  S diode_conductance;  // of the junction, d(diode current)/dVj
  S conductance;        // of the junction, all terms
  S resistance;
};

// The number type in which a stage is differentiated along its voltage or current: plain parameters
// carry that one slope, duals have it in the chain already.
template <class S>
struct TangentOf {
  using Type = S;
};
template <>
struct TangentOf<double> {
  using Type = Slope1;
};
template <class S>
using Tangent = typename TangentOf<S>::Type;

template <class S>
using SkyStage = void (*)(const S* p, const Reading& reading, Sky<S>* sky);
template <class S>
using CellStage = void (*)(const S* p, Cell<S>* cell);
template <class S>  // current that is added over the junction voltage
using JunctionStage = Tangent<S> (*)(const S* p, const Cell<S>& cell, const Tangent<S>& voltage);
template <class S>  // voltage that is added to V + I Rs at the delivered current
using SeriesStage = Tangent<S> (*)(const S* p, const Cell<S>& cell, const Tangent<S>& current);
template <class S>
using InstrumentStage = void (*)(const S* p, const Reading& reading, Solved<S>* solved);

template <template <class> class Stage>
struct Hook {
  Stage<double> value = nullptr;
  Stage<Narrow> narrow = nullptr;
  Stage<Wide> wide = nullptr;

  Hook() = default;
  template <class F>
  Hook(F f) : value(f), narrow(f), wide(f) {}  // NOLINT: a lambda is a hook

  explicit operator bool() const { return value != nullptr; }
  template <class S>
  Stage<S> For() const {
    if constexpr (std::is_same_v<S, double>) {
      return value;
    } else if constexpr (std::is_same_v<S, Narrow>) {
      return narrow;
    } else {
      return wide;
    }
  }
};

// A parameter of an effect, in the units of Reading. What a person reads is the value times
// factor x current_A^current x cells^cells x rate^rate of the measurement's scale, or `convert` of
// it, in `unit`.
struct EffectParameter {
  const char* symbol;  // "k"
  const char* name;    // "shunt_strength"
  const char* unit;    // of the reported value, "A/V^m"
  const char* doc;
  double lower;
  double upper;
  double neutral;  // where the effect is not there (of the strength); where to start (others)
  bool searched = false;  // settled by trying the probes' values, not by descent: a step's time
  double factor = 1;
  int current = 0;
  int cells = 0;
  int rate = 0;
  // What the value is multiplied by besides, given all of the effect's parameters.
  double (*convert)(const double* p, const ReadingScale& scale) = nullptr;
  // A fit that ends at such a bound is not this effect but bends to another.
  bool below_upper = false;
  bool above_lower = false;
  // Where a parameter that can be absent is: there it is not reported.
  double absent_at = std::numeric_limits<double>::quiet_NaN();

  double ReportedFactor(const double* p, const ReadingScale& scale) const;
};

// A place from which an effect is tried: a full set of its parameters at a strength that shows.
using Probe = std::vector<double>;

struct Effect {
  const char* id;     // "nonohmic_shunt"
  const char* title;  // "non-ohmic shunt"
  const char* where;  // "device", "sweep", "instrument", "conditions"
  const char* equation;
  const char* reference;
  const char* sentence;                     // what a technician understands
  const char* needs;                        // data that show it
  const char* acts;                         // where on the curve it shows
  std::vector<const char*> confused_with;   // ids, most alike first
  const char* separate_by;                  // the measurement that would tell it from them
  std::vector<EffectParameter> parameters;  // the first is the strength, unless said
  Hook<SkyStage> sky;
  Hook<CellStage> cell;
  Hook<JunctionStage> junction;
  Hook<SeriesStage> series;
  Hook<InstrumentStage> instrument;
  // Why data of this kind cannot show the effect; nothing where they can.
  std::optional<std::string> (*why_not)(const DataTraits&) = nullptr;
  std::vector<Probe> (*probes)(const DataTraits&) = nullptr;

  // Splits the cells of a string into two groups: only one effect of a law can.
  bool groups = false;

  int size() const { return static_cast<int>(parameters.size()); }
};

// Whether two different effects cannot stand in one law.
inline bool Exclude(const Effect& a, const Effect& b) { return a.groups && b.groups; }

}  // namespace lyrefit
