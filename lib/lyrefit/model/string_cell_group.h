#pragma once

#include "lyrefit/model/string.h"

// Functions of one cell group, for the Newton solver (string.cc) and the bracketed one
// (string_brackets.cc).
namespace lyrefit {

constexpr double kShort = 1e-9;      // relative voltage step after which the next is below rounding
constexpr double kRounding = 3e-15;  // relative rounding error of sums of currents

inline int SubstringOf(const Cell<Pack>& cell, int group) {
  return cell.groups == 1 ? 0 : cell.group[group].substring;
}
inline Pack ShareOf(const Cell<Pack>& cell, int group) {
  return cell.groups == 1 ? Pack(1.0) : cell.group[group].share;
}
inline bool IsBeside(const Cell<Pack>& cell, int group) {
  return cell.groups > 1 && cell.group[group].beside;
}
inline Mask IsShort(const Pack& step, const Pack& of) {
  return abs(step) < kShort * (1.0 + abs(of));
}

// Limits a step: beyond `limit` the rest is replaced by its logarithm, in units of `unit`.
Pack Limited(const Pack& from, const Pack& to, const Pack& limit, const Pack& unit);

// Newton's step towards a current of at most `size`. Far up an exponential, where Newton's steps
// have constant length, the step of the logarithm is used.
Pack StepDown(const Pack& newton, const Dual<1, Pack>& current, const Pack& size);

// Next voltage of one junction, from a Newton step `way`.
Pack NextVoltage(const Cell<Pack>& cell, const StringLimits& limits, const Pack& u, const Pack& way,
                 const Dual<1, Pack>& current, const Pack& size);

// Current of a cell group at the voltages of a state.
GroupPoint PointOf(const EvaluationContext<Pack>& context, const Cell<Pack>& cell, int group,
                   const StringState& state);

}  // namespace lyrefit
