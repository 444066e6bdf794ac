#include <algorithm>
#include <cmath>

#include "lyrefit/base/byte_input.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/curve_text.h"
#include "lyrefit/diagnose/diagnose.h"

namespace lyrefit {
namespace {

bool UnderSameConditions(const IvCurve& a, const IvCurve& b) {
  const double light = std::max(a.conditions.irradiance_W_m2, b.conditions.irradiance_W_m2);
  return a.conditions.cells_in_series == b.conditions.cells_in_series &&
         std::fabs(a.conditions.irradiance_W_m2 - b.conditions.irradiance_W_m2) <= 0.02 * light &&
         std::fabs(a.conditions.cell_temperature_K - b.conditions.cell_temperature_K) <= 1;
}

// +1 for rising voltage, -1 for falling.
int SweepDirection(const IvCurve& curve) {
  return curve.voltage_V.back() > curve.voltage_V.front() ? 1 : -1;
}

// Whether the curves are sweeps in both directions under the same conditions.
bool AreSweeps(const std::vector<IvCurve>& curves) {
  bool up = false, down = false;
  for (const IvCurve& curve : curves) {
    if (!UnderSameConditions(curve, curves.front())) return false;
    (SweepDirection(curve) > 0 ? up : down) = true;
  }
  return up && down;
}

// Joins sweeps, one after the other, to one curve.
IvCurve JoinSweeps(const std::vector<IvCurve>& curves) {
  IvCurve joined = curves.front();
  joined.sweep.assign(joined.size(), 0);
  if (std::any_of(curves.begin(), curves.end(),
                  [](const IvCurve& curve) { return curve.sigma_A.empty(); })) {
    joined.sigma_A.clear();
  }
  joined.time_s.clear();
  joined.irradiance_W_m2.clear();
  joined.temperature_C.clear();
  for (std::size_t c = 1; c < curves.size(); ++c) {
    const IvCurve& next = curves[c];
    joined.voltage_V.insert(joined.voltage_V.end(), next.voltage_V.begin(), next.voltage_V.end());
    joined.current_A.insert(joined.current_A.end(), next.current_A.begin(), next.current_A.end());
    if (!joined.sigma_A.empty()) {
      joined.sigma_A.insert(joined.sigma_A.end(), next.sigma_A.begin(), next.sigma_A.end());
    }
    joined.sweep.insert(joined.sweep.end(), next.size(), static_cast<int>(c));
    joined.name += " + " + next.name;
  }
  joined.assumptions.push_back(
      "the sweeps follow each other in the order of the files, reading by reading at one pace");
  return joined;
}

}  // namespace

Expected<CurveSet> ReadMeasurement(const std::string& path, const ReadOptions& options) {
  if (IsStream(path)) return ReadCurvesOfStream(path, options);
  if (HoldsCurveSet(path, options)) return ReadCurveSet(path, options);
  TRY(IvCurve curve, ReadCurve(path, options));
  return SetOfOne(std::move(curve));
}

Expected<CurveSet> ReadMeasurement(const std::vector<std::string>& paths,
                                   const ReadOptions& options) {
  CurveSet all;
  for (const std::string& path : paths) {
    TRY(CurveSet set, ReadMeasurement(path, options));
    all.name += (all.name.empty() ? "" : " + ") + set.name;
    all.source += (all.source.empty() ? "" : ", ") + set.source;
    for (IvCurve& curve : set.curves) all.curves.push_back(std::move(curve));
    for (RejectedCurve& bad : set.rejected) all.rejected.push_back(std::move(bad));
  }
  if (all.curves.size() > 1 && AreSweeps(all.curves)) all.curves = {JoinSweeps(all.curves)};
  return all;
}

}  // namespace lyrefit
