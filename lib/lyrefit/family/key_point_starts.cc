#include "lyrefit/family/key_point_starts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/family/joint_fit.h"
#include "lyrefit/family/key_point_curve.h"

namespace lyrefit {

std::vector<JointPoint> KeyPointStarts(const FamilyProblem& family,
                                       const std::vector<int>& curves) {
  const JointCurve* brightest = nullptr;
  for (const int c : curves) {
    const JointCurve& one = family.curves.members[c].joint;
    if (!one.key_points || one.key_points->size() < kKeyPointRows) continue;
    if (brightest == nullptr || one.irradiance_W_m2 > brightest->irradiance_W_m2) brightest = &one;
  }
  std::vector<JointPoint> starts;
  if (brightest == nullptr) return starts;
  const auto& value = brightest->key_points->value;
  DataSheetValues values;
  values.short_circuit_current_A = value[kIscRow];
  values.open_circuit_voltage_V = value[kVocRow];
  values.max_power_voltage_V = value[kVmpRow];
  values.max_power_current_A = value[kPmpRow] / value[kVmpRow];
  const TranslationSpec& spec = family.translation.spec;
  const KeyPointSheet sheet{
      values, spec.cells_in_series * ThermalVoltage(brightest->temperature_K, spec.constants),
      spec.constants};
  // The lower end of the search is 1 for each junction of a cell.
  const double junctions = std::max(1.0, family.bounds[family.translation.n].search_lower);
  for (const double n : {0.8, 0.95, 1.1, 1.25, 1.4, 1.7, 2.0}) {
    const auto curve = PhysicalCurve(sheet, n * junctions);
    if (!curve) continue;
    const ReferenceDevice device = ToDevice(sheet, *curve);
    std::vector<double> shared =
        StartFromIndividualFit(family, *brightest,
                               {device.photocurrent_A, device.saturation_current_A, device.n,
                                device.resistance_series_ohm, 1 / device.shunt_conductance_S});
    if (!shared.empty()) starts.push_back({std::move(shared), {}});
  }
  return starts;
}

}  // namespace lyrefit
