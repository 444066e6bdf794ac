#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/model/kernel.h"

namespace lyrefit {

// A laboratory cell of 0.25 cm2 at 25 C: Iph, Is, n, Rs and Rsh in A and ohm.
inline const std::vector<double> kCellTruth = {5.5e-3, 2e-13, 1.4, 6, 9000};

// A sweep of a diode under `light` W/m2 (0: dark) from -0.1 to 0.96 V, or down from there.
inline IvCurve CellSweepOf(std::vector<double> p, double light, bool down = false,
                           double noise_A = 0) {
  IvCurve curve;
  curve.name = "made";
  curve.source = "made";
  curve.notes.area_cm2 = 0.25;
  curve.conditions.irradiance_W_m2 = light;
  p[0] *= light / 1000;
  for (int k = 0; k <= 106; ++k) curve.voltage_V.push_back(-0.1 + 0.01 * (down ? 106 - k : k));
  curve.current_A =
      SolveCurrents(MakeDevice(Model::kSingleDiode, curve.conditions), p.data(), curve.voltage_V);
  RandomStream random(down ? 2 : 1);
  for (double& i : curve.current_A) i += noise_A * random.Normal();
  return curve;
}

inline CurveSet CellOf(std::vector<IvCurve> curves) {
  CurveSet cell;
  cell.name = "made";
  for (std::size_t k = 0; k < curves.size(); ++k) {
    curves[k].source = "file " + std::to_string(k);
    cell.curves.push_back(curves[k]);
  }
  return cell;
}

}  // namespace lyrefit
