// Experimental: may change in a minor version (data/stable).
#pragma once

#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/model/parameter.h"

// A device of two unlike junctions in series with one series resistance (a monolithic tandem of two
// terminals), in ampere and volt. Junction j (1: top, 2: bottom) has the voltage V_j at which it
// delivers the common current I:
//
//   Iph_j - Is_j (exp(V_j / (n_j Vt)) - 1) - V_j / Rsh_j = I,     V = V_1(I) + V_2(I) - I Rs
//
// Each V_j falls with I and is concave, and so is V. Newton's method in I therefore converges
// monotonically from the right. string.h solves cells in series whose diodes are alike.
namespace LYREFIT_PUBLIC lyrefit {

// Positions in a parameter vector: Iph1, Is1, n1, Rsh1, Iph2, Is2, n2, Rsh2, Rs. `junction`: 0, 1.
constexpr int kTwoJunctionParameters = 9;
constexpr int JunctionPhotocurrent(int junction) { return 4 * junction; }
constexpr int JunctionSaturation(int junction) { return 4 * junction + 1; }
constexpr int JunctionIdeality(int junction) { return 4 * junction + 2; }
constexpr int JunctionShunt(int junction) { return 4 * junction + 3; }
constexpr int kTwoJunctionSeries = 8;

// Symbols, names, units and kinds of the parameters, in their order.
std::vector<ParameterInfo> TwoJunctionInfos();

// Current in ampere at terminal voltage `voltage_V`; `thermal_voltage_V` is kT/q. `slopes`, if not
// null, receives the derivatives by the parameters, which follow from the implicit equations. Every
// junction keeps a conductance of 1e-13 of its photocurrent per volt. A start near the root, such as
// the current of a neighbouring reading, saves time; NaN: none.
double TwoJunctionCurrent(double thermal_voltage_V, const double* p, double voltage_V,
                          double* slopes = nullptr, double start_A = kUnknown);

// Terminal voltage in volt at a current.
double TwoJunctionVoltage(double thermal_voltage_V, const double* p, double current_A);

// Isc, Voc and the maximum power point, with a relative error of about 1e-9. Voc and all that
// depends on it is NaN if the device gives no power.
KeyPoints TwoJunctionKeyPoints(double thermal_voltage_V, const double* p);

}  // namespace lyrefit
