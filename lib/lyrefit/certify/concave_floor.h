#pragma once

#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// How low the solved-current RMSE (unweighted) of any device of passive parts can go, whatever its
// diodes, lights, shares and resistances are.
//
// The current of a cell is concave and never rises with its voltage: that of its junction is
// (photocurrent less currents that are convex and never fall), and what lies under I(V) stays
// convex as a set where I Rs is taken off the voltage. Its inverse V(I) is concave and never rises
// as well. A sum of such V(I) is one again (cells in series that differ), a sum of such I(V) too
// (in parallel). So the curve of cells of whatever kinds, none of which is bridged by a bypass diode
// nor driven into breakdown, is concave and never rises.
//
// Where a bypass diode takes over, the voltage of its substring is max(its cells, -Vb). At smaller
// currents all substrings act, at larger ones the others less Vb: on either side of the current at
// which it takes over the curve is concave and never rises. A real bypass diode takes over along a
// bend, which ends with the current's fall to the plateau.
struct ConcaveFloor {
  // No curve that is concave and never rises has a smaller RMSE.
  double smooth_A = 0;
  // None that is so on either side of a bend within which nothing counts: of kBendReadings, or of
  // more that lie within the volts asked for. Two substrings of any shares, lights and cells, one
  // bypassed by an ideal diode, or by a real one whose bend is no wider.
  double step_A = 0;
  double step_V = kUnknown;  // where the first side ends, of the lowest
};
// Readings that may lie within the bend of a bypass diode, wherever it is.
constexpr int kBendReadings = 2;

// Of readings in any order. Rounding aside both are proofs.
ConcaveFloor FindConcaveFloor(const std::vector<double>& voltage_V,
                              const std::vector<double>& current_A, double bend_V);

}  // namespace lyrefit
