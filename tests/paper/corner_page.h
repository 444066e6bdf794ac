#pragma once

#include <string>

#include "lyrefit/report/figure.h"
#include "paper/corner_study.h"

namespace lyrefit {

// The page about PWP201 with two diodes, as Markdown.
std::string CornerPage(const CornerStudy& study);

// Its picture: what both optima leave, and where every run of the last budget but one ends.
Figure CornerFigure(const CornerStudy& study);

}  // namespace lyrefit
