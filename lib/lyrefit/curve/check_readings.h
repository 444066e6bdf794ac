#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// Something in the readings that no device does, or that is more likely the instrument's or the
// file's than the device's.
struct ReadingFinding {
  std::string id;           // "overflow", "nothing", "sign", "exchanged", "unit", "light", "cells",
                            // "current", "shape", "limit"
  std::string sentence;     // what was seen and what to do; no full stop
  bool refuse = false;      // false: a doubt, the readings can be worked with
  std::vector<int> points;  // positions in the curve it is about; empty: all
  bool always = false;      // refused even `as_is`: there is nothing that could be fitted
};

// What is wrong with the readings of a sound curve (see Validate) before anything is fitted, the
// worst first:
//   overflow   values that instruments write for "out of range" (9.91e37 and the like)
//   nothing    all currents 0, equal, or below what any instrument resolves
//   sign       current that rises with voltage; current taken in at 0 V
//   exchanged  voltage in the column of the current
//   unit       more than 30 A a string or 2000 V where the file names no unit
//   light      no light stated, or next to none, where the device delivers current
//   cells      an open-circuit voltage below 0.2 or above 1.6 V a cell, at light
//   current, shape   sizes that no device has: see CheckPlausibility
//   limit      equal readings at an end of the curve where a device's would differ
// Real curves, dark, coarse, noisy or shaded ones among them, have none.
std::vector<ReadingFinding> CheckReadings(const IvCurve& curve);

// The sentences of what is doubted. Errors: those of Validate, and what has to be refused, unless
// the curve is to be taken `as_is`; then that is the first of the doubts. Overflows and dead
// channels are refused always.
Expected<std::vector<std::string>> JudgeReadings(const IvCurve& curve);

// The same for curves of one measurement: each doubt once, with the first curve it is about.
Expected<std::vector<std::string>> JudgeReadings(const std::vector<IvCurve>& curves);

// How many cells in series give so many volts: a usual number of a module's (36, 54, 60, 72, 96)
// where one is within a tenth.
int LikelyCells(double open_circuit_voltage_V);

}  // namespace lyrefit
