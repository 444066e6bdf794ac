#pragma once

#include "lyrefit/law/effect.h"

// A plain stage among those that are templates over their number type.
namespace lyrefit {

// Eight numbers of each derivative: by x, photocurrent, thermal voltage, then by the parameters.
struct StageBlocks {
  static constexpr int kParameters = 20;  // more than a law may have
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

// Calls `stage` at numbers that `blocks` hold; `all`: with every derivative, else by x alone.
void CallPlainStage(const PlainStage& stage, int parameters, double reach, double cells, bool all,
                    StageBlocks* blocks);

template <int N>
void AddChain(const Block& slope, const Dual<N, Pack>& x, Dual<N, Pack>* sum) {
  const Pack by = every_processor::Load(slope);
  for (int k = 0; k < N; ++k) sum->v[k] = sum->v[k] + by * x.v[k];
}

// What the stage of an effect of `size` parameters adds at x, with the derivatives of the number type.
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
