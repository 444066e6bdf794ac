#pragma once

#include "lyrefit/report/figure.h"
#include "lyrefit/study/comparison.h"

namespace lyrefit {

// Figures of a comparison, one panel for each problem; compare_plot.h describes them. At least one
// problem is required.
Figure BoxFigure(const Comparison& comparison);
Figure ConvergenceFigure(const Comparison& comparison);
Figure BudgetFigure(const Comparison& comparison);
// Defined in problem_script.cc: the figure for problems that are summarised over their devices.
Figure ProblemFigure(const Comparison& comparison);

// Defined in budget_script.cc: the parts of a panel of shares of runs against budgets. Coincident
// lines stay visible: the first is drawn widest.
Series ShareLine(const std::string& name, int index, double width);
Axis BudgetAxis(double low, double high);
Axis ShareAxis();

}  // namespace lyrefit
