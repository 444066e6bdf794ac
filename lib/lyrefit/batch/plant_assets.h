#pragma once

#include <string_view>

namespace lyrefit {

// What lies in assets/, put into the library when it is built.
std::string_view PlantStyle();
std::string_view PlantScript();

}  // namespace lyrefit
