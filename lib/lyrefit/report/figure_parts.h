#pragma once
// Steps from a figure to gnuplot commands and from those to a picture.

#include <array>
#include <cstddef>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/report/figure.h"

namespace lyrefit {

// figure_svg.cc: positions of title, legend and panels, in pixels of the SVG picture.
struct PageLayout {
  double width = 0;
  double height = 0;
  double panel_width = 0;
  int columns = 1;         // of panels
  double entry_width = 0;  // of one legend entry
  int legend_columns = 1;
  std::vector<double> top;  // of each panel
};

PageLayout LayOut(const Figure& figure);

// Commands for the terminal, the title, the legend and all panels in common.
std::string PageCommands(const Figure& figure, const PageLayout& page, const std::string& terminal);

// Commands for the position of a panel, its title and the labels of its axes.
std::string PlacePanel(const Figure& figure, const PageLayout& page, int panel);

// Quotes a text in gnuplot's single quotes; control characters become blanks.
std::string GnuplotText(const std::string& text);

// More marks are indistinguishable, and a picture of them would have many megabytes.
constexpr std::size_t kMostMarks = 2000;

// figure.cc: indices of about `most` points (at least 4) that look like all of them. They are
// the first and last point and, in equal steps of x, the lowest and highest y and two points
// between. Rising; all indices if there are at most that many points, else without points that are
// not finite.
std::vector<std::size_t> MarksToDraw(const std::vector<double>& x, const std::vector<double>& y,
                                     std::size_t most = kMostMarks);

// figure.cc: largest numbers of rows to draw, for each stretch of joined rows.
constexpr std::size_t kAllRows = std::numeric_limits<std::size_t>::max();
struct MostRows {
  std::size_t marks = kAllRows;
  std::size_t corners = kAllRows;
};

// Limits that keep the picture below one megabyte.
MostRows MostOf(const Figure& figure);

// The stretches of joined rows of a series, thinned; their number is that of `ends` plus one.
using FigureRow = std::array<double, 3>;
std::vector<std::vector<FigureRow>> RowsToDraw(const Panel& panel, const Series& series,
                                               const MostRows& most);

// gnuplot.cc: runs gnuplot on `script`, without start-up files, and returns its standard output.
// Errors: gnuplot missing, or a script that it rejects.
Expected<std::string> RunGnuplot(const std::string& script);

// plotly_traces.cc: Plotly's names of a panel's axes: "x2", "y2", and "y5" for its right axis.
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
