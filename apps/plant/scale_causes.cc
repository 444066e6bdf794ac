#include "plant/scale_causes.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>

namespace lyrefit {
namespace {

constexpr ScaleCauseText kTexts[] = {
    {ScaleCause::kMissingModule, "Module missing or shorted", "device",
     "count the modules of the string and measure the voltage of each; replace the one without",
     "count the modules in the string, and measure the voltage of each"},
    {ScaleCause::kBypassedSubstring, "Substring bypassed", "device",
     "look for the module with a cold or a warm third in a thermal picture; replace its bypass "
     "diode or the module",
     "a thermal picture of the string under load, or the voltage of each module"},
    {ScaleCause::kReversedModule, "Module in reverse", "device",
     "measure the polarity of each module and turn the one in reverse; it heats under load",
     "the polarity of each module at its connectors"},
    {ScaleCause::kDisconnectedString, "Parallel string disconnected", "device",
     "measure the current of each parallel string with a clamp; check fuses and connectors of the "
     "one without",
     "the current of each parallel string with a clamp"},
    {ScaleCause::kWrongModuleType, "Modules of another type", "plan",
     "read the labels of the modules and correct the plan, or exchange them",
     "the labels of the modules"},
    {ScaleCause::kExtraModule, "More modules than planned", "plan",
     "count the modules of the string and check the highest voltage of the inverter; correct the "
     "plan",
     "count the modules in the string"},
    {ScaleCause::kCableResistance, "Resistance of a connector or cable", "device",
     "look for a hot connector or clamp in a thermal picture under load; renew it",
     "the voltage drop along the connectors under load, or a thermal picture of them"},
    {ScaleCause::kUniformSoiling, "Soiling of all modules alike", "device",
     "wash the string and take its curve again", "wash the string and take its curve again"},
    {ScaleCause::kLightSensor, "Error of the light sensor", "conditions",
     "check the light sensor: its plane, its glass, its calibration; take the curve again",
     "a second light sensor in the plane of the modules"},
    {ScaleCause::kTemperatureSensor, "Error of the temperature sensor", "conditions",
     "check that the temperature sensor sits on the back of a module of this string; take the "
     "curve "
     "again",
     "a second thermometer on the back of a module in the middle of the string"},
    {ScaleCause::kExchangedStrings, "Strings exchanged", "plan",
     "follow the cables of both strings and exchange their labels",
     "follow the cable, or cover a module of one string and see which changes"},
};

std::string CountText(double count, const char* what) {
  const auto whole = std::lround(count);
  return fmt::format("{} {}{}", whole, what, whole == 1 ? "" : "s");
}

std::string OfText(const ScaleSize& size, const char* what) {
  if (size.count > 0 && size.of > 0) {
    return fmt::format("{} of {:.0f}", CountText(size.count, what), size.of);
  }
  return fmt::format("{:.1f} % of the {}s", 100 * size.size, what);
}

std::string LightText(const ScaleSize& size) {
  return fmt::format("{:.1f} % {} current than at the stated light", 100 * std::fabs(size.size),
                     size.size < 0 ? "less" : "more");
}

}  // namespace

const ScaleCauseText& TextOf(ScaleCause cause) {
  const auto* const found = std::find_if(std::begin(kTexts), std::end(kTexts),
                                         [&](const auto& text) { return text.cause == cause; });
  CHECK(found != std::end(kTexts));
  return *found;
}

std::string SentenceOf(ScaleCause cause, const ScaleSize& size, bool shared) {
  const std::string who = shared ? "All strings of the combiner" : "The string";
  const char* const verb = shared ? "have" : "has";
  const char* const of = shared ? "their" : "its";
  switch (cause) {
    case ScaleCause::kNone:
      return "";
    case ScaleCause::kMissingModule:
      return fmt::format("{} {} the voltage of {} too few: missing, or shorted as a whole", who,
                         verb, OfText(size, "module"));
    case ScaleCause::kBypassedSubstring:
      return fmt::format("{} {} the voltage of {} too few, and {} curve is unchanged otherwise",
                         who, verb, OfText(size, "substring"), of);
    case ScaleCause::kReversedModule:
      return fmt::format("{} {} the voltage of {} against the others", who, verb,
                         OfText(size, "module"));
    case ScaleCause::kDisconnectedString:
      return fmt::format("{} {} no current of {}", who, verb, OfText(size, "parallel string"));
    case ScaleCause::kWrongModuleType:
      return fmt::format(
          "{} {} {:+.1f} % Isc and {:+.1f} % Voc, which no count of the planned modules gives", who,
          verb, size.isc_percent, size.voc_percent);
    case ScaleCause::kExtraModule:
      return fmt::format("{} {} the voltage of {} too many", who, verb, OfText(size, "module"));
    case ScaleCause::kCableResistance:
      return fmt::format("{} {} {:.2g} ohm more in series than expected", who, verb, size.size);
    case ScaleCause::kUniformSoiling:
      return fmt::format("{} {} {}, as under dirt on every module alike", who,
                         shared ? "give" : "gives", LightText(size));
    case ScaleCause::kLightSensor:
      return fmt::format("{} {} {}, as with a sensor that reads {}", who, shared ? "give" : "gives",
                         LightText(size), size.size < 0 ? "high" : "low");
    case ScaleCause::kTemperatureSensor:
      return fmt::format("{} {} {:.0f} K {} than the stated temperature", who,
                         shared ? "are" : "is", std::fabs(size.size),
                         size.size > 0 ? "warmer" : "colder");
    case ScaleCause::kExchangedStrings:
      return fmt::format("{} fits the plan of {}, and that one fits {} plan", who, size.partner,
                         of);
    case ScaleCause::kSomethingElse:
      return fmt::format(
          "{} {} {:+.1f} % Isc and {:+.1f} % Voc, beyond the errors, and no cause of the scale "
          "explains the curve{}",
          who, verb, size.isc_percent, size.voc_percent,
          size.isc_percent < 0 && size.voc_percent < 0
              ? ": polarisation (PID-p) or degradation of all cells takes both, dirt the current "
                "alone"
              : "");
  }
  return "";
}

}  // namespace lyrefit
