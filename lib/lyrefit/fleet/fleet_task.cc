#include "lyrefit/fleet/fleet_task.h"

#include <cmath>

#include "lyrefit/effects/catalogue.h"

namespace lyrefit {

std::string AboutOf(const std::string& cause) {
  const Effect* const effect = FindEffect(cause);
  return effect == nullptr ? std::string() : ToText(effect->where);
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
