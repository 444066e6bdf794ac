#pragma once

#include <string_view>

// Files that pages embed, from `assets/` and from the build machine. The source is written by
// cmake/EmbedAssets.cmake.
namespace lyrefit {

std::string_view PageStyle();
std::string_view PageScript();
std::string_view TableScript();

// Plotly's basic bundle, gzipped; empty if it was not installed at build time.
std::string_view PackedPlotly();
std::string_view PlotlyLicence();

// Tabulator, gzipped; empty if it was not installed at build time.
std::string_view PackedTabulator();
std::string_view PackedTabulatorStyle();
std::string_view TabulatorLicence();

}  // namespace lyrefit
