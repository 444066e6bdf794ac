#pragma once

#include "lyrefit/law/string.h"

// What both solvers of a string need of one kind of its cells.
namespace lyrefit {

constexpr double kShort = 1e-9;      // of a voltage: after such a step the next is below rounding
constexpr double kRounding = 3e-15;  // of a current: what sums of such make of it

inline int PartOf(const Cell<Pack>& cell, int kind) {
  return cell.kinds == 1 ? 0 : cell.kind[kind].part;
}
inline Pack ShareOf(const Cell<Pack>& cell, int kind) {
  return cell.kinds == 1 ? Pack(1.0) : cell.kind[kind].share;
}
inline bool IsBeside(const Cell<Pack>& cell, int kind) {
  return cell.kinds > 1 && cell.kind[kind].beside;
}
inline Mask IsShort(const Pack& step, const Pack& of) {
  return abs(step) < kShort * (1.0 + abs(of));
}

// A step that leads beyond `limit` goes on by the logarithm of the rest, in units of `unit`.
Pack Limited(const Pack& from, const Pack& to, const Pack& limit, const Pack& unit);

// Newton's step to where a current is `size` at most, or, far up an exponential where such steps
// are all alike, the step of its logarithm.
Pack StepDown(const Pack& newton, const Dual<1, Pack>& current, const Pack& size);

// One junction's next voltage, `way` of Newton further.
Pack NextVoltage(const Cell<Pack>& cell, const StringLimits& limits, const Pack& u, const Pack& way,
                 const Dual<1, Pack>& current, const Pack& size);

// Current of a kind at the voltages of a state.
KindPoint PointOf(const EvaluationContext<Pack>& context, const Cell<Pack>& cell, int kind,
                  const StringState& state);

}  // namespace lyrefit
