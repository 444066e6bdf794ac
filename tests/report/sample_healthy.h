#pragma once

#include <limits>
#include <string>

#include "lyrefit/diagnose/healthy.h"

// Comparisons made by hand: no engine has seen them.
namespace lyrefit {

inline HealthyComparison SampleHealthy() {
  HealthyComparison c;
  c.name = "today";
  c.differs = true;
  c.p_value = 3e-6;
  c.sentence = "Unlike its 12 healthy sweeps (p = 3e-06): series resistance +8 %: -0.62 % of Pmax.";
  c.rows = {{"FF", "fill factor", "%", 73.2, 73.7, 73.5, 73.9, -6.1, 1e-5, -0.0068, true},
            {"shape", "departure from the usual shape", "% of Isc", 0.02, 0.021, 0.01, 0.04, -0.2,
             1, std::numeric_limits<double>::quiet_NaN(), false}};
  HealthyCause cause;
  cause.id = "series_resistance";
  cause.sentence = "series resistance +8 %: -0.62 % of Pmax";
  cause.size = 8;
  cause.low_95 = 6.9;
  cause.high_95 = 9.1;
  cause.unit = "%";
  cause.power = -0.0062;
  cause.explained = 0.97;
  c.causes = {cause};
  c.references.assign(12, "before");
  c.left_out = {"wet: unlike the other healthy sweeps"};
  c.regressed_on = {"Isc", "Voc"};
  c.warnings = {"a warning"};
  c.without_common.voltage_V = {0, 1};
  c.without_common.current_A = {1, 0};
  c.common = 0.0011;
  return c;
}

inline OddSweeps SampleOddSweeps() {
  OddSweeps odd;
  odd.sweeps = {SampleHealthy(), SampleHealthy()};
  odd.sweeps[0].without_common = {};
  odd.sweeps[1].name = "yesterday";
  odd.sweeps[1].differs = false;
  odd.sweeps[1].sentence = "Like the 12 sweeps nearest to it (p = 0.7).";
  odd.sweeps[1].causes.clear();
  odd.rejected = {"night: the curve is dark"};
  odd.odd = 1;
  return odd;
}

}  // namespace lyrefit
