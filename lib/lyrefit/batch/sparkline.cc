#include "lyrefit/batch/sparkline.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

namespace lyrefit {
namespace {

constexpr std::string_view kLetters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
static_assert(kSparklinePoints % 3 == 0, "three bytes are four letters, without padding");

std::vector<double> EvenCurrents(const std::vector<std::pair<double, double>>& readings,
                                 double last_V) {
  std::vector<double> currents;
  for (int i = 0; i < kSparklinePoints; ++i) {
    const double v = last_V * i / (kSparklinePoints - 1);
    auto above = std::lower_bound(readings.begin(), readings.end(), std::make_pair(v, -HUGE_VAL));
    if (above == readings.end()) --above;
    if (above == readings.begin()) {
      currents.push_back(above->second);
      continue;
    }
    const auto below = above - 1;
    const double width = above->first - below->first;
    const double part = width > 0 ? std::min((v - below->first) / width, 1.0) : 1;
    currents.push_back(below->second + part * (above->second - below->second));
  }
  return currents;
}

}  // namespace

std::string Sparkline(const std::vector<double>& voltage_V, const std::vector<double>& current_A,
                      double open_circuit_voltage_V) {
  std::vector<std::pair<double, double>> readings;
  for (std::size_t i = 0; i < voltage_V.size(); ++i) {
    readings.emplace_back(voltage_V[i], current_A[i]);
  }
  std::sort(readings.begin(), readings.end());
  if (readings.empty()) return {};
  const bool known = open_circuit_voltage_V > 0;
  const double last_V = known ? open_circuit_voltage_V : readings.back().first;
  const std::vector<double> currents = EvenCurrents(readings, last_V);
  const double largest = *std::max_element(currents.begin(), currents.end());
  if (!(largest > 0) || !(last_V > 0)) return {};
  std::string text;
  for (int i = 0; i < kSparklinePoints; i += 3) {
    std::uint32_t bits = 0;
    for (int k = 0; k < 3; ++k) {
      const double part = std::max(currents[i + k] / largest, 0.0);
      bits = bits << 8 | static_cast<std::uint32_t>(std::lround(255 * part));
    }
    for (int shift = 18; shift >= 0; shift -= 6) text += kLetters[bits >> shift & 63];
  }
  return text;
}

std::vector<double> ReadSparkline(const std::string& text) {
  if (text.size() != kSparklinePoints / 3 * 4) return {};
  std::vector<double> parts;
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t letter = kLetters.find(text[i + k]);
      if (letter == std::string_view::npos) return {};
      bits = bits << 6 | static_cast<std::uint32_t>(letter);
    }
    for (int shift = 16; shift >= 0; shift -= 8) parts.push_back((bits >> shift & 255) / 255.0);
  }
  return parts;
}

}  // namespace lyrefit
