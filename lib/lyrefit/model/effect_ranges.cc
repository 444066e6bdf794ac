#include "lyrefit/model/effect_ranges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "lyrefit/base/try.h"
#include "lyrefit/model/reporting_units.h"

namespace lyrefit {
namespace {

std::optional<int> FindParameter(const Effect& effect, const std::string& key) {
  for (int k = 0; k < effect.size(); ++k) {
    if (key == effect.parameters[k].symbol || key == effect.parameters[k].name) return k;
  }
  return std::nullopt;
}

std::string SymbolsOf(const Effect& effect) {
  std::string list;
  for (const EffectParameter& info : effect.parameters) {
    list += (list.empty() ? "" : ", ") + std::string(info.symbol);
  }
  return list.empty() ? "none" : list;
}

// Text of a range: "0.3", or "0.2:0.4".
std::string RangeText(const std::pair<double, double>& range) {
  if (range.first == range.second) return fmt::format("{:g}", range.first);
  return fmt::format("{:g}:{:g}", range.first, range.second);
}

// The requested range of parameter k, if any.
std::optional<std::pair<double, double>> RangeOf(const EffectUse& use, int k) {
  const EffectParameter& info = use.effect->parameters[k];
  for (const char* key : {info.symbol, info.name}) {
    if (const auto found = use.ranges.find(key); found != use.ranges.end()) return found->second;
  }
  return std::nullopt;
}

// Internal values: the middle of each requested range, else the neutral value.
std::vector<double> UsualValues(const EffectUse& use, const ReadingScale& scale) {
  std::vector<double> neutral;
  for (const EffectParameter& info : use.effect->parameters) neutral.push_back(info.neutral);
  std::vector<double> reported = ReportedValues(*use.effect, neutral.data(), scale);
  for (int k = 0; k < use.effect->size(); ++k) {
    if (const auto range = RangeOf(use, k)) reported[k] = 0.5 * (range->first + range->second);
  }
  return InternalValues(*use.effect, reported, scale);
}

// Restricts the bounds of a whole-number parameter to whole numbers and sets their distance. A
// fixed parameter keeps its requested value.
Expected<void> KeepWhole(const EffectUse& use, int k, const DataTraits& traits,
                         ParameterBounds* bounds) {
  const EffectParameter& info = use.effect->parameters[k];
  double step = 0;
  if (info.whole == Whole::kCount) step = 1;
  const bool groups = traits.bypass_known && traits.substrings > 1;
  if (info.whole == Whole::kSubstrings && groups) step = 1.0 / traits.substrings;
  if (step == 0 || bounds->lower == bounds->upper) return {};
  constexpr double kSlack = 1e-4;  // of a step: shares are typed with few digits
  const double first = std::ceil(bounds->lower / step - kSlack);
  const double last = std::floor(bounds->upper / step + kSlack);
  if (first > last) {
    return tl::unexpected(Unfit(
        *use.effect,
        fmt::format("{} = {:g}:{:g} holds no whole number of {}: expected a range around {:g}",
                    info.symbol, bounds->lower, bounds->upper,
                    info.whole == Whole::kCount ? std::string("them")
                                                : fmt::format("{} substrings", traits.substrings),
                    first * step)));
  }
  bounds->lower = bounds->search_lower = first * step;
  bounds->upper = bounds->search_upper = last * step;
  if (first < last) bounds->whole = step;
  return {};
}

// Bounds of parameter k: those of the effect, narrowed to a requested range.
Expected<ParameterBounds> BoundsOf(const EffectUse& use, int k, const std::vector<double>& usual,
                                   const ReadingScale& scale, const DataTraits& traits) {
  const Effect& effect = *use.effect;
  const EffectParameter& info = effect.parameters[k];
  double lower = info.lower, upper = info.upper;
  if (const auto range = RangeOf(use, k)) {
    const double a = InternalValue(effect, k, range->first, usual, scale);
    const double b = InternalValue(effect, k, range->second, usual, scale);
    const double slack = 1e-9 * (upper - lower);
    if (!(std::min(a, b) >= lower - slack && std::max(a, b) <= upper + slack)) {
      const double factor = info.ReportedFactor(usual.data(), scale);
      const double p = lower * factor, q = upper * factor;
      return tl::unexpected(Unfit(
          effect,
          fmt::format("{} = {} is outside {:g} to {:g}{}{}", info.symbol, RangeText(*range),
                      std::min(p, q), std::max(p, q), *info.unit != 0 ? " " : "", info.unit)));
    }
    lower = std::max(lower, std::min(a, b));
    upper = std::min(upper, std::max(a, b));
  } else if (info.fixed_by_default) {
    lower = upper = usual[k];
  }
  ParameterBounds bounds{lower, upper, lower, upper, SearchScale::kLinear};
  TRY(KeepWhole(use, k, traits, &bounds));
  return bounds;
}

}  // namespace

Error Unfit(const Effect& effect, const std::string& why) {
  Error error;
  error.message = fmt::format("{}: {}", effect.id, why);
  return error;
}

Expected<void> AddUse(const EffectUse& use, DeviceEffects* device_effects) {
  for (const auto& [key, range] : use.ranges) {
    TRY(CheckParameter(use, key));
    if (range.first <= range.second) continue;
    return tl::unexpected(
        Unfit(*use.effect, fmt::format("{} = {} is reversed", key, RangeText(range))));
  }
  const ReadingScale& scale = device_effects->readings.scale;
  const std::vector<double> usual = UsualValues(use, scale);
  for (int k = 0; k < use.effect->size(); ++k) {
    TRY(const auto bounds, BoundsOf(use, k, usual, scale, device_effects->readings.traits));
    device_effects->bounds.push_back(bounds);
    device_effects->usual.push_back(WithinBounds(bounds, usual[k]));
  }
  return {};
}

Expected<void> CheckParameter(const EffectUse& use, const std::string& key) {
  if (FindParameter(*use.effect, key)) return {};
  return tl::unexpected(Unfit(
      *use.effect, fmt::format("has no parameter '{}', expected {}", key, SymbolsOf(*use.effect))));
}

Expected<void> CheckFitRanges(const DeviceEffects& device_effects) {
  const ReadingScale& scale = device_effects.readings.scale;
  int first = 0;
  for (const EffectUse& use : device_effects.uses) {
    const Effect& effect = *use.effect;
    const auto usual = device_effects.usual.begin() + first;
    const auto bounds = device_effects.bounds.begin() + first;
    first += effect.size();
    for (int k = 0; k < effect.size(); ++k) {
      const auto range = RangeOf(use, k);
      for (int j = 0; range && j < effect.size(); ++j) {
        const auto factor_at = [&](double other) {
          std::vector<double> p(usual, usual + effect.size());
          p[j] = other;
          return effect.parameters[k].ReportedFactor(p.data(), scale);
        };
        if (j == k || factor_at(bounds[j].lower) == factor_at(bounds[j].upper)) continue;
        const char* symbol = effect.parameters[k].symbol;
        const char* other = effect.parameters[j].symbol;
        return tl::unexpected(Unfit(
            effect, fmt::format("a fit can keep to {} = {} only where {}, which {} is measured by, "
                                "is fixed: expected {}={},{}=VALUE, or {} left out",
                                symbol, RangeText(*range), other, symbol, symbol, RangeText(*range),
                                other, symbol)));
      }
    }
  }
  return {};
}

std::string DescribeUse(const EffectUse& use) {
  std::string text = use.effect->id;
  char separator = ':';
  for (const auto& [key, range] : use.ranges) {
    text += separator + key + "=" + RangeText(range);
    separator = ',';
  }
  return text;
}

}  // namespace lyrefit
