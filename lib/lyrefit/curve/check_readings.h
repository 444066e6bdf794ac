#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// A property of the readings that no device shows, or that the instrument or the file explains
// better than the device.
struct ReadingFinding {
  std::string id;           // "overflow", "nothing", "sign", "exchanged", "unit", "light", "cells",
                            // "technology", "current", "efficiency", "shape", "temperature",
                            // "limit", "key-points", "head"
  std::string sentence;     // what was found and what to do; no full stop
  bool refuse = false;      // false: a doubt; the readings can be used
  std::vector<int> points;  // positions in the curve; empty: all points
  bool always = false;      // refused even with `as_is`: no fit is possible
};

// Checks the readings of a curve that passes Validate, before any fit. Findings that refuse the
// curve come first. The ids are:
//   overflow   values that instruments write for "out of range" (9.91e37 and the like)
//   nothing    all currents 0, equal, or below the resolution of any instrument
//   sign       current that rises with voltage; negative current at 0 V
//   exchanged  voltage in the column of the current
//   unit       more than 30 A a string or 2000 V if the file names no unit; more than 20 kA a
//              string or 20 kV in any unit
//   light      a stated irradiance near 0 although the device delivers current
//   cells      an open-circuit voltage below 0.2 or above 1.6 V a cell, under light
//   technology an open-circuit voltage above that of a cell of the stated technology; of silicon for
//              a module and a cell of some ampere of which none is stated
//   current, efficiency, shape, temperature   magnitudes that no device has: see CheckPlausibility
//   limit      equal readings at an end of the curve where those of a device would differ
//   key-points an Imp above Isc or a Vmp above Voc, where a laboratory states these
//   head       no temperature is known, but a line of the head speaks of one
// Real curves have no findings, including dark, coarse, noisy and shaded ones.
std::vector<ReadingFinding> CheckReadings(const IvCurve& curve);

// Sentences of the doubts about a curve. Errors: those of Validate, and the first finding that
// refuses the curve. With `as_is`, refusing findings become the first doubts, except overflow codes
// and dead channels, which are always errors.
Expected<std::vector<std::string>> JudgeReadings(const IvCurve& curve);

// Doubts about the curves of one measurement: one sentence for each id, which names the first curve
// concerned.
Expected<std::vector<std::string>> JudgeReadings(const std::vector<IvCurve>& curves);

// Likely number of cells in series for an open-circuit voltage in V. It is the nearest usual module
// size (36, 54, 60, 72, 96) if one is within a tenth, otherwise the voltage divided by 0.62 V a
// cell.
int LikelyCells(double open_circuit_voltage_V);

}  // namespace lyrefit
