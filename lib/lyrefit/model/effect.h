// Experimental: may change in a minor version (data/stable).
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
#include "lyrefit/model/curve_shape.h"
#include "lyrefit/model/effect_prior.h"
#include "lyrefit/model/pack.h"
#include "lyrefit/model/parameter.h"
#include "lyrefit/model/plain_stage.h"
#include "lyrefit/model/reading.h"

namespace LYREFIT_PUBLIC lyrefit {

// The terminal law, one stage after the other, for each reading. Voltages are per cell in volt,
// currents in current scales. I is the delivered current, Vj the junction voltage of a cell:
//
//   conditions         operating conditions at the reading: irradiance, temperature, voltage
//   cell        the five parameters at these conditions
//   junction    I = Iph - Is (exp(Vj / n Vt) - 1) - Gsh Vj + terms that effects add over Vj
//   series      Vj = V + I Rs + drops that effects add at I
//   instrument  recorded current
//
// A reading of a Suns-Voc trace has the stages `cell` and `junction` alone, without Rs. Every cell
// then has the voltage of its own light: no cell drives another one.
//
// An effect is a named cause that changes one or several of these stages. It has its own range of
// the parameter vector, and `p` points to the first of them. Each hook is a lambda over its number
// type: packs of eight readings for the solver, duals of packs for derivatives. Hooks must not
// branch on values: Choose(condition, yes, no) evaluates both sides (dual.h, pack.h).
using Narrow = Dual<6, Pack>;   // laws with up to 6 parameters
using Middle = Dual<10, Pack>;  // up to 10
using Wide = Dual<20, Pack>;    // up to 20

// Eight readings at a time.
struct ReadingBlock {
  Pack voltage;     // per cell, V
  Pack current;     // in current scales
  Pack irradiance;  // sensor value, in suns
  Pack temperature_K;
  Pack x;         // as in Reading
  Pack rate;      // as in Reading
  int first = 0;  // position of the block's first reading
  int count = 0;  // number of readings from `first` on; unused lanes repeat the last one
  bool same_conditions = true;  // irradiance and temperature are the same in all lanes
  bool suns_voc = false;        // as in Reading, the same in all lanes
};

// Operating conditions of a reading. A conditions stage corrects the sensor values.
template <class S>
struct OperatingConditions {
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

// Current of a cell in reverse, beside photocurrent and diodes.
enum class ReverseLaw {
  kShunt,   // the shunt only
  kBishop,  // I = ... - Gsh a Vj (1 - Vj / Vbr)^-m doi:10.1016/0379-6787(88)90059-2
  kSoft,    // I = ... + Iph (-Vj / A)^m, Iph of an unshaded cell
};

// A cell group: identical cells in series. A substring is a set of cells that share one
// bypass diode or none. The cell groups of one substring carry the same current. In half-cut
// modules a substring is two parallel chains of half the current each: its groups form one chain,
// and the one group with `beside` set forms the other.
constexpr int kMostGroups = 12;
constexpr double kUsualBypassIdeality = 1.2;
template <class S>
struct CellGroup {
  S share;              // fraction of all cells of the device
  S light;              // factor of the photocurrent
  S leak;               // additional shunt conductance, scales per volt of a cell
  int substring = 0;    // position of its substring
  bool beside = false;  // forms the second chain of a half-cut substring
};
// A substring: cells that share a bypass diode, or none.
struct Substring {
  bool bypassed = false;  // has a bypass diode
  double cells = 1;       // number of cells that one bypass diode spans
  int string = 0;         // its string; strings are in parallel
  bool parallel = false;  // half-cut: one of its cell groups is `beside` the others
};

// A cell at its operating conditions, in the units of Reading. A cell stage may change any field.
template <class S>
struct Cell {
  static constexpr int kMostDiodes = 4;  // in parallel
  S irradiance;                          // in suns
  S photocurrent;                        // Iph, in scales
  int diodes = 0;                        // number of diodes
  Diode<S> diode[kMostDiodes];           // first `diodes` valid
  S saturation_2_unit;     // saturation current of a diode with n = 2 that carries 1 at the pivot
  S conductance;           // Gsh, in scales per volt of a cell
  S resistance;            // Rs, in volt of a cell per scale
  S thermal_voltage;       // k T / q, V
  Pack sweep = Pack(0.0);  // 1 where the voltage rises, -1 where it falls, 0 at rest
  double reach = 1;  // largest |voltage| of the readings, V per cell, where shunts are reported
  double cells = 1;  // in series
  double substring_cells = 1;        // cells that share a bypass diode
  int groups = 1;                    // number of cell groups; 1: all cells alike, no bypass diode
  int substrings = 1;                // number of substrings
  int strings = 1;                   // number of different strings in parallel
  CellGroup<S>* group = nullptr;     // kMostGroups entries
  Substring substring[kMostGroups];  // the first `substrings` are valid
  S bypass;                          // voltage of a bypass diode at one current scale, V
  S bypass_ideality;                 // of the bypass diode
  ReverseLaw reverse = ReverseLaw::kShunt;
  S reverse_strength;     // Bishop's a
  S reverse_voltage;      // -Vbr of Bishop's law or A of the soft law, V, above 0
  S reverse_exponent;     // m of either law
  bool suns_voc = false;  // at open circuit: without any drop of voltage in series
  // Every cell has two parts in parallel, both behind `resistance`: the far one has a resistance of
  // its own besides.
  bool two_parts = false;
  S far_share;       // part of the area, between 0 and 1
  S far_resistance;  // as if the whole cell were behind it, in the unit of `resistance`
};

// Solved readings, the input and output of instrument stages.
template <class S>
struct Solved {
  S current;            // in current scales; a stage changes it to the recorded current
  S diode_conductance;  // of the junction, d(diode current)/dVj
  S conductance;        // of the junction, all terms
  S resistance;         // Rs of the cell
};

// Number type in which a stage is differentiated by its voltage or current. With plain parameters
// that type is a dual of one slope. With dual parameters the chain rule gives the slope, so S
// suffices.
template <class S>
struct TangentOf {
  // The number type.
  using Type = S;
};
// Plain parameters: a dual with one slope.
template <>
struct TangentOf<Pack> {
  // The number type.
  using Type = Dual<1, Pack>;
};
// See TangentOf.
// Short name of the number type in TangentOf.
template <class S>
using Tangent = typename TangentOf<S>::Type;

// Corrects the operating conditions of the readings.
template <class S>
using ConditionsStage = void (*)(const S* p, const ReadingBlock& readings,
                                 OperatingConditions<S>* conditions);
// Changes a cell at its operating conditions.
template <class S>
using CellStage = void (*)(const S* p, Cell<S>* cell);
// Current added to a cell at its junction voltage, in current scales. `photocurrent` is that of the
// cell's own group.
template <class S>
using JunctionStage = Tangent<S> (*)(const S* p, const Cell<S>& cell, const S& photocurrent,
                                     const Tangent<S>& voltage);
template <class S>  // voltage added to V + I Rs at the delivered current, V per cell
using SeriesStage = Tangent<S> (*)(const S* p, const Cell<S>& cell, const Tangent<S>& current);
// Changes solved currents to recorded currents.
template <class S>
using InstrumentStage = void (*)(const S* p, const ReadingBlock& readings, Solved<S>* solved);

// One stage of an effect, for every number type. Empty: the effect does not change this stage.
template <template <class> class Stage>
struct Hook {
  Stage<Pack> value = nullptr;     // currents only
  Stage<Narrow> narrow = nullptr;  // up to 6 derivatives
  Stage<Middle> middle = nullptr;  // up to 10
  Stage<Wide> wide = nullptr;      // up to 20

  Hook() = default;
  // A lambda over its number type, without captures.
  template <class F>
  Hook(F f) : value(f), narrow(f), middle(f), wide(f) {}  // NOLINT: a lambda is a hook

  // Whether the effect has this stage.
  explicit operator bool() const { return value != nullptr; }
  // The stage for number type S.
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

// Restriction of a parameter to whole numbers.
enum class Whole {
  kNo,
  kCount,       // 1, 2, ...
  kSubstrings,  // shares of cells in whole substrings, if their number is stated
};

// A parameter of an effect, in the units of Reading. The reported value, in `unit`, is the value
// times factor x current_A^current x cells^cells x rate^rate of the measurement's scale, times
// `convert` if set. Entries of the catalogue are built field by field:
//   Parameter("a", "factor", "conductance of a cell at 0 V").Unit("S").Between(0, 3).From(1)
struct EffectParameter {
  const char* symbol = "";  // "k"
  const char* name = "";    // "shunt_strength"
  const char* unit = "";    // of the reported value, "A/V^m"
  const char* doc = "";     // meaning, one line
  double lower = 0;
  double upper = 0;
  double neutral = 0;     // value without the effect (strength), or start value (others)
  bool searched = false;  // selected among probe values, not fitted: a step's time
  double factor = 1;      // see above
  int current = 0;        // power of the current scale
  int cells = 0;          // power of the number of cells
  int rate = 0;           // power of the rate scale
  // Additional factor of the reported value, as a function of all parameters of the effect.
  double (*convert)(const double* p, const ReadingScale& scale) = nullptr;
  // By default a fit keeps it fixed at its neutral value. A request by name frees it.
  bool fixed_by_default = false;
  // Standard deviation among sound modules or substrings, from production. The curve of one module
  // cannot reduce it. 0: none.
  double scatter = 0;
  // Usual size, as the scale of a prior with heavy tails about `neutral`. 0: all values between the
  // bounds are equally probable.
  double usual = 0;
  // A fit that ends at such a bound is rejected: there the effect imitates another one.
  bool below_upper = false;
  bool above_lower = false;
  // Value that means the parameter is absent: it is then not reported.
  double absent_at = kUnknown;
  Whole whole = Whole::kNo;  // a fit requested by name searches these values

  // Factor from the value to the reported value. `p`: all parameters of the effect.
  double ReportedFactor(const double* p, const ReadingScale& scale) const;

  // Sets `unit`, that of the reported value.
  constexpr EffectParameter& Unit(const char* text) { return unit = text, *this; }
  // Sets `lower` and `upper`, in the units of Reading.
  constexpr EffectParameter& Between(double low, double high) {
    return lower = low, upper = high, *this;
  }
  // Sets `neutral`.
  constexpr EffectParameter& From(double value) { return neutral = value, *this; }
  // Sets `searched`.
  constexpr EffectParameter& Searched() { return searched = true, *this; }
  // Set `factor`, then the powers of the scales in the reported value.
  constexpr EffectParameter& Times(double value) { return factor = value, *this; }
  constexpr EffectParameter& CurrentPower(int power) { return current = power, *this; }
  constexpr EffectParameter& CellsPower(int power) { return cells = power, *this; }
  constexpr EffectParameter& RatePower(int power) { return rate = power, *this; }
  // Sets `convert`.
  constexpr EffectParameter& Convert(double (*f)(const double*, const ReadingScale&)) {
    return convert = f, *this;
  }
  // Sets `fixed_by_default`.
  constexpr EffectParameter& FixedByDefault() { return fixed_by_default = true, *this; }
  // Sets `scatter`.
  constexpr EffectParameter& Scatter(double deviation) { return scatter = deviation, *this; }
  // Sets `usual`.
  constexpr EffectParameter& Usual(double size) { return usual = size, *this; }
  // Set `below_upper` or `above_lower`: a fit at that bound is rejected.
  constexpr EffectParameter& BelowUpper() { return below_upper = true, *this; }
  constexpr EffectParameter& AboveLower() { return above_lower = true, *this; }
  // Sets `absent_at`.
  constexpr EffectParameter& AbsentAt(double value) { return absent_at = value, *this; }
  // Sets `whole`.
  constexpr EffectParameter& Only(Whole kind) { return whole = kind, *this; }
};

// Starts a parameter: symbol in tables and flags, name in code, meaning.
constexpr EffectParameter Parameter(const char* symbol, const char* name, const char* doc) {
  EffectParameter made;
  made.symbol = symbol;
  made.name = name;
  made.doc = doc;
  return made;
}

// Origin of an effect.
enum class Where { kDevice, kSweep, kInstrument, kConditions, kNowhere };

template <>
struct EnumTable<Where> {
  static constexpr EnumText<Where> kRows[] = {{Where::kDevice, "device"},
                                              {Where::kSweep, "sweep"},
                                              {Where::kInstrument, "instrument"},
                                              {Where::kConditions, "conditions"},
                                              {Where::kNowhere, "unknown"}};
};

// How a diagnosis finds an effect.
enum class FoundBy {
  kFit,            // by its score on the residuals, then a fit
  kWaves,          // by smooth waves in the residuals that no other effect explains
  kSingleReading,  // by single outliers
  kValues,         // by values or parameters, without a fit
  kRequest,        // never: it is fitted or simulated only on request
};

// A start of a fit: a full parameter set of an effect, at a strength visible in the data.
using Probe = std::vector<double>;

// A start derived from the shape of a curve. It does not need a previous fit.
struct ShapeStart {
  Probe p;                 // start values
  std::vector<int> freed;  // parameters to fit although they are fixed by default
  double giving = 1;       // part of the cells that gives the open-circuit voltage
};

struct FittedEffect;  // effects/fitted_effect.h

// A named cause that changes the terminal law: its text for reports, parameters, stages and starts.
struct Effect {
  const char* id = "";       // "nonohmic_shunt"
  const char* title = "";    // "non-ohmic shunt"
  const char* finding = "";  // id under which a diagnosis reports it; empty: its own
  Where where = Where::kDevice;
  const char* equation = "";               // as printed in reports
  const char* reference = "";              // source: keys of cite/references.h, or words
  const char* sentence = "";               // for a technician
  const char* needs = "";                  // data that can show it
  const char* acts = "";                   // region of the curve where it shows
  std::vector<const char*> confused_with;  // ids, most similar first
  const char* separate_by = "";            // measurement that separates it from them
  const char* action = "";                 // the next thing to do about it
  const char* fact_sheet = "";             // of IEA-PVPS T13-30:2025, "PVFS 1-19"; may be empty
  EffectPrior prior;                       // how common it is
  // Its size for a technician, the most important first: light of substrings in %, heat of a cell. Null:
  // a diagnosis says its largest change of the current.
  std::vector<std::string> (*in_words)(const FittedEffect& of) = nullptr;
  std::vector<EffectParameter> parameters;  // the first is the strength, by default
  // Sets of parameters that can be exchanged without changing a curve (cell groups). Reports sort
  // the sets by the first parameter of each.
  std::vector<std::vector<int>> alike;
  Hook<ConditionsStage> conditions;
  Hook<CellStage> cell;
  Hook<JunctionStage> junction;
  Hook<SeriesStage> series;
  Hook<InstrumentStage> instrument;
  // Junction and series stages as functions of plain numbers (plain_stage.h), in addition to the
  // hooks.
  PlainStage plain_junction;
  PlainStage plain_series;
  // Reason why data of this type cannot show the effect; empty if they can. Null: any data can.
  std::optional<std::string> (*why_not)(const DataTraits&) = nullptr;
  // Starts of fits, a full parameter set each. Their number depends on the data.
  std::function<std::vector<Probe>(const DataTraits&)> probes;
  // Starts from the shape of a curve, for one lit condition. `asked`: parameter bounds of a fit
  // that was requested by name; empty in a diagnosis.
  std::vector<ShapeStart> (*starts)(const CurveShape&, const DataTraits&,
                                    const std::vector<ParameterBounds>& asked) = nullptr;
  // Whether the effect imitates another cause at these parameters, so that a fit which ends there is
  // rejected. Null: nowhere but at the bounds that its parameters name.
  bool (*imitates)(const double* p, const DataTraits&) = nullptr;
  // Whether one curve hides a part of the effect at these parameters, so that the power to gain is
  // at least what the effect takes. Null: never.
  bool (*hides)(const double* p, const DataTraits&) = nullptr;
  // The largest part of their light that cells miss, where every substring has a light of its own:
  // slight differences are then drawn alike by cells that differ one by one, the effect `slight_is`.
  // NaN where substrings are alike. Null: never so.
  double (*light_missing)(const double* p, const DataTraits&) = nullptr;
  const char* slight_is = "";  // id of that effect
  // Standard deviation of the power to gain, in parts of it, where the curve never shows the cells
  // that would give it. 0: that of other causes.
  double gain_scatter = 0;

  FoundBy found_by = FoundBy::kFit;
  // Divides the cells into cell groups: only one effect of a law may.
  bool groups = false;
  bool parts = false;       // divides each cell into parts: only one effect of a law may
  bool resistance = false;  // a series resistance beside Rs
  bool elaborate = false;   // fitted only where no simpler effect describes the readings
  bool is_wiring = false;   // of the device: of its junction box, connectors or leads
  bool momentary = false;   // short compared with the sweep: it can imitate any outlier
  bool by_sweep = false;    // its cell stage depends on Cell::sweep
  int diode = 0;            // number of the diode it adds; a base with that many diodes includes it

  // Id of what a diagnosis reports.
  std::string Finding() const { return *finding != '\0' ? finding : id; }
  // Number of parameters.
  int size() const { return static_cast<int>(parameters.size()); }
  // Reason why these data cannot show the effect; empty if they can.
  std::optional<std::string> WhyNot(const DataTraits& traits) const {
    return why_not != nullptr ? why_not(traits) : std::nullopt;
  }
  // All three are false for an effect that is found in the values only: it does not change the law.
  bool ChangesJunction() const { return junction || plain_junction; }
  bool ChangesSeries() const { return series || plain_series; }
  bool HasStage() const {
    return conditions || cell || ChangesJunction() || ChangesSeries() || instrument;
  }
};

// What an effect belongs to, in one word for reports: "device", "wiring", "sweep", "instrument", or
// "unknown".
std::string GroupOf(const Effect& effect);

// Whether two different effects are incompatible in one law: both divide the cells into groups, or
// each cell into parts.
inline bool Exclude(const Effect& a, const Effect& b) {
  return (a.groups && b.groups) || (a.parts && b.parts);
}

}  // namespace lyrefit
