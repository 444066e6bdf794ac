#pragma once

#include <string_view>

// Files that every page embeds, from `assets/` and from the build machine. The source is written by
// cmake/EmbedPageAssets.cmake.
namespace lyrefit {

std::string_view PageStyle();
std::string_view PageScript();

// Plotly's basic bundle, gzipped; empty if it was not installed at build time.
std::string_view PackedPlotly();
std::string_view PlotlyLicence();

}  // namespace lyrefit
