#pragma once

#include <vector>

#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/read/column.h"
#include "lyrefit/read/sidecar.h"
#include "lyrefit/read/table_columns.h"

namespace lyrefit {

// A second or later sweep of a measurement whose sweeps stand side by side.
struct FurtherSweep {
  IvCurve curve;           // voltage, current and the columns that all sweeps share
  std::vector<int> lines;  // of its rows
};

// Sets the light of a measurement whose current column is called dark to 0 W/m2.
void TakeLight(const Column& current, IvCurve* curve, Sidecar* stated);

// Appends the further sweeps of a channel to the first one, which `curve` holds, and numbers all
// from 1. Each sweep gets the direction that its label states. A sweep that is stored in the order
// of its scan under the voltages of another direction is turned. `lines` are those of the rows, if
// they are known. Does nothing without further sweeps.
void JoinSweeps(const std::vector<Column>& columns, const Channel& channel,
                std::vector<FurtherSweep> further, IvCurve* curve, std::vector<int>* lines);

// Reverses a sweep whose voltages go against `direction`.
void GiveDirection(SweepDirection direction, IvCurve* sweep);

}  // namespace lyrefit
