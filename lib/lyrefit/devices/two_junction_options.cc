#include "lyrefit/devices/two_junction_options.h"

#include <fmt/format.h>

#include <optional>

#include "lyrefit/base/number_text.h"

namespace lyrefit {

Expected<std::pair<std::string, StatedLight>> ReadStatedLight(const std::string& text) {
  const auto misread = [&] {
    return Fail("expected CURVE=TOP:BOTTOM such as red=1:0.9 or red=1:?, found '" + text + "'");
  };
  const std::size_t equals = text.rfind('='), colon = text.rfind(':');
  if (equals == std::string::npos || equals == 0 || colon == std::string::npos || colon < equals) {
    return misread();
  }
  StatedLight light;
  double* const shares[] = {&light.top, &light.bottom};
  const std::string parts[] = {text.substr(equals + 1, colon - equals - 1), text.substr(colon + 1)};
  for (int j = 0; j < 2; ++j) {
    if (parts[j] == "?") continue;
    const std::optional<double> share = ParseNumber(parts[j]);
    if (!share) return misread();
    *shares[j] = *share;
  }
  return std::pair(text.substr(0, equals), light);
}

Expected<void> ReadLightAccuracy(const std::string& text, TwoJunctionOptions* options,
                                 const TextReaders&) {
  constexpr double kWorst_percent = 50;
  const bool sign = !text.empty() && text.back() == '%';
  const std::optional<double> percent = ParseNumber(sign ? text.substr(0, text.size() - 1) : text);
  if (!percent || !(*percent >= 0 && *percent <= kWorst_percent)) {
    return Fail(fmt::format("expected percent from 0 to {}, such as 2 or 2%, found '{}'",
                            kWorst_percent, text));
  }
  options->light_accuracy = *percent / 100;
  return {};
}

std::string StatedLightText(const std::string& curve, const StatedLight& light) {
  const auto share = [](double value) {
    return std::isnan(value) ? std::string("?") : fmt::format("{:g}", value);
  };
  return fmt::format("{}={}:{}", curve, share(light.top), share(light.bottom));
}

}  // namespace lyrefit
