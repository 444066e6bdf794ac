#pragma once

#include <limits>
#include <string>

#include "lyrefit/diagnose/reference.h"

// Comparisons written by hand, without running the library.
namespace lyrefit {

inline ReferenceComparison SampleReference() {
  ReferenceComparison c;
  c.name = "today";
  c.differs = true;
  c.p_value = 3e-6;
  c.sentence =
      "The sweep differs from its 12 reference sweeps (p = 3e-06): series resistance +8 %, Pmax "
      "-0.62 %.";
  c.rows = {{"FF", "fill factor", "%", 73.2, 73.7, 73.5, 73.9, -6.1, 1e-5, -0.0068, true},
            {"shape", "departure from the usual shape", "% of Isc", 0.02, 0.021, 0.01, 0.04, -0.2,
             1, std::numeric_limits<double>::quiet_NaN(), false}};
  ReferenceCause cause;
  cause.id = "series_resistance";
  cause.sentence = "series resistance +8 %, Pmax -0.62 %";
  cause.strength = {{"", "size", "%", 8, 6.9, 9.1}};
  cause.power_effect.value = 0.0062;
  cause.explained = 0.97;
  c.causes = {cause};
  c.references.assign(12, "before");
  c.left_out = {"wet: unlike the other reference sweeps"};
  c.regressed_on = {"Isc", "Voc"};
  c.warnings = {"a warning"};
  c.without_common.voltage_V = {0, 1};
  c.without_common.current_A = {1, 0};
  c.common = 0.0011;
  return c;
}

inline OutlierSweeps SampleOutlierSweeps() {
  OutlierSweeps outlier;
  outlier.sweeps = {SampleReference(), SampleReference()};
  outlier.sweeps[0].without_common = {};
  outlier.sweeps[1].name = "yesterday";
  outlier.sweeps[1].differs = false;
  outlier.sweeps[1].sentence = "The sweep agrees with the 12 sweeps nearest to it (p = 0.7).";
  outlier.sweeps[1].causes.clear();
  outlier.rejected = {"night: the curve is dark"};
  outlier.outlier = 1;
  return outlier;
}

}  // namespace lyrefit
