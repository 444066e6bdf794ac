#pragma once

#include <string_view>

namespace lyrefit {

// The content of assets/, embedded in the library at build time.
std::string_view PlantStyle();
std::string_view PlantScript();

}  // namespace lyrefit
