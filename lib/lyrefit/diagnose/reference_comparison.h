#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// One row of now against expected.
struct ReferenceRow {
  std::string symbol;  // "FF", "Rs", "n", "Gsh", "shape", "Isc/G"
  std::string name;    // as code and JSON spell it
  std::string unit;
  double now = 0;       // of the sweep
  double expected = 0;  // at the sweep's own Isc and Voc, from the reference sweeps
  double low_95 = 0;    // of what a reference sweep would show
  double high_95 = 0;
  double z = 0;            // difference in standard deviations of its prediction
  double corrected_p = 1;  // all rows counted
  double power = 0;        // part of Pmax that the difference gives (+) or costs (-); NaN: none
  bool differs = false;    // at the level of the options
};

// Something done to a reference sweep that would make the difference.
struct ReferenceCause {
  std::string id;  // "series_resistance", "shunt", "ideality", or an effect's: "shading", "drift"
  std::string sentence;  // "series resistance +8.1 %: -0.62 % of Pmax"
  double size = 0;       // in its own measure: see `unit`
  double low_95 = 0;
  double high_95 = 0;
  std::string unit;
  double power = 0;      // part of Pmax
  double explained = 0;  // part of the squared difference (in standard deviations)
};

// A sweep against reference sweeps of the same module.
struct ReferenceComparison {
  std::string name;      // the sweep's
  bool differs = false;  // at the level of the options
  double p_value = 1;    // of the difference, all looks at it counted
  std::string sentence;
  std::vector<ReferenceRow> rows;
  // The best first; then those these rows cannot tell from it. Empty where nothing differs.
  std::vector<ReferenceCause> causes;
  std::vector<std::string> references;    // names of the sweeps that were used
  std::vector<std::string> left_out;      // sentences: reference sweeps that were not, and why
  std::vector<std::string> regressed_on;  // "Isc", "Voc"
  std::vector<std::string> warnings;
  // The sweep less what all reference sweeps' single diodes miss alike, for Diagnose, and the size of
  // that (root mean square, in parts of Isc).
  IvCurve without_common;
  double common = 0;  // the size of that
};

// The sweeps of one module against each other: each is compared with all others that are no outliers
// themselves. The oddest first; p-values count the sweeps.
struct OutlierSweeps {
  std::vector<ReferenceComparison> sweeps;
  std::vector<std::string> rejected;  // sentences: sweeps that could not be compared, and why
  int outlier = 0;                        // how many differ
};

}  // namespace lyrefit
