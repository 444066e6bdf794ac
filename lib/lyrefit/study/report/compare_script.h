#pragma once

#include "lyrefit/report/figure.h"
#include "lyrefit/study/comparison.h"

namespace lyrefit {

// Pictures of a comparison, one panel a problem, as compare_plot.h describes them. There is at
// least one problem.
Figure BoxFigure(const Comparison& comparison);
Figure ConvergenceFigure(const Comparison& comparison);
Figure BudgetFigure(const Comparison& comparison);
// pool_script.cc: the same of pooled problems.
Figure PoolFigure(const Comparison& comparison);

// budget_script.cc: what a panel of shares of runs over budgets consists of. Lines that lie on each
// other are drawn one in the other, the first one widest.
Series ShareLine(const std::string& name, int index, double width);
Axis BudgetAxis(double low, double high);
Axis ShareAxis();

}  // namespace lyrefit
