#include "lyrefit/model/current.h"

#include <cmath>

#include "lyrefit/model/kernel.h"
#include "lyrefit/model/solve.h"

namespace lyrefit {

OperatingPoint SolveOperatingPoint(const Device& device, const double* p, double voltage_V) {
  const PreparedDevice prepared = Prepare(device, p);
  const double limit = JunctionVoltageLimit(prepared, voltage_V);
  OperatingPoint point;
  point.junction_voltage_V = voltage_V + prepared.rs * prepared.largest_current;
  SolveTogether<1>(prepared, limit, &voltage_V, &point.junction_voltage_V, &point.current_A);
  BentCurrent<double> bent;
  PreparedBent<1>(prepared, &point.junction_voltage_V, &bent);
  point.conductance_S = bent.slope;
  return point;
}

OperatingPoint KnownOperatingPoint(const Device& device, const double* p, double voltage_V,
                                   double current_A) {
  OperatingPoint point;
  point.current_A = current_A;
  point.junction_voltage_V = voltage_V + current_A * p[device.resistance_series];
  point.conductance_S = JunctionCurrent(device, p, Dual<1>(point.junction_voltage_V, 0)).v[0];
  return point;
}

double Rmse(const Device& device, Objective objective, const double* p,
            const std::vector<double>& voltage_V, const std::vector<double>& current_A) {
  return std::sqrt(MeanSquare(device, objective, p, MakePointSet(voltage_V, current_A)));
}

}  // namespace lyrefit
