#pragma once

#include <array>
#include <cmath>

#include "lyrefit/curve/key_points.h"
#include "lyrefit/model/device.h"

namespace lyrefit {

// A point on the device's own curve.
struct OperatingPoint {
  double current_A;
  double junction_voltage_V;
  double conductance_S;  // dF/dVd at the junction, never positive for a passive device
};

// Solves I = F(V + I Rs) at terminal voltage V by safeguarded Newton on the junction voltage. The
// error is about 1e-15 of |I| + Iph. The solver never fails and gives no NaN for finite parameters
// in their physical range.
OperatingPoint SolveOperatingPoint(const Device& device, const double* p, double voltage_V);

// Unweighted root mean square of the residual that `objective` selects, in ampere. RMSE values of
// different objectives are not comparable: see Objective.
double Rmse(const Device& device, Objective objective, const double* p,
            const std::vector<double>& voltage_V, const std::vector<double>& current_A);

// The operating point at terminal voltage V whose current `current_A` is known, without a solve.
OperatingPoint KnownOperatingPoint(const Device& device, const double* p, double voltage_V,
                                   double current_A);

// Factor of the implicit function theorem, dI = dF / (1 - Rs F'). dF is the derivative of the
// right-hand side F(V + I Rs) by a parameter, with Vd = V + I Rs and I fixed.
inline double ImplicitFactor(const Device& device, const double* p, const OperatingPoint& point) {
  return 1.0 / (1.0 - p[device.resistance_series] * point.conductance_S);
}

// Isc, Voc and the maximum power point of a device's model curve, with a relative error of about
// 1e-12. With effects they are read from a fine sweep, with an error of about 1e-6. Voc and all
// that depends on it is NaN if the device gives no power (a dark curve).
KeyPoints ModelKeyPoints(const Device& device, const double* p);

// Voc alone, in V, at lower cost.
double ModelOpenCircuit(const Device& device, const double* p);

// One diode alone, in closed form: the voltage in V at which it carries a current, and the saturation
// current in A of one that carries a current at a voltage. `nNsVth`: n Ns k T / q in V.
inline double DiodeVoltage(double current_A, double saturation_current_A, double nNsVth) {
  return nNsVth * std::log1p(current_A / saturation_current_A);
}
inline double SaturationCurrent(double current_A, double voltage_V, double nNsVth) {
  return current_A / std::expm1(voltage_V / nNsVth);
}

// Positions of key points that a fit compares.
enum KeyPointRow { kIscRow, kVocRow, kVmpRow, kPmpRow, kKeyPointRows };
using KeyPointValues = std::array<double, kKeyPointRows>;  // A, V, V, W

// Largest number of parameters of a device in KeyPointsNear.
constexpr int kMostKeyPointParameters = 11;

// Key points of a device without effects, as ModelKeyPoints, but by Newton's steps from values near
// them, such as measured ones (NaN: none known). `slopes`, if not null: their derivatives by the
// device's parameters, kKeyPointRows x device.size(), row by row. At the junction voltage Vj of a
// key point one equation H(Vj, p) = 0 holds, so that dVj = -(dH/dp) dp / (dH/dVj):
//   Isc: Vj - F Rs = 0;   Voc: F = 0;   maximum power: F + (Vj - 2 F Rs) F' = 0,
// where F(Vj, p) is the current. NaN if the device gives no power.
KeyPointValues KeyPointsNear(const Device& device, const double* p, const KeyPointValues& near,
                             double* slopes);

}  // namespace lyrefit
