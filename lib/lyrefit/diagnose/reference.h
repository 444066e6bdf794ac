// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/parallel.h"
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

// Significance level and resources of a comparison with reference sweeps.
struct ReferenceOptions {
  double level = 0.01;  // family-wise error rate over all quantities compared
  int threads = 0;      // 0: all cores; never changes a result
};

inline constexpr OptionRow<ReferenceOptions> kReferenceOptionTable[] = {
    OptionRow<ReferenceOptions>("Against its own history"),
    {"reference-level", "", "rate of false alarms of the comparison with reference sweeps",
     &ReferenceOptions::level, 1e-6, 0.5},
    {"threads", "N", "0: all cores; never changes a result", &ReferenceOptions::threads, 0,
     kMostThreads, OptionTrait::kQuiet | OptionTrait::kNoFlag | OptionTrait::kNoEcho},
};

// Compares a sweep with reference sweeps of its module. Compared are FF, Rs Isc / Voc, n and Gsh
// Voc / Isc of a single-diode fit, and the shape of its residuals. The values of the references are
// regressed on ln Isc and Voc, so that no curve is translated. The 40 sweeps nearest in Isc and Voc
// are used; outliers among them are left out.
//
// Fewer than four references show no scatter of their own. Under stated lights and temperatures that are
// alike, the sweep's Isc, Voc, fill factor and leak are compared with theirs, by the scatter that is usual
// of the setup; sentences name what lowers Isc and Voc together, polarisation (PID-p) among it.
//
// Errors: no usable reference sweep, or fewer than four under unknown or unlike light; other cell counts;
// a sweep more than 20 % beyond the Isc or Voc of four and more; readings that cannot be fitted; options
// outside their ranges.
Expected<ReferenceComparison> CompareWithReferences(const IvCurve& curve,
                                                    const std::vector<IvCurve>& reference,
                                                    const ReferenceOptions& options = {});

// Compares each sweep of a module with the others. Errors: fewer than five usable sweeps, other
// cell counts, options outside their ranges.
Expected<OutlierSweeps> FindOutlierSweeps(const std::vector<IvCurve>& curves,
                                          const ReferenceOptions& options = {});

}  // namespace lyrefit
