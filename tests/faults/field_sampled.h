#pragma once

#include <functional>
#include <vector>

#include "faults/field_cell.h"

namespace faults::field {

// A falling curve as points with slopes, with rising currents and falling voltages. Between two
// points it is the cubic Hermite interpolant, of voltage over current or of current over voltage.
struct Sampled {
  std::vector<Point> points;

  double VoltageAt(double current) const;
  double CurrentAt(double voltage) const;
  Point PointAtCurrent(double current) const;  // with its slope
  Point PointAtVoltage(double voltage) const;
};

// Largest product of voltage and current.
double MaximumPower(const Sampled& curve);

// Samples `law` from `low` to `high`. Intervals are halved until the cubic is accurate to
// `tolerance` in current.
Sampled Sample(const std::function<Point(double current)>& law, double low, double high,
               double tolerance);

// Series connection adds voltages; parallel connection adds currents. The result covers the range
// that all parts cover.
Sampled InSeries(const std::vector<const Sampled*>& parts);
Sampled SideBySide(const std::vector<const Sampled*>& parts);

}  // namespace faults::field
