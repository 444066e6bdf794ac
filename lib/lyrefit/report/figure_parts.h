#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/report/figure.h"

// How a figure becomes gnuplot commands, and those a picture.
namespace lyrefit {

// figure_page.cc: where title, legend and panels stand, in pixels of the svg picture.
struct PageLayout {
  double width = 0;
  double height = 0;
  double panel_width = 0;
  int columns = 1;         // of panels
  double entry_width = 0;  // of the legend
  int legend_columns = 1;
  std::vector<double> top;  // of each panel
};

PageLayout LayOut(const Figure& figure);

// Terminal, title, legend and what holds for all panels.
std::string PageCommands(const Figure& figure, const PageLayout& page, const std::string& terminal);

// Where a panel stands, with its title and the labels of its axes.
std::string PlacePanel(const Figure& figure, const PageLayout& page, int panel);

// In gnuplot's single quotes; control characters become blanks.
std::string GnuplotText(const std::string& text);

// More marks than these nobody can tell apart, and a picture of them all is many megabytes.
constexpr std::size_t kMostMarks = 2000;

// thin_marks.cc: the places of about `most` points (at least 4) that look like all of them: in equal steps of x
// the lowest and the highest y and two in between, and the first and last point. Rising; all places
// if there are no more points than that. Points that are not finite are left out where there are
// more.
std::vector<std::size_t> MarksToDraw(const std::vector<double>& x, const std::vector<double>& y,
                                     std::size_t most = kMostMarks);

// figure_rows.cc: what a figure draws of its rows: of each stretch no more than this many.
constexpr std::size_t kAllRows = std::numeric_limits<std::size_t>::max();
struct MostRows {
  std::size_t marks = kAllRows;
  std::size_t corners = kAllRows;
};

// Such that the picture is less than a megabyte.
MostRows MostOf(const Figure& figure);

// The stretches of a series, each of rows that are joined: one more than the series has ends.
using FigureRow = std::array<double, 3>;
std::vector<std::vector<FigureRow>> RowsToDraw(const Panel& panel, const Series& series,
                                               const MostRows& most);

// gnuplot.cc: runs gnuplot on `script` and returns the picture, which the script must leave on standard output.
// Reads no start-up files. Fails where gnuplot is not installed or does not understand the script.
Expected<std::string> RunGnuplot(const std::string& script);

}  // namespace lyrefit
