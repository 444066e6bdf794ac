#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
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

// The columns of a Suns-Voc trace: open-circuit voltages over light.
struct SunsVocColumns {
  int voltage = -1;
  int light = -1;             // photocurrent in A, or light in suns
  bool photocurrent = false;  // whether `light` is a photocurrent
  double voltage_factor = 1;  // to V
  double light_factor = 1;    // to A or suns
};

// Finds the columns of a Suns-Voc trace by their labels: a voltage or Voc beside a photocurrent (IL,
// Iph) or light in suns, W/m2 or mW/cm2, and neither a current nor further key points.
std::optional<SunsVocColumns> FindSunsVoc(const std::vector<std::string>& labels);

// Replaces light, which stands in `current_A` as written, by the current of the curve without series
// resistance (Sinton and Cuevas 2000): the reading at light S belongs to Isc (1 - S), with S in
// suns. With photocurrents IL in place of light it is max(IL) - IL, a curve at the brightest light.
// `isc`: short-circuit current at one sun. Error: light in suns without `isc`.
Expected<void> LightToCurrent(const SunsVocColumns& columns, std::optional<double> isc,
                              IvCurve* curve);

// Marks a curve whose currents a tester has made of the light of a Suns-Voc trace.
void SayIsTrace(IvCurve* curve);

}  // namespace lyrefit
