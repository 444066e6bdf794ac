#pragma once

#include <functional>
#include <vector>

#include "hidden/field_cell.h"

namespace hidden::field {

// A falling curve by points with their slopes, currents rising and voltages falling; in between a
// cubic through both ends with both slopes, in whichever direction it is read.
struct Sampled {
  std::vector<Point> points;

  double VoltageAt(double current) const;
  double CurrentAt(double voltage) const;
  Point PointAtCurrent(double current) const;  // with its slope
  Point PointAtVoltage(double voltage) const;
};

// Points of `law` over low..high, halved until the cubic is right to `tolerance` of current.
Sampled Sample(const std::function<Point(double current)>& law, double low, double high,
               double tolerance);

// One after the other: voltages add. Side by side: currents add. Both hold where all parts do.
Sampled InSeries(const std::vector<const Sampled*>& parts);
Sampled SideBySide(const std::vector<const Sampled*>& parts);

}  // namespace hidden::field
