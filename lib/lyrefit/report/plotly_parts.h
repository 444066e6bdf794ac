#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lyrefit/report/figure.h"
#include "lyrefit/report/figure_parts.h"

// plotly_traces.cc: what a panel shows, as Plotly's traces.
namespace lyrefit {

// What Plotly calls the axes of a panel: "x2", "y2", and "y5" for the one on its right.
struct PlotlyAxes {
  std::string x;
  std::string y;
  std::string right;
};

// Plain text as Plotly reads it, which takes some of HTML for its own.
std::string PlotlyText(const std::string& text);
std::string PlotlyDash(int dash);

// Traces without points, which stand in the legend and switch those of their name.
nlohmann::ordered_json PlotlyLegend(const Figure& figure);

// Appends the traces of a panel.
void AddPlotlyTraces(const Figure& figure, const Panel& panel, const PlotlyAxes& axes,
                     const MostRows& most, nlohmann::ordered_json* data);

// The bar, and the trace without points that has it shown.
nlohmann::ordered_json PlotlyBarTrace(const ColourBar& bar);
nlohmann::ordered_json PlotlyColourBar(const ColourBar& bar);

}  // namespace lyrefit
