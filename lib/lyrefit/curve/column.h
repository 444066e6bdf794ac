#pragma once

#include <string>
#include <string_view>

namespace lyrefit {

enum class ColumnKind {
  kUnrecognised,
  kVoltage,
  kCurrent,
  kSigma,
  kTime,
  kSweep,  // member of one measurement: up, down, light, dark
  kCurve,  // one of several measurements in a file
  kIrradiance,
  kTemperature,
  kCurrentDensity,  // becomes a current by the area of the cell
  kArea,            // stated in the head of a table, never a column
};

// What a header cell says about its column. A value in the file becomes factor * value + offset in
// V, A, A/cm2, s, W/m2 or degrees Celsius.
struct Column {
  ColumnKind kind = ColumnKind::kUnrecognised;
  std::string label;  // as in the file
  std::string unit;   // as understood, empty where the label names none
  double factor = 1;
  double offset = 0;
  std::string refusal;  // why a column of this kind cannot be used, empty if it can
  std::string number;   // of one voltage or current among several: "1" of "I1" and "Current 1 (A)"
};

// Reads "Voltage (mV)", "I_mA", "U [V]", "Amps", "Current 2 (A)", ... without regard to case and
// punctuation. Only a lone t and T differ: time and temperature.
Column RecogniseColumn(std::string_view label);

// The column called `label` where somebody has said that it holds a voltage or a current: its name
// does not matter, its unit does.
Column ColumnSaidToBe(ColumnKind kind, std::string_view label);

}  // namespace lyrefit
