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
  kSweep,  // sweep of one measurement: up, down, light, dark
  kCurve,  // one of several measurements in a file
  kIrradiance,
  kTemperature,
  kCurrentDensity,  // converted to a current by the area of the cell
  kArea,            // stated in the head of a table, never a column
};

// Interpretation of a header cell. A value of the file is converted as factor * value + offset. The
// result is in V, A, A/cm2, s, W/m2 or degrees Celsius.
struct Column {
  ColumnKind kind = ColumnKind::kUnrecognised;
  std::string label;  // as in the file
  std::string unit;   // as recognised; empty if the label names none
  double factor = 1;
  double offset = 0;
  std::string refusal;  // why the column cannot be used; empty if it can
  std::string number;   // of one of several voltages or currents: "1" of "I1" and "Current 1 (A)"
};

// Recognises labels such as "Voltage (mV)", "I_mA", "U [V]", "Amps", "Current 2 (A)". Case and
// punctuation are ignored, except that a lone t is a time and a lone T a temperature.
Column RecogniseColumn(std::string_view label);

// Interprets the label of a column that the user has declared a voltage or a current. Only the unit
// is read from the label.
Column ColumnSaidToBe(ColumnKind kind, std::string_view label);

}  // namespace lyrefit
