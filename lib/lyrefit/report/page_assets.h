#pragma once

#include <string_view>

// What every page embeds, from `assets/` and from what the build found installed: written by
// cmake/EmbedPageAssets.cmake.
namespace lyrefit {

std::string_view PageStyle();
std::string_view PageScript();

// Plotly's basic bundle, gzip; empty where it was not installed when this was built.
std::string_view PackedPlotly();
std::string_view PlotlyLicence();

}  // namespace lyrefit
