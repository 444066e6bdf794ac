#include "lyrefit/batch/batch_task.h"

#include <charconv>
#include <cmath>

namespace lyrefit {

std::optional<double> RatedPowerBeside(const BatchCurve& curve) {
  const auto beside = curve.beside.find("rated_power_W");
  if (beside == curve.beside.end()) return std::nullopt;
  double value = 0;
  const char* const end = beside->second.data() + beside->second.size();
  const auto read = std::from_chars(beside->second.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return value;
}

ResultCell NumberCell(double value) {
  return std::isfinite(value) ? ResultCell(value) : ResultCell();
}

ResultCell TextCell(const std::string& text) {
  return text.empty() ? ResultCell() : ResultCell(text);
}

ResultCell ListCell(const std::vector<std::string>& texts, const char* separator) {
  std::string joined;
  for (const std::string& text : texts) joined += (joined.empty() ? "" : separator) + text;
  return TextCell(joined);
}

}  // namespace lyrefit
