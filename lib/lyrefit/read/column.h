#pragma once

#include <string>
#include <string_view>

namespace lyrefit {

struct Unit;  // label.h

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

// Whether a kind is a current, per area or not.
inline bool IsCurrent(ColumnKind kind) {
  return kind == ColumnKind::kCurrent || kind == ColumnKind::kCurrentDensity;
}

// Whether a kind is a voltage or a current.
inline bool IsElectrical(ColumnKind kind) {
  return kind == ColumnKind::kVoltage || IsCurrent(kind);
}

// Direction of a sweep: towards higher voltages or towards lower ones.
enum class SweepDirection { kUnknown, kForward, kReverse };

// Light during a sweep, as far as a label states it. kSunsVoc: a Suns-Voc trace, at open circuit
// while the light decays.
enum class SweepLight { kUnknown, kDark, kLight, kSunsVoc };

// What tells columns of one quantity apart: "a_Forward_Dark", "Pixel 2", "Current 1 (A)".
struct ColumnTag {
  std::string device;  // "a", "Pixel 2", "1"; empty if the label names none
  SweepDirection direction = SweepDirection::kUnknown;
  SweepLight light = SweepLight::kUnknown;
  bool average = false;    // of other columns
  bool by_letter = false;  // the light is stated by a letter: "Jd" beside "Jl"
};

// Direction and light that the words of a text state. The other words, joined by blanks, are the
// device.
ColumnTag ReadTag(std::string_view text);

// Whether the tag names a direction or a light.
inline bool StatesSweep(const ColumnTag& tag) {
  return tag.direction != SweepDirection::kUnknown || tag.light != SweepLight::kUnknown;
}

// Interpretation of a header cell. A value of the file is converted as factor * value + offset. The
// result is in V, A, A/cm2, s, W/m2 or degrees Celsius.
struct Column {
  ColumnKind kind = ColumnKind::kUnrecognised;
  std::string label;  // as in the file
  std::string unit;   // as recognised; empty if the label names none
  double factor = 1;
  double offset = 0;
  std::string refusal;  // why the column cannot be used; empty if it can
  ColumnTag tag;        // of one of several voltages or currents
  bool light = false;   // light of a Suns-Voc trace in place of a current; see join_sweeps.h
};

// Recognises labels such as "Voltage (mV)", "I_mA", "U [V]", "Amps", "Current 2 (A)". Case and
// punctuation are ignored, except that a lone t is a time and a lone T a temperature.
Column RecogniseColumn(std::string_view label);

// Makes a column one of another kind, in a unit. nullptr: none is named, V or A, or mA/cm2 of a density.
void Become(ColumnKind kind, const Unit* unit, Column* column);

// Interprets the label of a column that the user has declared a voltage or a current. Only the unit
// is read from the label.
Column ColumnSaidToBe(ColumnKind kind, std::string_view label);

}  // namespace lyrefit
