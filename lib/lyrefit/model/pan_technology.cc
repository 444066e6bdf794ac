#include "lyrefit/model/pan_technology.h"

#include "lyrefit/base/number_text.h"

namespace lyrefit {

std::optional<PanTechnology> FindPanTechnology(const std::string& text) {
  const std::string lower = LowerCase(text);
  for (const PanTechnology& one : kPanTechnologies) {
    if (lower.find(one.word) != std::string::npos) return one;
  }
  return std::nullopt;
}

}  // namespace lyrefit
