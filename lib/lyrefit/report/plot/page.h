#pragma once

#include <string>
#include <vector>

#include "lyrefit/report/plot/figure.h"

// Where the parts of a figure stand: title, legend, panels. Used by figure.cc alone.
namespace lyrefit {

// In pixels of the svg picture.
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

}  // namespace lyrefit
