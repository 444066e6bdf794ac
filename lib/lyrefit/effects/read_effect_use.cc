#include "lyrefit/effects/read_effect_use.h"

#include "lyrefit/base/setting_text.h"
#include "lyrefit/base/try.h"
#include "lyrefit/effects/catalogue.h"

namespace lyrefit {

Expected<EffectUse> ReadEffectUse(const std::string& text) {
  const std::size_t colon = text.find(':');
  EffectUse use;
  use.effect = FindEffect(text.substr(0, colon));
  if (use.effect == nullptr) {
    return Fail("there is no effect '" + text.substr(0, colon) +
                "'; lyrefit diagnose --explain lists them");
  }
  for (std::size_t at = colon; at != std::string::npos;) {
    const std::size_t next = text.find(',', at + 1);
    const std::string item = text.substr(at + 1, next - at - 1);
    if (item.find(':') != std::string::npos) {
      TRY(const auto range, ReadRange(item));
      use.ranges[range.first] = range.second;
    } else {
      TRY(const auto assignment, ReadAssignment(item));
      use.ranges[assignment.first] = {assignment.second, assignment.second};
    }
    at = next;
  }
  return use;
}

}  // namespace lyrefit
