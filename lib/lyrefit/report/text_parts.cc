#include "lyrefit/report/text_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/report/text_layout.h"

namespace lyrefit {

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

std::string Plural(std::size_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string CurveFields(const IvCurve& curve) {
  std::string text = curve.name;
  if (curve.size() > 0) {
    const auto [low, high] = std::minmax_element(curve.voltage_V.begin(), curve.voltage_V.end());
    text += fmt::format(", {} points from {:.6g} to {:.6g} V", curve.size(), *low, *high);
  }
  if (!curve.source.empty()) text += fmt::format(" ({})", curve.source);
  const Conditions& c = curve.conditions;
  const std::string conditions =
      fmt::format("{:.6g} C, {:.6g} W/m2, {} in series, {} in parallel",
                  c.cell_temperature_K - kZeroCelsius_K, c.irradiance_W_m2,
                  Plural(c.cells_in_series, "cell"), Plural(c.strings_in_parallel, "string"));
  return Field("curve", text) + Field("conditions", conditions);
}

// A proved bound, which must not be rounded up.
std::string BoundText(double bound) {
  if (!(bound > 0)) return "0";
  const double unit = std::pow(10, std::floor(std::log10(bound)) - (10 - 1));
  return Scientific(std::floor(bound / unit) * unit, 10);
}

std::string List(const std::string& title, const std::vector<std::string>& sentences) {
  if (sentences.empty()) return "";
  std::string text = title + "\n";
  for (const std::string& sentence : sentences) text += Wrap("  - ", sentence);
  return text;
}

}  // namespace lyrefit
