// Experimental: may change in a minor version (data/stable).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"

// A picture as data: a page of panels with one title and legend. Other sources turn records into
// figures; this module draws figures with gnuplot.
namespace LYREFIT_PUBLIC lyrefit {

// How a series is drawn.
struct Look {
  std::string colour = "#000000";  // empty: by the third number of each row, on the colour bar
  int dash = 1;                    // number of gnuplot's dash type
  int point = 7;                   // number of gnuplot's symbol: 7 is a disc
};

// Colours of Okabe and Ito, which are distinguishable to the colour-blind.
inline constexpr char kBlue[] = "#0072B2";
inline constexpr char kVermilion[] = "#D55E00";
inline constexpr char kSkyBlue[] = "#56B4E9";
inline constexpr char kOrange[] = "#E69F00";
inline constexpr char kGrey[] = "#888888";

// The look of the first, second, ... of several series; neighbours differ.
Look LookOf(int index);

// How the rows of a series are drawn.
enum class SeriesKind {
  kPoints,
  kLine,
  kLineAndPoints,
  kStems,  // from y = 0
  kBox,    // quartiles of all y at the x of the first row, whiskers and outliers
  kBars,   // from y = 0, of the series' width along x
  kCells,  // rectangles around x and y, of the series' width along x and `kCellHeight` along y
};

// Height of a cell; the rest of 1 is the gap between cells.
inline constexpr double kCellHeight = 0.9;

// Points or a line of a panel.
struct Series {
  SeriesKind kind = SeriesKind::kLine;
  Look look = {};                                // colour, dash and symbol
  double width = 1;                              // of lines; of boxes, bars and cells along x
  double size = 1;                               // of points
  bool right_axis = false;                       // y refers to the right axis
  std::string name = {};                         // shown by viewers under the pointer
  std::vector<std::array<double, 3>> rows = {};  // x, y and the value for the colour bar
  std::vector<std::size_t> ends = {};            // rows at which a line is interrupted
  // Shown by viewers under the pointer in place of x and y, for each row of bars and cells; or none.
  std::vector<std::string> texts = {};
  // Columns of the table of all rows (block::LongTable) whose filters viewers set by a click.
  std::vector<std::string> filter_columns = {};
  // The texts of these filters, for each row of bars and cells or once for a line. An empty text and
  // a missing column are no filter.
  std::vector<std::vector<std::string>> filters = {};

  void Add(double x, double y, double colour = 0);  // ignores rows that are not finite
  // Later rows are not joined to the previous ones.
  void EndLine();
};

// A text in place of a number on an axis.
struct Tick {
  std::string name;  // the word
  double place = 0;  // in units of the axis
};

// One axis of a panel.
struct Axis {
  std::string label;      // with its unit: "Voltage (V)"
  double low = kUnknown;  // unknown: from the data, at the next tick
  double high = kUnknown;
  std::string colour = "black";  // of the label
  double air_low = 0;            // margin beyond the data at an unknown end, in parts of the panel
  double air_high = 0;           // margin at the upper end
  bool tight = false;            // do not extend an unknown end to the next tick
  bool log = false;              // logarithmic
  double first_tick = kUnknown;  // unknown: chosen by gnuplot
  double tick_step = kUnknown;   // a factor on a logarithmic axis
  std::vector<Tick> ticks = {};  // replace the numbers
  bool slanted = false;          // whether names of ticks are slanted
};

// A line across the panel at one y, behind the series.
struct Rule {
  double y = 0;  // in units of the axis
  std::string colour = "black";
  int dash = 1;             // number of gnuplot's dash type
  double width = 1;         // of the line
  bool right_axis = false;  // `y` refers to the right axis
};

// A band between two positions of an axis across the panel, behind everything.
struct Band {
  bool upright = false;  // between two x; else between two y
  double low = 0;
  double high = 0;
  std::string colour = kSkyBlue;
  double opacity = 0.25;  // 0 to 1
};

// A text at a position in parts of the panel.
struct Note {
  std::string text;  // one line
  std::string colour;
  double x = 0;                 // from the left, 0 to 1
  double y = 0;                 // from below, 0 to 1
  std::string side = "center";  // of the text, placed at x: "left", "center" or "right"
};

// One set of axes and its content.
struct Panel {
  std::string title;
  Axis x = {};                      // below the panel
  Axis y = {};                      // labelled in the leftmost panels only
  std::optional<Axis> right = {};   // a second y axis, for series with right_axis
  std::vector<Series> series = {};  // drawn in this order
  std::vector<Rule> rules = {};
  std::vector<Band> bands = {};
  std::vector<Note> notes = {};
  bool zero_line = false;  // drawn at y = 0 if within the range
  int height = 300;        // pixels of the SVG picture
};

// Symbol beside a name in the legend.
enum class LegendMark { kLine, kPoint, kLineAndPoint, kBox, kBar };

// An entry of the legend.
struct LegendEntry {
  std::string name;                     // shown beside the symbol
  Look look = {};                       // of the series
  LegendMark mark = LegendMark::kLine;  // symbol beside the name
};

// Scale of colours, below the panels.
struct ColourBar {
  std::string label;  // with its unit
  double low = 0;
  double high = 1;
};

// A page of panels under one title and one legend.
struct Figure {
  std::string title;
  std::vector<LegendEntry> legend = {};  // above the panels
  std::vector<Panel> panels = {};        // row by row from the upper left
  int columns = 1;                       // of panels
  int panel_width = 0;                   // pixels; 0: selected by the number of columns
  int margin_below = 0;                  // pixels below each panel, for slanted names
  std::optional<ColourBar> colour_bar = {};
};

// Legend entries of the names, with LookOf() their positions.
std::vector<LegendEntry> LegendOf(const std::vector<std::string>& names, LegendMark mark);

// Whether to draw all points or a thinned set that looks alike and keeps the picture below one
// megabyte.
enum class PlotPoints { kThinned, kAll };

// gnuplot commands that write the figure to standard output. `terminal` is "svg", "png" or "pdf".
std::string FigureScript(const Figure& figure, const std::string& terminal,
                         PlotPoints points = PlotPoints::kThinned);

// Draws into a .svg, .png or .pdf file, completely or not at all. Errors: another extension, gnuplot
// missing or without cairo (.png, .pdf), `path` not writable. Equal figures are equal files.
Expected<void> DrawFigure(const Figure& figure, const std::string& path,
                          PlotPoints points = PlotPoints::kThinned);

// Checks that DrawFigure() can draw into a file of this name: extension and gnuplot. Call it before
// a long fit.
Expected<void> CheckPlot(const std::string& path);

}  // namespace lyrefit
