#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lyrefit/report/figure.h"
#include "lyrefit/report/figure_parts.h"

// plotly_traces.cc: the content of a panel as Plotly's traces.
namespace lyrefit {

// Plotly's names of a panel's axes: "x2", "y2", and "y5" for its right axis.
struct PlotlyAxes {
  std::string x;
  std::string y;
  std::string right;
};

// Plain text escaped for Plotly, which interprets some HTML.
std::string PlotlyText(const std::string& text);
std::string PlotlyDash(int dash);

// Traces without points for the legend, which switch the traces of their name.
nlohmann::ordered_json PlotlyLegend(const Figure& figure);

// Appends the traces of a panel.
void AddPlotlyTraces(const Figure& figure, const Panel& panel, const PlotlyAxes& axes,
                     const MostRows& most, nlohmann::ordered_json* data);

// The colour bar, and the trace without points that makes Plotly show it.
nlohmann::ordered_json PlotlyBarTrace(const ColourBar& bar);
nlohmann::ordered_json PlotlyColourBar(const ColourBar& bar);

}  // namespace lyrefit
