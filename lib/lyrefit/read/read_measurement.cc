#include <algorithm>
#include <cmath>

#include "lyrefit/base/try.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/sweep_order.h"
#include "lyrefit/read/curve_text.h"
#include "lyrefit/read/read_curve_set.h"
#include "lyrefit/read/table_curve.h"

namespace lyrefit {
namespace {

bool UnderSameConditions(const IvCurve& a, const IvCurve& b) {
  const double light = std::max(a.conditions.irradiance_W_m2, b.conditions.irradiance_W_m2);
  return a.conditions.cells_in_series == b.conditions.cells_in_series &&
         std::fabs(a.conditions.irradiance_W_m2 - b.conditions.irradiance_W_m2) <= 0.02 * light &&
         std::fabs(a.conditions.cell_temperature_K - b.conditions.cell_temperature_K) <= 1;
}

// Whether the curves are sweeps in both directions under the same conditions.
bool AreSweeps(const std::vector<IvCurve>& curves) {
  bool up = false, down = false;
  for (const IvCurve& curve : curves) {
    if (curve.suns_voc_A || !UnderSameConditions(curve, curves.front())) return false;
    (Rises(curve.voltage_V) ? up : down) = true;
  }
  return up && down;
}

// Joins sweeps, one after the other, to one curve.
IvCurve JoinSweeps(const std::vector<IvCurve>& curves) {
  IvCurve joined = curves.front();
  joined.sweep.clear();
  joined.irradiance_W_m2.clear();
  joined.temperature_C.clear();
  for (std::size_t c = 1; c < curves.size(); ++c) {
    AppendSweep(curves[c], &joined);
    joined.name += " + " + curves[c].name;
  }
  joined.assumptions.push_back(
      "the sweeps follow each other in the order of the files, reading by reading at one pace");
  return joined;
}

}  // namespace

Expected<CurveSet> ReadMeasurement(const std::string& path, const ReadOptions& options) {
  if (IsFolder(path)) {
    if (HoldsCurveSet(path, options)) return ReadCurveSet(path, options);
    TRY(IvCurve curve, ReadCurve(path, options));
    return SetOfOne(std::move(curve));
  }
  TRY(const DecodedText text, ReadDecodedFile(path, options.largest_file_bytes));
  if (TextHoldsCurveSet(text, path, options)) return CurveSetOfFile(text, path, options);
  TRY(IvCurve curve, CurveOfFile(text, path, options));
  return SetOfOne(std::move(curve));
}

Expected<CurveSet> ReadMeasurement(const std::vector<std::string>& paths,
                                   const ReadOptions& options) {
  CurveSet all;
  for (const std::string& path : paths) {
    TRY(CurveSet set, ReadMeasurement(path, options));
    all.name += (all.name.empty() ? "" : " + ") + set.name;
    all.several_devices = all.several_devices || set.several_devices;
    all.source += (all.source.empty() ? "" : ", ") + set.source;
    for (IvCurve& curve : set.curves) all.curves.push_back(std::move(curve));
    for (RejectedCurve& bad : set.rejected) all.rejected.push_back(std::move(bad));
  }
  if (all.curves.size() > 1 && AreSweeps(all.curves)) all.curves = {JoinSweeps(all.curves)};
  return all;
}

}  // namespace lyrefit
