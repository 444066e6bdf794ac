#pragma once

#include <cmath>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/model/effect.h"
#include "lyrefit/model/law.h"
#include "lyrefit/model/reading.h"
#include "lyrefit/model/term.h"

namespace lyrefit {

// Evaluates a plain stage (plain_stage.h) inside laws written as templates over their number type.

// Arguments and results of one call of a plain stage, for a block of eight readings. The
// derivatives are by x, photocurrent and thermal voltage, then by each parameter of the effect.
struct StageBlocks {
  static constexpr int kParameters = 20;  // at least the parameters of any law
  Block x;
  Block photocurrent;
  Block thermal_voltage;
  Block value;
  Block by_x;
  Block by_photocurrent;
  Block by_thermal_voltage;
  double p[kParameters];
  Block by_p[kParameters];
};

// Calls `stage` on the inputs in `blocks` and writes value and derivatives there. `all`: fills all
// derivatives, otherwise only the derivative by x. `parameters`: number of the effect's parameters.
// `reach`: largest |voltage| of the readings, V per cell; `cells`: cells in series.
void CallPlainStage(const PlainStage& stage, int parameters, double reach, double cells, bool all,
                    StageBlocks* blocks);

template <int N>
void AddChain(const Block& slope, const Dual<N, Pack>& x, Dual<N, Pack>* sum) {
  const Pack by = every_processor::Load(slope);
  for (int k = 0; k < N; ++k) sum->v[k] = sum->v[k] + by * x.v[k];
}

// Value of a stage at x, with the derivatives that the number type S carries. `size`: number of
// parameters of the effect.
template <class S>
Tangent<S> CallStage(const PlainStage& stage, int size, const S* p, const Cell<S>& cell,
                     const S& photocurrent, const Tangent<S>& x) {
  constexpr bool kAll = !std::is_same_v<S, Pack>;
  StageBlocks blocks;
  every_processor::Store(ValueOf(x), &blocks.x);
  every_processor::Store(ValueOf(photocurrent), &blocks.photocurrent);
  every_processor::Store(ValueOf(cell.thermal_voltage), &blocks.thermal_voltage);
  for (int k = 0; k < size; ++k) blocks.p[k] = ValueOf(p[k])[0];
  CallPlainStage(stage, size, cell.reach, cell.cells, kAll, &blocks);
  Tangent<S> result = every_processor::Load(blocks.value);
  AddChain(blocks.by_x, x, &result);
  if constexpr (kAll) {
    AddChain(blocks.by_photocurrent, photocurrent, &result);
    AddChain(blocks.by_thermal_voltage, cell.thermal_voltage, &result);
    for (int k = 0; k < size; ++k) AddChain(blocks.by_p[k], p[k], &result);
  }
  return result;
}

// Terms of the terminal law of one cell, over any number type. string.h solves cells in series with
// them, law.cc differentiates them.

// Conductance that every junction keeps, in current scales per volt. The first value applies when
// all cells are alike and is negligible in any result. The second applies to cells of a string: it
// lets a cell carry the string current in reverse, at a very large voltage.
constexpr double kLeastConductance = 1e-13;
constexpr double kLeastLeak = 1e-8;

// A law, its readings and its parameters. `offsets`: position in `p` of the first parameter of each
// effect.
template <class S>
struct EvaluationContext {
  const Law& law;
  const Readings& readings;
  const S* p;
  std::vector<int> offsets;
};

template <class S>
EvaluationContext<S> MakeEvaluationContext(const Law& law, const Readings& readings, const S* p) {
  EvaluationContext<S> context{law, readings, p, {}};
  int offset = law.base_size();
  for (const Effect* effect : law.effects) {
    context.offsets.push_back(offset);
    offset += effect->size();
  }
  return context;
}

template <class S>
OperatingConditions<S> ConditionsAt(const EvaluationContext<S>& context,
                                    const ReadingBlock& readings) {
  const Law& law = context.law;
  OperatingConditions<S> conditions{
      S(readings.voltage), S(readings.irradiance), S(readings.temperature_K),
      law.free_bandgap ? context.p[law.BandgapAt()] : S(context.readings.bandgap_eV),
      S(law.free_tempco ? 0.0 : context.readings.isc_tempco_per_K)};
  for (std::size_t e = 0; e < law.effects.size() && !readings.suns_voc; ++e) {
    const auto stage = law.effects[e]->conditions.template For<S>();
    if (stage != nullptr) stage(context.p + context.offsets[e], readings, &conditions);
  }
  return conditions;
}

// Adds the diodes of the base at one temperature. `warmer` and `warmer_2`: factors of the saturation
// currents of the first and of further diodes between the reference and that temperature.
template <class S>
void AddDiodes(const EvaluationContext<S>& context, const S& inverse_vt, const S& warmer,
               const S& warmer_2, Cell<S>* cell) {
  const double per_scale = 1 / context.readings.scale.current_A;
  for (int d = 0; d < static_cast<int>(context.law.model); ++d) {
    const S saturation = context.p[SaturationCurrentIndex(d)] * per_scale;
    cell->diode[cell->diodes++] = {saturation * (d == 0 ? warmer : warmer_2),
                                   inverse_vt / context.p[IdealityIndex(d)]};
  }
}

// Sets all fields of a cell that depend on the temperature but not on the irradiance.
template <class S>
void CellUnder(const EvaluationContext<S>& context, const OperatingConditions<S>& conditions,
               Cell<S>* cell) {
  const ReadingScale& scale = context.readings.scale;
  const double k_eV = ThermalVoltage(1.0, context.law.constants);
  const double reference_K = context.readings.reference_temperature_K;
  const S ratio = conditions.temperature_K * (1 / reference_K);
  const S inverse_vt = 1.0 / (conditions.temperature_K * k_eV);
  const S barrier = DeSotoBarrier(conditions.bandgap_eV, S(context.law.bandgap_slope_per_K),
                                  reference_K, conditions.temperature_K, k_eV);
  const S warmer = exp(barrier) * (ratio * ratio * ratio);
  const S warmer_2 = (ratio * ratio * sqrt(ratio)) * exp(0.5 * barrier);
  cell->thermal_voltage = conditions.temperature_K * k_eV;
  cell->saturation_2_unit = scale.saturation_2_unit * warmer_2;
  cell->diodes = 0;
  AddDiodes(context, inverse_vt, warmer, warmer_2, cell);
  cell->resistance = context.p[kRs] * (1 / scale.resistance_ohm());
  cell->reach = scale.reach_V;
  const DataTraits& traits = context.readings.traits;
  cell->cells = traits.cells;
  cell->substring_cells = cell->cells / SubstringsOf(traits);
  cell->bypass_ideality = S(kUsualBypassIdeality);
}

// Sets the fields that depend on the irradiance: photocurrent and shunt conductance. CellUnder must
// have run before.
template <class S>
void Light(const EvaluationContext<S>& context, const OperatingConditions<S>& conditions,
           Cell<S>* cell) {
  const Law& law = context.law;
  const Readings& readings = context.readings;
  const double per_scale = 1 / readings.scale.current_A;
  const S* p = context.p;
  cell->irradiance = conditions.irradiance;
  const S warmer = conditions.temperature_K - readings.reference_temperature_K;
  const S absolute =
      law.free_tempco ? S(p[law.TempcoAt()] * per_scale) : S(readings.isc_tempco_scales_per_K);
  cell->photocurrent =
      conditions.irradiance *
      (p[kIph] * per_scale * (1.0 + conditions.isc_tempco_per_K * warmer) + absolute * warmer);
  const S conductance = readings.scale.resistance_ohm() / p[kRsh];
  const bool inverse = law.shunt == ShuntLaw::kInverse;
  cell->conductance = inverse ? conductance * conditions.irradiance : conductance;
}

// Sets cell groups, substrings, bypass diodes and reverse law from a layout.
template <class S>
void LayOut(const StringLayout& layout, double current_scale_A, Cell<S>* cell) {
  cell->groups = static_cast<int>(layout.groups.size());
  cell->substrings = static_cast<int>(layout.substrings.size());
  cell->strings = layout.strings;
  for (int g = 0; g < cell->groups; ++g) {
    const StringLayout::Cells& cells = layout.groups[g];
    const double leak = cells.leak_S * layout.strings / current_scale_A;
    cell->group[g] = {S(cells.share), S(cells.light), S(leak), cells.substring};
  }
  for (int p = 0; p < cell->substrings; ++p) cell->substring[p] = layout.substrings[p];
  cell->bypass = S(layout.bypass_voltage_V);
  cell->bypass_ideality = S(layout.bypass_ideality);
  cell->reverse = layout.reverse;
  cell->reverse_strength = S(layout.reverse_strength);
  cell->reverse_voltage = S(layout.reverse_voltage_V);
  cell->reverse_exponent = S(layout.reverse_exponent);
}

// Applies the layout and the cell stages of all effects to a cell at its operating conditions.
template <class S>
void ApplyCellStages(const EvaluationContext<S>& context, Cell<S>* cell) {
  if (context.law.layout != nullptr) {
    LayOut(*context.law.layout, context.readings.scale.current_A, cell);
  }
  for (std::size_t e = 0; e < context.law.effects.size(); ++e) {
    const auto stage = context.law.effects[e]->cell.template For<S>();
    if (stage != nullptr) stage(context.p + context.offsets[e], cell);
  }
}

// Changes a cell to one at open circuit, where every cell is under the full light. Returns the
// voltage that it has then above the measured one: a cell under the part w gives n Vt ln w less.
template <class S>
S OpenCircuit(Cell<S>* cell) {
  constexpr double kLeastLight = 1e-8;  // gives no voltage
  cell->suns_voc = true;
  cell->resistance = S(0.0);
  cell->two_parts = false;
  cell->reverse = ReverseLaw::kShunt;
  S above = S(0.0);
  for (int p = 0; p < cell->substrings; ++p) cell->substring[p].bypassed = false;
  for (int g = 0; g < cell->groups && cell->groups > 1; ++g) {
    CellGroup<S>& group = cell->group[g];
    const S less = log(Larger(group.light, S(kLeastLight))) / cell->diode[0].inverse_n_vt;
    if (!group.beside) above = above - group.share * less;
    group.light = S(1.0);
  }
  return above;
}

template <class T>
T Cut(const T& exponent) {
  return Smaller(exponent, T(kLargestExponent));
}

// The fields of a cell that the reverse law depends on.
template <class S>
struct ReverseTerms {
  ReverseLaw law;
  S photocurrent;
  S conductance;
  S strength;
  S voltage;
  S exponent;
};

// Current that a cell adds in reverse beside its shunt current, in current scales.
template <class S, class T>
T ReverseCurrent(const ReverseTerms<S>& cell, const T& voltage) {
  constexpr double kLeast = 1e-9;  // of `voltage`; smaller depths count as this
  if (!Any(voltage < 0.0)) return T(0.0);
  const T depth = Larger(-voltage * (1.0 / cell.voltage), kLeast);
  if (cell.law == ReverseLaw::kSoft) {
    const T current = exp(log(depth) * cell.exponent) * cell.photocurrent;
    return Choose(voltage < 0.0, current, T(0.0));
  }
  constexpr double kClosest = 0.02;  // above 1 - this depth a tangent replaces the pole
  const T gap = Larger(1.0 - depth, kClosest);
  const T edge = -(1.0 - gap) * cell.voltage;  // limited to the tangent's start
  const T factor = exp(-log(gap) * cell.exponent);
  const T slope = factor * (1.0 - edge * (cell.exponent / cell.voltage) / gap);
  const T current =
      -(edge * factor + (voltage - edge) * slope) * S(cell.conductance * cell.strength);
  return Choose(voltage < 0.0, current, T(0.0));
}
template <class S, class T>
T ReverseCurrent(const Cell<S>& cell, const T& voltage) {
  return ReverseCurrent(
      ReverseTerms<S>{cell.reverse, cell.photocurrent, cell.conductance, cell.reverse_strength,
                      cell.reverse_voltage, cell.reverse_exponent},
      voltage);
}

// Adds the terms of effects to a current of the junction.
template <class S>
Tangent<S> AddEffects(const EvaluationContext<S>& context, const Cell<S>& cell,
                      const S& photocurrent, const Tangent<S>& voltage, Tangent<S> current) {
  for (std::size_t e = 0; e < context.law.effects.size(); ++e) {
    const Effect& effect = *context.law.effects[e];
    const S* const p = context.p + context.offsets[e];
    const auto stage = effect.junction.template For<S>();
    if (stage != nullptr) current = current + stage(p, cell, photocurrent, voltage);
    if (!effect.plain_junction) continue;
    current =
        current + CallStage(effect.plain_junction, effect.size(), p, cell, photocurrent, voltage);
  }
  return current;
}

// Whether the series drop D(I) has terms beside I Rs.
template <class S>
bool HasMoreDrop(const EvaluationContext<S>& context, const Cell<S>& cell) {
  if (cell.suns_voc) return false;
  for (const Effect* effect : context.law.effects) {
    if (effect->ChangesSeries()) return true;
  }
  return false;
}
template <class S>
Tangent<S> MoreDrop(const EvaluationContext<S>& context, const Cell<S>& cell,
                    const Tangent<S>& current) {
  Tangent<S> drop = 0.0;
  for (std::size_t e = 0; e < context.law.effects.size(); ++e) {
    const Effect& effect = *context.law.effects[e];
    const S* const p = context.p + context.offsets[e];
    const auto stage = effect.series.template For<S>();
    if (stage != nullptr) drop = drop + stage(p, cell, current);
    if (!effect.plain_series) continue;
    drop =
        drop + CallStage(effect.plain_series, effect.size(), p, cell, cell.photocurrent, current);
  }
  return drop;
}

// Current through the bypass diode beside a substring of `cells` cells, in current scales. `turn_on`:
// its voltage at one current scale. `reverse`: reverse voltage per cell, in V.
template <class S, class T>
T BypassCurrent(const S& turn_on, const S& ideality, const S& thermal_voltage, double cells,
                const T& reverse) {
  const S inverse = (1.0 / ideality) / thermal_voltage;
  const S start = exp(-(turn_on * inverse));
  return exp(Cut(T((reverse * cells - turn_on) * inverse))) - start;
}
template <class S, class T>
T BypassCurrent(const Cell<S>& cell, double cells, const T& reverse) {
  return BypassCurrent(cell.bypass, cell.bypass_ideality, cell.thermal_voltage, cells, reverse);
}

}  // namespace lyrefit
