// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cmath>

#include "lyrefit/base/portable_exp.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Eight numbers of a curve, aligned for loops over eight numbers.
struct alignas(64) Block {
  static constexpr int kLanes = 8;  // numbers in a block
  double lane[kLanes];              // the numbers
};

// The pack for any processor. Kernels define wider packs for newer processors.
namespace every_processor {

#define LYREFIT_PACK_WIDTH 2
#include "lyrefit/model/pack.inc"

inline Pack sqrt(const Pack& a) {
  Block block;
  Store(a, &block);
  for (double& lane : block.lane) lane = std::sqrt(lane);
  return Load(block);
}
inline const Pack& ValueOf(const Pack& a) { return a; }
// Infinity and NaN times 0 are NaN, and every comparison with NaN is false.
inline bool AllFinite(const Pack& a) { return All(-1.0 < a * 0.0); }

}  // namespace every_processor

using every_processor::Mask;
using every_processor::Pack;

}  // namespace lyrefit
