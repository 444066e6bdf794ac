#pragma once

#include <string>

#include "lyrefit/certify/certify.h"

namespace lyrefit {

// A certificate as JSON, with what it takes to check the floor at its Rs without lyrefit. With
//   v[k] = voltage_V[k] + resistance_series current_A[k],      y = floor.dual_A,
// nothing that the model may add points along y: sum y <= 0, -sum y v <= 0, and
// -sum y (exp(v / nNsVth) - 1) <= 0 for nNsVth = n module_thermal_voltage_V and every n in the
// range. Then sum current_A y - sum y^2 / 2 <= N RMSE^2 / 2 for every mixture, and equality to
// rounding for the floor.
std::string CertificateJson(const Certificate& certificate);

}  // namespace lyrefit
