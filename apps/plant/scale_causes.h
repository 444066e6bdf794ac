#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"

namespace lyrefit {

// Faults that change the scale of a string and not the shape of its curve.
enum class ScaleCause {
  kNone,  // nothing beyond the errors
  kMissingModule,
  kBypassedSubstring,
  kReversedModule,
  kDisconnectedString,
  kWrongModuleType,
  kExtraModule,
  kCableResistance,
  kUniformSoiling,
  kLightSensor,
  kTemperatureSensor,
  kExchangedStrings,
  kSomethingElse  // more than the errors, and none of the above
};

template <>
struct EnumTable<ScaleCause> {
  static constexpr EnumText<ScaleCause> kRows[] = {
      {ScaleCause::kNone, "none"},
      {ScaleCause::kMissingModule, "missing_module"},
      {ScaleCause::kBypassedSubstring, "bypassed_substring"},
      {ScaleCause::kReversedModule, "reversed_module"},
      {ScaleCause::kDisconnectedString, "disconnected_string"},
      {ScaleCause::kWrongModuleType, "wrong_module_type"},
      {ScaleCause::kExtraModule, "extra_module"},
      {ScaleCause::kCableResistance, "cable_resistance"},
      {ScaleCause::kUniformSoiling, "uniform_soiling"},
      {ScaleCause::kLightSensor, "light_sensor"},
      {ScaleCause::kTemperatureSensor, "temperature_sensor"},
      {ScaleCause::kExchangedStrings, "exchanged_strings"},
      {ScaleCause::kSomethingElse, "something_else"}};
};

// What a table says of a cause.
struct ScaleCauseText {
  ScaleCause cause;
  const char* title;
  const char* about;     // device, conditions (a sensor), plan
  const char* action;    // what to do
  const char* separate;  // the measurement that decides whether it is this one
};
const ScaleCauseText& TextOf(ScaleCause cause);

// What a sentence says of the size of a cause.
struct ScaleSize {
  double size = 0;   // parts of the light, kelvin, ohm, or the part of modules or strings
  double count = 0;  // modules, substrings or strings; 0: not known
  double of = 0;     // of how many; 0: not known
  double isc_percent = 0, voc_percent = 0;  // differences from what is expected
  std::string partner;                      // id of the string that it was exchanged with
};

// A sentence for a technician, with the size. `shared`: the whole combiner has it.
std::string SentenceOf(ScaleCause cause, const ScaleSize& size, bool shared);

}  // namespace lyrefit
