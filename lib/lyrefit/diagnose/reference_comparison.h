// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/model/cause.h"

namespace LYREFIT_PUBLIC lyrefit {

// One quantity of a sweep and its expected value.
struct ReferenceRow {
  std::string symbol;  // "FF", "Rs", "n", "Gsh", "shape", "Isc/G"
  std::string name;    // name in code and JSON
  std::string unit;
  double now = 0;       // value of the sweep
  double expected = 0;  // predicted from the reference sweeps at its Isc and Voc
  double low_95 = 0;    // prediction interval of a reference sweep
  double high_95 = 0;
  double z = 0;            // difference / standard deviation of its prediction
  double corrected_p = 1;  // corrected for all rows
  double power = 0;        // gain (+) or loss (-) of Pmax by the difference, relative; NaN: none
  bool differs = false;    // at the significance level of the options
};

// A change of a reference sweep that would explain the difference. Its id is "series_resistance",
// "shunt", "ideality", or an effect's, as "shading"; its only strength is its size. Its effect on power
// is the part of Pmax that it takes, below 0 if it adds some.
struct ReferenceCause : Cause {
  double explained = 0;  // fraction of the squared difference (in standard deviations)
};

// A sweep compared with reference sweeps of the same module.
struct ReferenceComparison {
  std::string name;      // of the sweep
  bool differs = false;  // at the significance level of the options
  double p_value = 1;    // of the difference, corrected for all tests
  std::string sentence;
  std::vector<ReferenceRow> rows;
  // Best first, then those that these rows cannot separate from it. Empty if nothing differs.
  std::vector<ReferenceCause> causes;
  std::vector<std::string> references;    // names of the sweeps that were used
  std::vector<std::string> left_out;      // sentences: references not used, with the reason
  std::vector<std::string> regressed_on;  // "Isc", "Voc"
  std::vector<std::string> warnings;
  // The sweep minus the common single-diode residual of the reference sweeps, as input of Diagnose.
  IvCurve without_common;
  double common = 0;  // root mean square of that residual, fraction of Isc
};

// Each sweep of a module compared with all others that are not outliers. Smallest p-value first;
// p-values are corrected for the number of sweeps.
struct OutlierSweeps {
  std::vector<ReferenceComparison> sweeps;
  std::vector<std::string> rejected;  // sentences: sweeps not compared, with the reason
  int outlier = 0;                    // number of sweeps that differ
};

}  // namespace lyrefit
