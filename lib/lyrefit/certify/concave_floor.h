#pragma once

#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Lower bounds of the unweighted solved-current RMSE of any device of passive parts, whatever its
// diodes, photocurrents, shares and resistances are.
//
// The current of a cell is concave and never rises with its voltage. Its junction has these
// properties: the current is the photocurrent less currents that are convex and never fall. Series
// resistance keeps them, because the set under I(V) stays convex when I Rs is subtracted from the
// voltage. The inverse V(I) is concave and never rises as well. So are a sum of such V(I), for
// different cells in series, and a sum of such I(V), for cells in parallel. The curve of any cells
// is therefore concave and never rises, unless a bypass diode bridges them or they are driven into
// breakdown.
//
// When a bypass diode conducts, the voltage of its substring is max(voltage of its cells, -Vb). At
// smaller currents all substrings contribute, at larger ones the other substrings less Vb. On
// either side of the current at which the diode begins to conduct, the curve is concave and never
// rises. A real bypass diode begins to conduct along a bend, which ends where the current has
// fallen to the plateau.
struct ConcaveFloor {
  // No curve that is concave and never rises has a smaller RMSE.
  double smooth_A = 0;
  // No curve that is concave and never rises on either side of a bend has a smaller RMSE. Readings
  // within the bend do not count: kBendReadings of them, or more that lie within `bend_V`. This
  // covers two substrings of any shares, photocurrents and cells, one of them bypassed. The bypass
  // diode is ideal, or real with a bend that is no wider.
  double step_A = 0;
  double step_V = kUnknown;  // voltage at which the first side of the lowest fit ends
};
// Number of readings that are always excluded as the bend of a bypass diode, wherever it lies.
constexpr int kBendReadings = 2;

// Computes both floors from readings in any order; both vectors have the same length. `bend_V` is
// the largest width of the bend in volt. Rounding aside both floors are proofs.
ConcaveFloor FindConcaveFloor(const std::vector<double>& voltage_V,
                              const std::vector<double>& current_A, double bend_V);

}  // namespace lyrefit
