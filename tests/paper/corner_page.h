#pragma once

#include <string>

#include "lyrefit/report/figure.h"
#include "paper/corner_study.h"

namespace lyrefit {

// Markdown page about the double-diode model on PWP201.
std::string CornerPage(const CornerStudy& study);

// Figure of that page: the residuals at both optima, and the final RMSE of every run at the last
// budget but one.
Figure CornerFigure(const CornerStudy& study);

}  // namespace lyrefit
