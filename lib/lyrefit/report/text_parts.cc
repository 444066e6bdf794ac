#include "lyrefit/report/text_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/curve/curve_kind.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

std::string DoubtText(const std::string& doubt) {
  return "DOUBTFUL: " + doubt + (doubt.back() == '?' ? "" : ".");
}

}  // namespace

std::string ModelTitle(Model model) {
  switch (model) {
    case Model::kSingleDiode:
      return "single-diode";
    case Model::kDoubleDiode:
      return "double-diode";
    case Model::kTripleDiode:
      return "triple-diode";
  }
  return "?";
}

std::string EffectTitles(const std::vector<EffectUse>& uses) {
  std::string text;
  for (const EffectUse& use : uses) {
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", use.effect->title, use.effect->id);
  }
  return text;
}

std::string PlusEffects(const std::vector<EffectUse>& uses) {
  std::string text;
  for (const EffectUse& use : uses) text += fmt::format(" + {}", use.effect->id);
  return text;
}

std::vector<EffectUse> EffectsOf(const Device& device) {
  return device.effects == nullptr ? std::vector<EffectUse>() : device.effects->uses;
}

std::string FullSentence(std::string text) {
  if (!text.empty() && text.back() != '.') text += '.';
  return text;
}

std::string BoundText(double bound) {
  if (!(bound > 0)) return "0";
  const double unit = std::pow(10, std::floor(std::log10(bound)) - (10 - 1));
  return Scientific(std::floor(bound / unit) * unit, 10);
}

std::vector<std::string> Banners(bool interrupted, bool usable, const std::string& because,
                                 const std::vector<std::string>& doubts) {
  std::vector<std::string> banners;
  if (!usable && !because.empty()) banners.push_back("NOT USABLE: " + because + ".");
  if (interrupted) {
    banners.push_back("INTERRUPTED: the best found so far; with more time the result may differ.");
  }
  if (!usable && because.empty()) {
    banners.push_back("NOT USABLE: do not work with these values; see the warnings.");
  }
  for (const std::string& doubt : doubts) banners.push_back(DoubtText(doubt));
  return banners;
}

std::string BriefMarks(bool interrupted, bool usable, std::size_t warnings,
                       const std::string& because) {
  std::string text;
  if (interrupted) text += ", INTERRUPTED";
  if (!usable) text += ", NOT USABLE" + (because.empty() ? "" : ": " + because);
  if (warnings > 0) text += fmt::format(", {}", Plural(warnings, "warning"));
  return text;
}

std::string LabelWithUnit(const ParameterInfo& info) {
  return info.unit.empty() ? info.symbol : fmt::format("{} ({})", info.symbol, info.unit);
}

std::string EstimateMarks(const Estimate& estimate) {
  if (estimate.fixed) return "fixed";
  if (estimate.bounds.whole > 0) return "whole number, by trying";
  std::string marks;
  if (estimate.at_bound != BoundSide::kNone) {
    marks = fmt::format("{} bound", ToText(estimate.at_bound));
  }
  if (!estimate.identifiable)
    marks += (marks.empty() ? "" : ", ") + std::string("not identifiable");
  return marks;
}

std::string CorrelationsText(const std::vector<Correlation>& correlations) {
  std::string text;
  for (const Correlation& c : correlations) {
    text += fmt::format("{}{}-{} {:+.4f}", text.empty() ? "" : ", ", c.first, c.second, c.value);
  }
  return text;
}

std::string SearchText(const SearchOptions& options, const SearchSummary& search,
                       std::int64_t curve_evaluations) {
  std::string of_curve;
  if (curve_evaluations != search.evaluations) {
    of_curve = fmt::format(" ({} of the curve)", curve_evaluations);
  }
  std::string text = fmt::format(
      "{}: {}, seed {}, {} candidates x {} iterations, {} evaluations{}; ended by: {}",
      Duration(search.seconds), ToText(options.algorithm), options.seed, options.population,
      search.iterations, search.evaluations, of_curve, ToText(search.termination));
  if (search.termination != SearchTermination::kIterations && !search.message.empty()) {
    text += fmt::format(" ({})", search.message);
  }
  return text;
}

std::string OptionsText(const std::vector<OptionEcho>& options) {
  if (options.empty()) return "all at their defaults";
  std::string text;
  for (const OptionEcho& echo : options) {
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", echo.name, echo.value);
    if (!echo.default_value.empty()) text += fmt::format(" (default {})", echo.default_value);
  }
  return text;
}

void AddCurve(const IvCurve& curve, Section* section) {
  std::string text = curve.name;
  if (curve.size() > 0) {
    const auto [low, high] = std::minmax_element(curve.voltage_V.begin(), curve.voltage_V.end());
    text += fmt::format(", {} points from {:.6g} to {:.6g} V", curve.size(), *low, *high);
  }
  if (!curve.source.empty()) text += fmt::format(" ({})", curve.source);
  const std::string kind = curve.size() > 0 ? KindOf(curve).words : "";
  if (!kind.empty()) text += "; " + kind;
  const Conditions& c = curve.conditions;
  const std::string conditions =
      fmt::format("{:.6g} C, {:.6g} W/m2, {} in series, {} in parallel",
                  c.cell_temperature_K - kZeroCelsius_K, c.irradiance_W_m2,
                  Plural(c.cells_in_series, "cell"), Plural(c.strings_in_parallel, "string"));
  AddField("curve", text, section);
  AddField("conditions", conditions, section);
}

void AddErrorSizes(const ErrorReport& errors, bool dark, Section* section) {
  const char* found = errors.stated ? "stated" : "found";
  const auto add = [section](const char* name, const std::string& size, const char* how,
                             const char* meaning) {
    AddField(name, fmt::format("{} ({}): {}", size, how, meaning), section);
  };
  add("current noise", Significant(errors.sizes.current_A, 2) + " A",
      errors.current_stated ? "stated" : found, "every current by itself");
  if (errors.sizes.current_part > 0) {
    add("in proportion", Significant(100 * errors.sizes.current_part, 2) + " % of each current",
        found, "every current by itself");
  }
  add("voltage noise", Significant(errors.sizes.voltage_V, 2) + " V", found,
      dark ? "of the junction's voltage, or what changes each current by an equal part"
           : "of a voltage near Voc, which shows where the curve is steep");
  if (!(errors.sizes.path > 0)) return;
  add("path", Significant(100 * errors.sizes.path, 2) + (dark ? " % of each current" : " % of Isc"),
      found,
      dark ? "what neighbours share: the device's own departure from the model"
           : "what neighbours share: light that wanders during the sweep, or the device's own "
             "departure from the model");
  const double length_percent = 100 * errors.sizes.length;
  add("path length",
      Significant(length_percent, length_percent < 99.5 ? 2 : 3) +
          (dark ? " % of the largest voltage" : " % of Voc"),
      found, "how far along the sweep they share it");
}

std::string WhatScatters(const ErrorReport& errors, bool dark) {
  if (dark) return "readings of large currents scatter more, in proportion to them";
  // The two shapes are told apart only where one is much larger.
  constexpr double kMuch = 3;
  if (errors.voltage_effect_A > kMuch * errors.part_effect_A) {
    return "readings near Voc scatter more, as noise of the voltage does";
  }
  if (errors.part_effect_A > kMuch * errors.voltage_effect_A) {
    return "readings of large currents scatter more, in proportion to them";
  }
  return "readings scatter more in some parts of the curve than in others";
}

std::string ErrorTests(const ErrorReport& errors, bool dark) {
  if (errors.weighed) {
    return "The fit is weighed by these errors and its intervals hold under them.";
  }
  std::string text = "Twice the gain in ln likelihood: ";
  if (std::isfinite(errors.path_gain)) {
    text +=
        fmt::format("{} of a path that neighbours share over independent errors of three sizes, ",
                    Significant(errors.path_gain, 3));
  }
  text += fmt::format("{} of these errors over independent ones of one size.",
                      Significant(errors.gain, 3));
  switch (errors.Taken()) {
    case ErrorsTaken::kEqual:
      return text + " The intervals take errors for independent and of one size.";
    case ErrorsTaken::kUnequal:
      return text + fmt::format(" The intervals take errors for independent: {}.",
                                WhatScatters(errors, dark));
    case ErrorsTaken::kPath:
      return text + " The intervals allow for errors that neighbours share.";
  }
  return text;
}

void AddUnidentifiable(const std::vector<Estimate>& estimates, Section* section) {
  for (const Estimate& e : estimates) {
    if (e.identifiable || e.reason.empty()) continue;
    AddSentence(fmt::format("{} is not identifiable: {}", e.info.symbol, e.reason), section);
  }
}

}  // namespace lyrefit
