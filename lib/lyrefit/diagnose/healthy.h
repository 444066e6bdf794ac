#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit {

struct HealthyOptions {
  double level = 0.01;  // rate of false alarms over all that is compared
  int threads = 0;      // 0: all cores; never changes a result
};

inline constexpr OptionRow<HealthyOptions> kHealthyOptionTable[] = {
    OptionRow<HealthyOptions>("Against its own past"),
    {"healthy-level", "", "rate of false alarms of the comparison with healthy sweeps",
     &HealthyOptions::level, 1e-6, 0.5},
    {"threads", "N", "0: all cores; never changes a result", &HealthyOptions::threads, 0,
     kMostThreads, OptionTrait::kQuiet | OptionTrait::kNoFlag | OptionTrait::kNoEcho},
};

// One row of now against expected.
struct HealthyRow {
  std::string symbol;  // "FF", "Rs", "n", "Gsh", "shape", "Isc/G"
  std::string name;
  std::string unit;
  double now = 0;
  double expected = 0;  // at the sweep's own Isc and Voc, from the healthy sweeps
  double low_95 = 0;    // of what a healthy sweep would show
  double high_95 = 0;
  double z = 0;            // difference in standard deviations of its prediction
  double corrected_p = 1;  // all rows counted
  double power = 0;        // part of Pmax that the difference gives (+) or costs (-); NaN: none
  bool differs = false;
};

// Something done to a healthy sweep that would make the difference.
struct HealthyCause {
  std::string id;  // "series_resistance", "shunt", "ideality", or an effect's: "shading", "drift"
  std::string sentence;  // "series resistance +8.1 %: -0.62 % of Pmax"
  double size = 0;       // in its own measure: see `unit`
  double low_95 = 0;
  double high_95 = 0;
  std::string unit;
  double power = 0;      // part of Pmax
  double explained = 0;  // part of the squared difference (in standard deviations)
};

// A sweep against healthy ones of the same module.
struct HealthyComparison {
  std::string name;
  bool differs = false;
  double p_value = 1;  // of the difference, all looks at it counted
  std::string sentence;
  std::vector<HealthyRow> rows;
  // The best first; then those these rows cannot tell from it. Empty where nothing differs.
  std::vector<HealthyCause> causes;
  std::vector<std::string> references;    // names of the sweeps that were used
  std::vector<std::string> left_out;      // sentences: healthy sweeps that were not, and why
  std::vector<std::string> regressed_on;  // "Isc", "Voc"
  std::vector<std::string> warnings;
  // The sweep less what all healthy sweeps' single diodes miss alike, for Diagnose, and the size of
  // that (root mean square, in parts of Isc).
  IvCurve without_common;
  double common = 0;
};

// Compares by a single diode's FF, Rs Isc / Voc, n and Gsh Voc / Isc and by the shape of what it
// misses, each healthy sweep's regressed on ln Isc and Voc, so that no curve is translated; the
// 40 sweeps nearest in Isc and Voc count. Healthy sweeps that are odd among the others are left
// out.
//
// Errors: fewer than four healthy sweeps that can be used, other cell counts, a sweep more than 20
// % beyond the healthy sweeps' Isc or Voc, readings that cannot be fitted, options outside their
// ranges.
Expected<HealthyComparison> CompareWithHealthy(const IvCurve& curve,
                                               const std::vector<IvCurve>& healthy,
                                               const HealthyOptions& options = {});

// The sweeps of one module against each other: each is compared with all others that are not odd
// themselves. The oddest first; p-values count the sweeps.
struct OddSweeps {
  std::vector<HealthyComparison> sweeps;
  std::vector<std::string> rejected;  // sentences: sweeps that could not be compared, and why
  int odd = 0;                        // how many differ
};

// Errors: fewer than five sweeps that can be compared, options outside their ranges.
Expected<OddSweeps> FindOddSweeps(const std::vector<IvCurve>& curves,
                                  const HealthyOptions& options = {});

}  // namespace lyrefit
