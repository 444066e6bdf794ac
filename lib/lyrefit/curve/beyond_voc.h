#pragma once

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

// Reduces a column to the readings `kept`, by their indices; an empty column stays empty.
template <typename Value>
void KeepValues(const std::vector<int>& kept, std::vector<Value>* values) {
  if (values->empty()) return;
  std::vector<Value> few;
  few.reserve(kept.size());
  for (const int k : kept) few.push_back((*values)[k]);
  *values = std::move(few);
}

// Reduces every column of a curve.
inline void KeepReadings(const std::vector<int>& kept, IvCurve* curve) {
  for (std::vector<double>* column :
       {&curve->voltage_V, &curve->current_A, &curve->sigma_A, &curve->time_s,
        &curve->irradiance_W_m2, &curve->temperature_C}) {
    KeepValues(kept, column);
  }
  KeepValues(kept, &curve->sweep);
}

// Readings of a lit curve far beyond open circuit that do not belong to its diode. A sweep may go
// on until the forward current is many times Isc. There injection, leads and other conduction add
// to the device, and each reading outweighs all readings up to Voc.
struct BeyondVoc {
  int left_out = 0;          // readings above `last_V`; 0: all readings belong to the diode
  double last_V = HUGE_VAL;  // highest voltage of the readings that belong to the diode
  double largest_A = 0;      // largest forward current of all readings
};

// Compares a junction with series resistance, V = a + b ln(J) - Rs I, with the readings. All belong
// to the diode if its misfit stays within 1 % of Isc, or within five times that of the readings up
// to Voc. Otherwise those up to the first reading beyond Voc do. All readings are kept if
//   - the forward current stays below Isc,
//   - the curve is dark, or does not show Isc and Voc,
//   - the readings up to Voc show no diode that could judge the others: Voc is below 6 n Vt.
BeyondVoc FindBeyondVoc(const IvCurve& curve);

// The curve without these readings. An assumption then tells their number and the reason. A curve
// to be taken as it is (`as_is`) stays as it is.
IvCurve WithoutBeyondVoc(IvCurve curve);

// A step: the current falls with voltage and then stays level. Diodes in parallel cannot cause it;
// a conducting bypass diode or a change of irradiance can.
struct CurveStep {
  double voltage_V = 0;  // where the fall ends
  double depth_A = 0;    // distance below the upper convex hull of the curve
};

// Finds the deepest step of a curve at forward voltage. The depth must exceed 2 % of the largest
// current and six times the noise, and a single reading does not count. The current of a diode
// model is concave in the voltage, so the curve is compared with its upper convex hull.
std::optional<CurveStep> FindStep(const IvCurve& curve);

}  // namespace lyrefit
