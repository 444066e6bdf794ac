#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/law/parameter.h"

namespace LYREFIT_PUBLIC lyrefit {

// The parameters that a curve was made from, as the contest sets of github.com/cwhanse/ivcurves
// state them: of the whole module, n per cell, one diode.
struct TruthRow {
  std::string index;           // of the curve; that of a lone row is of no account
  std::vector<double> values;  // Iph, Is1, n1, Rs, Rsh: the order of a single-diode device
  int cells_in_series = 1;
};

// A table with the columns Index, photocurrent, saturation_current, resistance_series,
// resistance_shunt, n, cells_in_series in any order. Errors carry file, line and column: what
// cannot be read, values no diode in the light has, an index that occurs twice, no row at all.
Expected<std::vector<TruthRow>> ReadTruth(const std::string& path);

// Errors of one parameter, each relative to the truth of its own curve.
struct TruthParameter {
  ParameterInfo info;
  double worst = kUnknown;   // largest |error|
  std::string worst_id;      // of the curve with that error
  double median = kUnknown;  // of |error|
  int intervals = 0;         // curves with a 95 % interval
  int covered = 0;           // of those: it holds the truth
  // The same of the intervals to believe: where the residuals ask for it, those under the error
  // model.
  int covered_believed = 0;
  // Of sets with one truth, else NaN. The shunt takes part as a conductance: a curve that says
  // nothing of it has a resistance without limit, which no mean survives.
  double truth = kUnknown;
  double mean = kUnknown;              // of the fits
  double mean_error = kUnknown;        // of that mean, with its sign
  double root_mean_square = kUnknown;  // of the errors of the single fits
  // The parameter of a joint fit of curves that were all taken at the reference; NaN without one.
  double joint = kUnknown;
  double joint_error = kUnknown;  // relative, with its sign; of the shunt's conductance
  Interval by_points;  // its 95 % interval with points, and with whole curves, as independent
  Interval by_curves;
};

// Fits held against what the curves were made with.
struct TruthComparison {
  int rows = 0;                            // of truth
  int curves = 0;                          // compared
  int unmatched = 0;                       // fitted curves without a row of truth
  bool one_truth = false;                  // one row for all curves
  std::vector<TruthParameter> parameters;  // Iph, Is1, n1, Rs, Rsh
  std::vector<std::string> warnings;
};

// The fits of single curves, and with one truth the shared parameters, held against the truth: a
// lone row holds for all curves, others for the curve with their index as its id. Only single-diode
// fits can be compared; a warning says so where there is nothing else.
TruthComparison CompareWithTruth(const FamilyReport& report, const std::vector<TruthRow>& truth);

}  // namespace lyrefit
