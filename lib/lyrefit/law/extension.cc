#include "lyrefit/law/extension.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lyrefit/law/extended_set.h"
#include "lyrefit/law/quote.h"
#include "lyrefit/law/reading_blocks.h"

namespace lyrefit {
namespace {

// As a fit of one curve has it: at its own irradiance and temperature.
Expected<Readings> ReadingsOf(const IvCurve& curve) {
  auto readings = SetReadings(SetOfOne(curve), curve.conditions.cell_temperature_K);
  if (!readings) return readings;
  double light = 0;
  for (const Reading& r : readings->points) light += r.irradiance;
  light /= static_cast<double>(readings->points.size());
  for (Reading& r : readings->points) r.irradiance = light > 0 ? r.irradiance / light : 1;
  return readings;
}

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

Error Unfit(const Effect& effect, const std::string& why) {
  Error error;
  error.message = fmt::format("{}: {}", effect.id, why);
  return error;
}

// "0.3", or "0.2:0.4".
std::string RangeText(const std::pair<double, double>& range) {
  if (range.first == range.second) return fmt::format("{:g}", range.first);
  return fmt::format("{:g}:{:g}", range.first, range.second);
}

// The range that was asked for parameter k, if one was.
std::optional<std::pair<double, double>> RangeOf(const EffectUse& use, int k) {
  const EffectParameter& info = use.effect->parameters[k];
  for (const char* key : {info.symbol, info.name}) {
    if (const auto found = use.ranges.find(key); found != use.ranges.end()) return found->second;
  }
  return std::nullopt;
}

// The middle of what was asked for, the neutral values where nothing was; in the effect's numbers.
std::vector<double> UsualValues(const EffectUse& use, const ReadingScale& scale) {
  std::vector<double> neutral;
  for (const EffectParameter& info : use.effect->parameters) neutral.push_back(info.neutral);
  std::vector<double> reported = ReportedValues(*use.effect, neutral.data(), scale);
  for (int k = 0; k < use.effect->size(); ++k) {
    if (const auto range = RangeOf(use, k)) reported[k] = 0.5 * (range->first + range->second);
  }
  return InnerValues(*use.effect, reported, scale);
}

// Of a parameter that is a whole number of something: bounds that are, and how far apart such
// numbers lie. One that is held stays as it was asked for.
Expected<void> KeepWhole(const EffectUse& use, int k, const DataTraits& traits,
                         ParameterBounds* bounds) {
  const EffectParameter& info = use.effect->parameters[k];
  double step = 0;
  if (info.whole == Whole::kCount) step = 1;
  if (info.whole == Whole::kSubstrings && traits.substrings > 1) step = 1.0 / traits.substrings;
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

// Bounds of parameter k: the effect's own, narrower where that was asked for.
Expected<ParameterBounds> BoundsOf(const EffectUse& use, int k, const std::vector<double>& usual,
                                   const ReadingScale& scale, const DataTraits& traits) {
  const Effect& effect = *use.effect;
  const EffectParameter& info = effect.parameters[k];
  double lower = info.lower, upper = info.upper;
  if (const auto range = RangeOf(use, k)) {
    const double a = InnerValue(effect, k, range->first, usual, scale);
    const double b = InnerValue(effect, k, range->second, usual, scale);
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
  } else if (info.held) {
    lower = upper = usual[k];
  }
  ParameterBounds bounds{lower, upper, lower, upper, SearchScale::kLinear};
  if (auto fine = KeepWhole(use, k, traits, &bounds); !fine) return tl::unexpected(fine.error());
  return bounds;
}

// One effect's bounds, and where a fit begins.
Expected<void> AddUse(const EffectUse& use, Extension* extension) {
  for (const auto& [key, range] : use.ranges) {
    if (auto known = CheckParameter(use, key); !known) return known;
    if (range.first <= range.second) continue;
    return tl::unexpected(
        Unfit(*use.effect, fmt::format("{} = {} is reversed", key, RangeText(range))));
  }
  const ReadingScale& scale = extension->readings.scale;
  const std::vector<double> usual = UsualValues(use, scale);
  for (int k = 0; k < use.effect->size(); ++k) {
    const auto bounds = BoundsOf(use, k, usual, scale, extension->readings.traits);
    if (!bounds) return tl::unexpected(bounds.error());
    extension->bounds.push_back(*bounds);
    extension->usual.push_back(WithinBounds(*bounds, usual[k]));
  }
  return {};
}

Expected<void> CheckTogether(const std::vector<EffectUse>& uses, int base_size) {
  int size = base_size;
  for (std::size_t a = 0; a < uses.size(); ++a) {
    size += uses[a].effect->size();
    for (std::size_t b = 0; b < a; ++b) {
      if (uses[a].effect == uses[b].effect)
        return tl::unexpected(Unfit(*uses[a].effect, "is there twice"));
      if (Exclude(*uses[a].effect, *uses[b].effect)) {
        return tl::unexpected(
            Unfit(*uses[a].effect, fmt::format("cannot stand beside {}: each divides the cells in "
                                               "its own way",
                                               uses[b].effect->id)));
      }
    }
  }
  if (size > kMostParameters) {
    return Fail(fmt::format("{} parameters are too many for one law, expected {} at most", size,
                            kMostParameters));
  }
  return {};
}

// Shares of cells, named share..., that are held at more than there is.
Expected<void> CheckShares(const Extension& extension) {
  int at = 0;
  for (const EffectUse& use : extension.uses) {
    double least = 0;
    for (const EffectParameter& info : use.effect->parameters) {
      const bool share = std::string(info.name).find("share") != std::string::npos;
      if (share) least += extension.bounds[at].lower;
      ++at;
    }
    if (least > 1 - 1e-9) {
      return tl::unexpected(Unfit(*use.effect, fmt::format("shares of {:g} in all leave no cell "
                                                           "for the rest, expected less than 1",
                                                           least)));
    }
  }
  return {};
}

Expected<void> CheckLayout(const StringLayout& layout, const Conditions& conditions,
                           const std::vector<EffectUse>& uses) {
  if (layout.cells_in_series != conditions.cells_in_series) {
    return Fail(fmt::format("the strings are laid out of {} cells in series, the device has {}",
                            layout.cells_in_series, conditions.cells_in_series));
  }
  for (const EffectUse& use : uses) {
    if (!use.effect->groups) continue;
    return tl::unexpected(Unfit(*use.effect, "divides the cells, which are laid out already"));
  }
  return {};
}

}  // namespace

Expected<void> CheckParameter(const EffectUse& use, const std::string& key) {
  if (FindParameter(*use.effect, key)) return {};
  return tl::unexpected(Unfit(
      *use.effect, fmt::format("has no parameter '{}', expected {}", key, SymbolsOf(*use.effect))));
}

Expected<Device> Extend(const Device& base, Model model, ConstantSet constants,
                        const IvCurve& curve, const std::vector<EffectUse>& uses, bool force,
                        std::shared_ptr<const StringLayout> layout) {
  if (layout != nullptr) {
    if (auto fine = CheckLayout(*layout, curve.conditions, uses); !fine) {
      return tl::unexpected(fine.error());
    }
  }
  auto readings = ReadingsOf(curve);
  if (!readings) return tl::unexpected(readings.error());
  Extension extension;
  extension.readings = std::move(*readings);
  extension.law.natural = true;
  extension.law.model = model;
  extension.law.constants = constants;
  extension.law.layout = std::move(layout);
  return AddEffects(base, std::move(extension), uses, force);
}

Expected<void> CheckFitRanges(const Extension& extension) {
  const ReadingScale& scale = extension.readings.scale;
  int first = 0;
  for (const EffectUse& use : extension.uses) {
    const Effect& effect = *use.effect;
    const auto usual = extension.usual.begin() + first;
    const auto bounds = extension.bounds.begin() + first;
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
                                "is held: expected {}={},{}=VALUE, or {} left out",
                                symbol, RangeText(*range), other, symbol, symbol, RangeText(*range),
                                other, symbol)));
      }
    }
  }
  return {};
}

bool OneOfSeveral(const Extension& extension, int k) {
  int first = 0;
  for (const EffectUse& use : extension.uses) {
    const auto bounds = extension.bounds.begin() + first;
    const int size = use.effect->size();
    first += size;
    if (k >= first) continue;
    return std::count_if(bounds, bounds + size,
                         [](const ParameterBounds& b) { return b.lower < b.upper; }) > 1;
  }
  return false;
}

Expected<Device> AddEffects(const Device& base, Extension extension,
                            const std::vector<EffectUse>& uses, bool force) {
  if (auto fine = CheckTogether(uses, base.size()); !fine) return tl::unexpected(fine.error());
  extension.blocks = BlocksOf(extension.readings);
  extension.uses = uses;
  for (const EffectUse& use : uses) {
    const Effect& effect = *use.effect;
    if (effect.parameters.empty()) {
      return tl::unexpected(
          Unfit(effect, "has no parameters: it is found in the values, not fitted"));
    }
    const auto why_not = effect.WhyNot(extension.readings.traits);
    if (why_not && !force) {
      return tl::unexpected(Unfit(effect, *why_not + " (--force fits it all the same)"));
    }
    extension.law.effects.push_back(&effect);
    if (auto added = AddUse(use, &extension); !added) return tl::unexpected(added.error());
  }
  if (auto fine = CheckShares(extension); !fine) return tl::unexpected(fine.error());
  Device device = base;
  AddInfos(uses, &device.parameters);
  device.extension = std::make_shared<const Extension>(std::move(extension));
  return device;
}

void AddInfos(const std::vector<EffectUse>& uses, std::vector<ParameterInfo>* infos) {
  for (const EffectUse& use : uses) {
    for (const EffectParameter& info : use.effect->parameters) {
      infos->push_back({fmt::format("{}.{}", use.effect->id, info.symbol),
                        fmt::format("{}_{}", use.effect->id, info.name), info.unit, info.doc,
                        ParameterKind::kPlain, 0.1 * (info.upper - info.lower)});
    }
  }
}

std::vector<std::vector<double>> EffectStarts(const Extension& extension) {
  const int base = extension.law.base_size();
  std::vector<std::vector<double>> probes = {extension.usual};
  for (std::size_t e = 0; e < extension.uses.size(); ++e) {
    const Effect& effect = *extension.uses[e].effect;
    if (effect.probes == nullptr) continue;
    const int first = extension.law.Offset(static_cast<int>(e)) - base;
    for (const Probe& probe : effect.probes(extension.readings.traits)) {
      std::vector<double> p = extension.usual;
      for (int k = 0; k < effect.size(); ++k) {
        const ParameterBounds& bounds = extension.bounds[first + k];
        p[first + k] = std::min(std::max(probe[k], bounds.lower), bounds.upper);
      }
      probes.push_back(p);
    }
  }
  return probes;
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

namespace {

bool InAmpere(const Law& law, const Readings& readings, const std::vector<ReadingBlock>& blocks,
              const double* p, double* current_A, double* jacobian) {
  LawWorkspace workspace(blocks);
  if (!EvaluateLaw(law, readings, p, &workspace, current_A, jacobian)) return false;
  const std::size_t count = readings.points.size();
  for (std::size_t k = 0; k < count; ++k) current_A[k] *= readings.scale.current_A;
  for (std::size_t k = 0; jacobian != nullptr && k < count * law.size(); ++k) {
    jacobian[k] *= readings.scale.current_A;
  }
  return true;
}

// The same measurement at other voltages.
Readings AtVoltages(const Readings& readings, const std::vector<double>& voltage_V) {
  Readings other = readings;
  const Reading usual = readings.points.front();
  double light = 0;
  for (const Reading& r : readings.points) light += r.irradiance;
  light /= static_cast<double>(readings.points.size());
  const int count = static_cast<int>(voltage_V.size());
  other.points.assign(count, usual);
  for (int k = 0; k < count; ++k) {
    Reading& r = other.points[k];
    r.voltage = voltage_V[k] / readings.scale.cells;
    r.irradiance = light;
    r.x = count > 1 ? static_cast<double>(k) / (count - 1) - 0.5 : 0;
    const bool rises = k > 0 ? voltage_V[k] >= voltage_V[k - 1] : true;
    r.rate = rises ? 1 : -1;
    r.current = 0;
  }
  return other;
}

}  // namespace

bool ExtendedCurrents(const Device& device, const double* p, double* current_A, double* jacobian) {
  const Extension& extension = *device.extension;
  return InAmpere(extension.law, extension.readings, extension.blocks, p, current_A, jacobian);
}

std::vector<double> ExtendedCurrents(const Device& device, const double* p,
                                     const std::vector<double>& voltage_V) {
  const Extension& extension = *device.extension;
  const Readings readings = AtVoltages(extension.readings, voltage_V);
  std::vector<double> current_A(voltage_V.size());
  if (!InAmpere(extension.law, readings, BlocksOf(readings), p, current_A.data(), nullptr)) {
    std::fill(current_A.begin(), current_A.end(), std::numeric_limits<double>::quiet_NaN());
  }
  return current_A;
}

}  // namespace lyrefit
