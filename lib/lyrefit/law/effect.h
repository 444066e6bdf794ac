#pragma once

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "lyrefit/base/dual.h"
#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"
#include "lyrefit/law/curve_shape.h"
#include "lyrefit/law/pack.h"
#include "lyrefit/law/parameter.h"
#include "lyrefit/law/plain_stage.h"
#include "lyrefit/law/reading.h"

namespace LYREFIT_PUBLIC lyrefit {

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
// number type: eight readings at a time for the solver, duals of as many for the derivatives. So
// there is no `if` over a value: Choose(condition, yes, no) works out both (dual.h, pack.h).
using Narrow = Dual<6, Pack>;   // models with up to 6 parameters
using Middle = Dual<10, Pack>;  // up to 10
using Wide = Dual<20, Pack>;    // up to 20

// Eight readings at a time.
struct ReadingBlock {
  Pack voltage;     // per cell, V
  Pack current;     // in current scales
  Pack irradiance;  // as the sensor said, in suns
  Pack temperature_K;
  Pack x;               // as in Reading
  Pack rate;            // as in Reading
  int first = 0;        // position of the block's first reading
  int count = 0;        // readings from `first` on; lanes beyond repeat the last of them
  bool one_sky = true;  // irradiance and temperature are the same in all lanes
};

// What really held when a reading was taken: a stage may correct it.
template <class S>
struct Sky {
  S voltage;        // at the terminals, per cell
  S irradiance;     // suns
  S temperature_K;  // of the cell
  S bandgap_eV;
  S isc_tempco_per_K;
};

// One diode of a cell.
template <class S>
struct Diode {
  S saturation;    // current, in scales
  S inverse_n_vt;  // 1 / (n Vt)
};

// What stands in the way of a current that a cell in reverse does not deliver.
enum class ReverseLaw {
  kShunt,   // the shunt alone
  kBishop,  // I = ... - Gsh a Vj (1 - Vj / Vbr)^-m doi:10.1016/0379-6787(88)90059-2
  kSoft,    // I = ... + Iph (-Vj / A)^m, Iph of a cell under full light
};

// Cells in series that are alike. A part of a string is what shares a bypass diode (or has none);
// kinds of one part carry one current. In half-cut modules a part is two such chains side by side,
// each of half the current: its kinds are one, and one kind that stands `beside` them the other.
constexpr int kMostKinds = 8;
template <class S>
struct Kind {
  S share;              // of all cells of the device
  S light;              // part of the photocurrent
  S leak;               // conductance beside that of the others
  int part = 0;         // of the string that it lies in
  bool beside = false;  // the second chain of a half-cut part
};
// What shares a bypass diode, or has none.
struct Part {
  bool bypassed = false;  // it has a diode
  double cells = 1;       // that one bypass diode spans
  int string = 0;         // strings of different number stand in parallel
  bool paired = false;    // one of its kinds stands beside the others
};

// The cells under one sky, in the units of Reading: a stage may change any of it.
template <class S>
struct Cell {
  static constexpr int kMostDiodes = 4;  // side by side
  S irradiance;                          // in suns
  S photocurrent;                        // Iph, in scales
  int diodes = 0;                        // that are there
  Diode<S> diode[kMostDiodes];           // the first `diodes` of them count
  S saturation_2_unit;  // saturation current of a diode with n = 2 that carries 1 at the pivot
  S conductance;        // Gsh, in scales per volt of a cell
  S resistance;         // Rs, in volt of a cell per scale
  S thermal_voltage;    // k T / q, V
  double reach = 1;     // largest |voltage| of the readings: where shunts are quoted
  double cells = 1;     // in series
  double substring_cells = 1;    // cells that share a bypass diode
  int kinds = 1;                 // one: all cells are alike, in one part without bypass diode
  int parts = 1;                 // of the string
  int strings = 1;               // side by side, which differ
  Kind<S>* kind = nullptr;       // kMostKinds of them
  Part part[kMostKinds];         // `parts` of them
  S bypass;                      // voltage over a bypass diode that carries the current scale
  double bypass_ideality = 1.2;  // of that diode
  ReverseLaw reverse = ReverseLaw::kShunt;
  S reverse_strength;  // Bishop's a
  S reverse_voltage;   // Bishop's -Vbr, the soft law's A; above 0
  S reverse_exponent;  // m
  // Every cell in two halves, the second reached through a lateral resistance.
  bool halved = false;
  S lateral;  // in the unit of `resistance`
};

// Readings solved for: what instruments make of them.
template <class S>
struct Solved {
  S current;            // to be changed into the recorded one
  S diode_conductance;  // of the junction, d(diode current)/dVj
  S conductance;        // of the junction, all terms
  S resistance;         // Rs of the cell
};

// The number type in which a stage is differentiated along its voltage or current: plain parameters
// carry that one slope, duals have it in the chain already.
template <class S>
struct TangentOf {
  // The type itself.
  using Type = S;
};
// Of plain parameters: with the slope.
template <>
struct TangentOf<Pack> {
  // The type with a slope.
  using Type = Dual<1, Pack>;
};
// See TangentOf.
template <class S>
using Tangent = typename TangentOf<S>::Type;

// Changes what held when the readings were taken.
template <class S>
using SkyStage = void (*)(const S* p, const ReadingBlock& readings, Sky<S>* sky);
// Changes the cells under that sky.
template <class S>
using CellStage = void (*)(const S* p, Cell<S>* cell);
// Current that is added over the junction voltage, of a cell under the light of its own.
template <class S>
using JunctionStage = Tangent<S> (*)(const S* p, const Cell<S>& cell, const S& photocurrent,
                                     const Tangent<S>& voltage);
template <class S>  // voltage that is added to V + I Rs at the delivered current
using SeriesStage = Tangent<S> (*)(const S* p, const Cell<S>& cell, const Tangent<S>& current);
// Changes the currents that were solved for into those recorded.
template <class S>
using InstrumentStage = void (*)(const S* p, const ReadingBlock& readings, Solved<S>* solved);

// One stage of an effect, for every number type; empty where the effect leaves the stage alone.
template <template <class> class Stage>
struct Hook {
  Stage<Pack> value = nullptr;     // for currents alone
  Stage<Narrow> narrow = nullptr;  // with derivatives
  Stage<Middle> middle = nullptr;  // the same
  Stage<Wide> wide = nullptr;      // the same

  Hook() = default;
  // A lambda over its number type, without captures.
  template <class F>
  Hook(F f) : value(f), narrow(f), middle(f), wide(f) {}  // NOLINT: a lambda is a hook

  // Whether the effect has this stage.
  explicit operator bool() const { return value != nullptr; }
  // The one for this number type.
  template <class S>
  Stage<S> For() const {
    if constexpr (std::is_same_v<S, Pack>) {
      return value;
    } else if constexpr (std::is_same_v<S, Narrow>) {
      return narrow;
    } else if constexpr (std::is_same_v<S, Middle>) {
      return middle;
    } else {
      return wide;
    }
  }
};

// What a parameter that is not any number can only be.
enum class Whole {
  kNo,
  kCount,       // 1, 2, ...
  kSubstrings,  // a share of the cells: of whole substrings, where their number was stated
};

// A parameter of an effect, in the units of Reading. What a person reads is the value times
// factor x current_A^current x cells^cells x rate^rate of the measurement's scale, or `convert` of
// it, in `unit`. The catalogue makes them field by field, by name:
//   Parameter("a", "factor", "conductance of a cell at 0 V").Unit("S").Between(0, 3).From(1)
struct EffectParameter {
  const char* symbol = "";  // "k"
  const char* name = "";    // "shunt_strength"
  const char* unit = "";    // of the reported value, "A/V^m"
  const char* doc = "";     // what it says, one line
  double lower = 0;
  double upper = 0;
  double neutral = 0;  // where the effect is not there (of the strength); where to start (others)
  bool searched = false;  // settled by trying the probes' values, not by descent: a step's time
  double factor = 1;      // see above
  int current = 0;        // power of the current scale
  int cells = 0;          // power of the number of cells
  int rate = 0;           // power of the rate scale
  // What the value is multiplied by besides, given all of the effect's parameters.
  double (*convert)(const double* p, const ReadingScale& scale) = nullptr;
  // A fit keeps it at its neutral value unless it is asked for by name.
  bool held = false;
  // How much it differs from part to part in modules as they are sold, a standard deviation: no
  // curve of a module says it better.
  double scatter = 0;
  // A fit that ends at such a bound is not this effect but bends to another.
  bool below_upper = false;
  bool above_lower = false;
  // Where a parameter that can be absent is: there it is not reported.
  double absent_at = kUnknown;
  Whole whole = Whole::kNo;  // where a fit of it by name searches among these

  // What the value is multiplied by where a person reads it.
  double ReportedFactor(const double* p, const ReadingScale& scale) const;

  // Of the reported value: sets `unit`.
  constexpr EffectParameter& Unit(const char* text) { return unit = text, *this; }
  // Its bounds: sets `lower` and `upper`, in the units of Reading.
  constexpr EffectParameter& Between(double low, double high) {
    return lower = low, upper = high, *this;
  }
  // Sets `neutral`.
  constexpr EffectParameter& From(double value) { return neutral = value, *this; }
  // Sets `searched`.
  constexpr EffectParameter& Searched() { return searched = true, *this; }
  // Sets `factor`, then the powers of the scales in the reported value.
  constexpr EffectParameter& Times(double value) { return factor = value, *this; }
  constexpr EffectParameter& CurrentPower(int power) { return current = power, *this; }
  constexpr EffectParameter& CellsPower(int power) { return cells = power, *this; }
  constexpr EffectParameter& RatePower(int power) { return rate = power, *this; }
  // Sets `convert`.
  constexpr EffectParameter& Convert(double (*f)(const double*, const ReadingScale&)) {
    return convert = f, *this;
  }
  // Sets `held`.
  constexpr EffectParameter& Held() { return held = true, *this; }
  // Sets `scatter`.
  constexpr EffectParameter& Scatter(double deviation) { return scatter = deviation, *this; }
  // A fit at its upper bound, or its lower one, is not this effect.
  constexpr EffectParameter& BelowUpper() { return below_upper = true, *this; }
  constexpr EffectParameter& AboveLower() { return above_lower = true, *this; }
  // Sets `absent_at`.
  constexpr EffectParameter& AbsentAt(double value) { return absent_at = value, *this; }
  // Sets `whole`.
  constexpr EffectParameter& Only(Whole kind) { return whole = kind, *this; }
};

// A parameter of an effect: its symbol in tables and flags, its name in code, what it says.
constexpr EffectParameter Parameter(const char* symbol, const char* name, const char* doc) {
  EffectParameter made;
  made.symbol = symbol;
  made.name = name;
  made.doc = doc;
  return made;
}

// What an effect belongs to.
enum class Where { kDevice, kSweep, kInstrument, kConditions, kNowhere };

template <>
struct EnumTable<Where> {
  static constexpr EnumText<Where> kRows[] = {{Where::kDevice, "device"},
                                              {Where::kSweep, "sweep"},
                                              {Where::kInstrument, "instrument"},
                                              {Where::kConditions, "conditions"},
                                              {Where::kNowhere, "unknown"}};
};

// How a diagnosis comes upon an effect.
enum class FoundBy {
  kFit,            // by its score on the residuals, and a fit
  kWaves,          // by smooth waves in the residuals that nothing else explains
  kSingleReading,  // by single readings far off
  kValues,         // by the values or parameters themselves: nothing is fitted
  kRequest,        // not at all: it is fitted or simulated where somebody asks for it
};

// A place from which an effect is tried: a full set of its parameters at a strength that shows.
using Probe = std::vector<double>;

// The same as the shape of a curve suggests it, for fits that stand on no other fit.
struct ShapeStart {
  Probe p;                 // where to begin
  std::vector<int> freed;  // parameters to descend in although fits usually keep them
};

// A named cause that changes the terminal law: what it is called, what it does, what shows it.
struct Effect {
  const char* id = "";     // "nonohmic_shunt"
  const char* title = "";  // "non-ohmic shunt"
  Where where = Where::kDevice;
  const char* equation = "";                // as reports print it
  const char* reference = "";               // where it is from: DOI or clause
  const char* sentence = "";                // what a technician understands
  const char* needs = "";                   // data that show it
  const char* acts = "";                    // where on the curve it shows
  std::vector<const char*> confused_with;   // ids, most alike first
  const char* separate_by = "";             // the measurement that would tell it from them
  std::vector<EffectParameter> parameters;  // the first is the strength, unless said
  // Sets of them that may change places without changing a curve (groups of cells): reports have
  // the sets in order of the first of each.
  std::vector<std::vector<int>> alike;
  Hook<SkyStage> sky;
  Hook<CellStage> cell;
  Hook<JunctionStage> junction;
  Hook<SeriesStage> series;
  Hook<InstrumentStage> instrument;
  // Beside these two, or in their place, as functions of plain numbers (plain_stage.h).
  PlainStage plain_junction;
  PlainStage plain_series;
  // Why data of this kind cannot show the effect; nothing where they can, none where all can.
  std::optional<std::string> (*why_not)(const DataTraits&) = nullptr;
  // Where fits of it begin, full sets of its parameters each; the data decide how many.
  std::function<std::vector<Probe>(const DataTraits&)> probes;
  // Where one lit condition was measured. `asked`: bounds of the parameters in a fit that was asked
  // for by name; empty in a diagnosis.
  std::vector<ShapeStart> (*starts)(const CurveShape&, const DataTraits&,
                                    const std::vector<ParameterBounds>& asked) = nullptr;
  // What becomes of the effect, which begins in the first of `groups` bypass groups, while group
  // `which` stands covered and the others work alone: its parameters, changed to theirs; false
  // where it is gone. None where all cells have it alike.
  bool (*covered)(double* p, int which, int groups) = nullptr;

  FoundBy found_by = FoundBy::kFit;
  // Splits the cells of a string into kinds: only one effect of a law can.
  bool groups = false;
  bool momentary = false;  // lasts a moment of the sweep: it can bend to any single reading
  int diode = 0;           // it is this diode of a device: a base of so many has it already

  // How many parameters it has.
  int size() const { return static_cast<int>(parameters.size()); }
  // Why such data cannot show it; nothing where they can.
  std::optional<std::string> WhyNot(const DataTraits& traits) const {
    return why_not != nullptr ? why_not(traits) : std::nullopt;
  }
  // False of what is found in the values alone: nothing of the law changes.
  bool ChangesJunction() const { return junction || plain_junction; }
  bool ChangesSeries() const { return series || plain_series; }
  bool HasStage() const {
    return sky || cell || ChangesJunction() || ChangesSeries() || instrument;
  }
};

// Whether two different effects cannot stand in one law.
inline bool Exclude(const Effect& a, const Effect& b) { return a.groups && b.groups; }

}  // namespace lyrefit
