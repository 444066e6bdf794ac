#include "lyrefit/effects/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "lyrefit/curve/technology.h"

namespace lyrefit {

WhyNot NeedsLight(const DataTraits& traits) {
  if (traits.only_dark) return "needs a lit curve";
  return {};
}

WhyNot NeedsOneLitCondition(const DataTraits& traits) {
  if (auto why = NeedsLight(traits)) return why;
  if (!traits.single) return "acts during one sweep; each curve of a set has its own";
  return {};
}

WhyNot NeedsModule(const DataTraits& traits) {
  if (auto why = NeedsOneLitCondition(traits)) return why;
  if (!traits.module) return "needs cells in series";
  return {};
}

WhyNot NeedsManyCells(const DataTraits& traits) {
  constexpr int kLeast = 6;
  if (auto why = NeedsModule(traits)) return why;
  if (traits.cells < kLeast) return "needs six cells in series or more";
  return {};
}

WhyNot NeedsBypassedModule(const DataTraits& traits) {
  const bool stated = traits.bypass_known && traits.substrings > 0;
  if (auto why = stated ? NeedsModule(traits) : NeedsManyCells(traits)) return why;
  if (traits.lowest_voltage < -1) {
    return "bypass diodes let no module so far into reverse: these cells have none";
  }
  return {};
}

WhyNot NeedsBypassDiodes(const DataTraits& traits) {
  if (auto why = NeedsModule(traits)) return why;
  if (traits.bypass_known && traits.substrings == 0) return "needs bypass diodes";
  return {};
}

WhyNot NeedsUpDown(const DataTraits& traits) {
  if (!traits.up_down) return "needs a sweep up and a sweep down";
  return {};
}

WhyNot NeedsLightLevels(const DataTraits& traits) {
  if (traits.dark || traits.irradiance_levels > 1) return {};
  return "needs a second level of light, or a dark curve";
}

WhyNot NeedsIrradiances(const DataTraits& traits) {
  if (traits.irradiance_levels < 2) return "needs curves under several irradiances";
  return {};
}

WhyNot NeedsTemperatures(const DataTraits& traits) {
  if (traits.temperature_levels < 2) return "needs curves at several temperatures";
  return {};
}

bool InFlasher(const Circumstances& at) { return at.setup == Setup::kFlash; }
bool InInverter(const Circumstances& at) { return at.setup == Setup::kInverter; }
bool SlowOutdoors(const Circumstances& at) { return at.setup == Setup::kOutdoor && at.slow; }
bool ModuleInLaboratory(const Circumstances& at) {
  return at.setup == Setup::kLaboratory && at.module;
}
bool AsNew(const Circumstances& at) { return at.age_years && *at.age_years < 1; }
bool OfOldAge(const Circumstances& at) { return at.age_years && *at.age_years > 10; }
bool OfThinFilm(const Circumstances& at) { return at.module && IsThinFilm(at.technology); }
bool Heterojunction(const Circumstances& at) {
  const Technology* const known = FindTechnology(at.technology);
  return known != nullptr && known->name == std::string_view("HJT");
}

std::vector<Probe> Strengths(const std::vector<double>& values) {
  std::vector<Probe> probes;
  probes.reserve(values.size());
  for (const double value : values) probes.push_back({value});
  return probes;
}

Sized Scaled(const Sized& size, double factor) {
  return {factor * size.value, factor * size.low_95, factor * size.high_95};
}

std::string PercentWithRange(const Sized& part, int digits) {
  const auto text = [digits](double value) { return fmt::format("{:.{}f}", 100 * value, digits); };
  const std::string value = text(part.value), low = text(part.low_95), high = text(part.high_95);
  if (!std::isfinite(part.low_95) || low == high) return value + " %";
  return fmt::format("{} % ({} to {})", value, low, high);
}

std::string LightLeft(double deficit, const Sized& reported, double factor) {
  const double low = 1 - factor * reported.high_95, high = 1 - factor * reported.low_95;
  return PercentWithRange({1 - factor * deficit, std::max(low, 0.0), std::min(high, 1.0)}, 0);
}

std::string PartOfCells(const Readings& readings, double share) {
  const int known = readings.traits.substrings;
  const int substrings = known > 0 ? known : 3;
  const double count = share * substrings;
  const double whole = std::round(count);
  constexpr double kNear = 0.12;  // of a substring
  if (whole < 1 || std::fabs(count - whole) > std::min(0.03 * substrings, kNear)) {
    return fmt::format("{:.0f} % of the cells", 100 * share);
  }
  return fmt::format("{:.0f} of {} substrings", whole, substrings);
}

std::string CoveredPart(double part) {
  return part < 1 ? fmt::format(", on {:.0f} % of its cells", 100 * part) : "";
}

std::string PlainDigits(double value) {
  return fmt::format(std::fabs(value) < 999.5 ? "{:.3g}" : "{:.0f}", value);
}

std::string WithUnit(const Sized& size, const char* unit) {
  const std::string range =
      std::isfinite(size.low_95)
          ? fmt::format(" ({} to {})", PlainDigits(std::min(size.low_95, size.high_95)),
                        PlainDigits(std::max(size.low_95, size.high_95)))
          : "";
  return fmt::format("{} {}{}", PlainDigits(size.value), unit, range);
}

std::string SignedSize(const Sized& size, const char* unit, const char* above, const char* below) {
  const bool negative = size.value < 0;
  return WithUnit(Scaled(size, negative ? -1 : 1), unit) + " " + (negative ? below : above);
}

std::string AmpereText(double value) {
  const double size = std::fabs(value);
  if (size < 1e-3) return PlainDigits(1e6 * value) + " uA";
  return size < 0.1 ? PlainDigits(1e3 * value) + " mA" : fmt::format("{:.4g} A", value);
}

std::string LightChange(const Sized& part, double limit, const char* than) {
  if (part.low_95 <= 0 && part.high_95 >= 0) {
    return fmt::format("was stronger or weaker{}: these readings determine neither size nor sign",
                       than);
  }
  const bool weaker = part.value < 0;
  const Sized size = weaker ? Sized{-part.value, -part.high_95, -part.low_95} : part;
  const std::string text = size.high_95 >= limit
                               ? fmt::format("at least {:.1f} %", 100 * size.low_95)
                               : PercentWithRange(size, 1);
  return fmt::format("was {} {}{}", text, weaker ? "weaker" : "stronger", than);
}

double VoltageAt(const FittedEffect& of, const Reading& reading) {
  return reading.voltage * of.readings.scale.cells;
}

double VoltageAtMoment(const FittedEffect& of) {
  const std::vector<Reading>& points = of.readings.points;
  const auto nearest =
      std::min_element(points.begin(), points.end(), [&of](const Reading& a, const Reading& b) {
        return std::fabs(a.x - of.p[1]) < std::fabs(b.x - of.p[1]);
      });
  return VoltageAt(of, *nearest);
}

}  // namespace lyrefit
