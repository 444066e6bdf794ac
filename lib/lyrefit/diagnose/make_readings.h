#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/law/reading.h"

namespace lyrefit {

// A measurement laid out reading by reading, and what had to be said about its metadata.
struct Measurement {
  Readings readings;
  std::vector<char> dark;             // of each curve
  std::vector<std::string> warnings;  // metadata that the data contradict, in plain sentences
};

// Errors: no usable curve, two devices (cell counts differ), fewer than 7 readings.
Expected<Measurement> MakeReadings(const CurveSet& set);

// The times at which an irradiance step may lie, of one curve: between two of its readings.
void SetStepTimes(Readings* readings);

// A copy of the set in which curves whose readings come in no order (hardly two in a row go one
// way) are sorted by voltage, their times forgotten; says so.
CurveSet InOrder(const CurveSet& set, std::vector<std::string>* warnings);

// Where monotone stretches of voltage begin: 0, then every turning point. Turns of less than a
// fifth of the whole range are jitter.
std::vector<int> FindTurns(const std::vector<double>& voltage);

}  // namespace lyrefit
