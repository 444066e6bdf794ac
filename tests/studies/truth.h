#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/model/parameter.h"

namespace lyrefit {

// The parameters from which a curve was simulated, in the format of the contest sets of
// github.com/cwhanse/ivcurves: whole module, n per cell, one diode.
struct TruthRow {
  std::string index;           // index of the curve; ignored if the table has only one row
  std::vector<double> values;  // Iph, Is1, n1, Rs, Rsh: the order of a single-diode device
  int cells_in_series = 1;
};

// Reads a table with the columns Index, photocurrent, saturation_current, resistance_series,
// resistance_shunt, n, cells_in_series in any order. Errors carry file, line and column: unreadable
// fields, values that no illuminated diode has, a repeated index, no row at all.
Expected<std::vector<TruthRow>> ReadTruth(const std::string& path);

// Errors of one parameter, each relative to the true value of its own curve.
struct TruthParameter {
  ParameterInfo info;
  double worst = kUnknown;   // largest |error|
  std::string worst_id;      // of the curve with that error
  double median = kUnknown;  // of |error|
  int intervals = 0;         // number of curves with a 95 % interval
  int covered = 0;           // of `intervals`: the interval contains the true value
  // As `covered`, for the recommended intervals. These are the intervals under the error model, if
  // the residuals indicate one.
  int covered_believed = 0;
  // The following are set for sets with one truth, else NaN. Rsh is averaged as a conductance. A
  // curve without information on Rsh has an unlimited resistance, which would dominate a mean.
  double truth = kUnknown;
  double mean = kUnknown;              // mean of the fits
  double mean_error = kUnknown;        // error of `mean`, signed
  double root_mean_square = kUnknown;  // of the errors of the single fits
  // The parameter of a joint fit, if all curves were taken at the reference conditions; else NaN.
  double joint = kUnknown;
  double joint_error = kUnknown;  // relative and signed; for Rsh, of the conductance
  // 95 % interval of `joint`: points independent; by_curves: curves independent.
  Interval by_points;
  Interval by_curves;
};

// Fits compared with the parameters that the curves were simulated from.
struct TruthComparison {
  int rows = 0;                            // number of true rows
  int curves = 0;                          // number of compared curves
  int unmatched = 0;                       // number of fitted curves without a true row
  bool one_truth = false;                  // one true row applies to all curves
  std::vector<TruthParameter> parameters;  // Iph, Is1, n1, Rs, Rsh
  std::vector<std::string> warnings;
};

// Compares the fits of single curves with the truth, and with one truth also the shared parameters.
// A single row applies to all curves. Otherwise a row applies to the curve whose id is the row's
// index. Only single-diode fits can be compared. A warning is added if there are none.
TruthComparison CompareWithTruth(const FamilyReport& report, const std::vector<TruthRow>& truth);

// The comparison as text for a terminal of 100 columns.
std::string TruthText(const TruthComparison& comparison);

}  // namespace lyrefit
