#pragma once

#include <cmath>

#include "lyrefit/base/portable_exp.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Eight numbers of a curve, laid out for loops that take as many at a time.
struct alignas(64) Block {
  static constexpr int kLanes = 8;  // numbers in a block
  double lane[kLanes];              // the numbers
};

// The pack of every processor; kernels have packs of their own for newer ones.
namespace every_processor {

#define LYREFIT_PACK_WIDTH 2
#include "lyrefit/law/pack.inc"

inline Pack sqrt(const Pack& a) {
  Block block;
  Store(a, &block);
  for (double& lane : block.lane) lane = std::sqrt(lane);
  return Load(block);
}
inline const Pack& ValueOf(const Pack& a) { return a; }
inline bool Any(const Mask& mask) { return !All(!mask); }
// Infinity and NaN times 0 are NaN, which is never above anything.
inline bool AllFinite(const Pack& a) { return All(-1.0 < a * 0.0); }

}  // namespace every_processor

using every_processor::Mask;
using every_processor::Pack;

}  // namespace lyrefit
