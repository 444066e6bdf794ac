#pragma once

#include "lyrefit/model/effect.h"

// Evaluates a plain stage (plain_stage.h) inside laws written as templates over their number type.
namespace lyrefit {

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

}  // namespace lyrefit
