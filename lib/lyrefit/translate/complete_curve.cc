#include "lyrefit/translate/complete_curve.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/groups.h"
#include "lyrefit/model/single_diodes.h"

namespace lyrefit {
namespace {

constexpr int kMostSteps = 400;

// The diode without its series resistance: its voltage is that of the junction.
SingleDiodes JunctionOf(const SingleDiodeFit& d) {
  static constexpr double kNone = 0;
  return {1,        {&d.photocurrent_A},       {&d.saturation_current_A},
          {&kNone}, {&d.resistance_shunt_ohm}, {&d.nNsVth_V}};
}

double JunctionCurrentOf(const SingleDiodeFit& d, double junction_V) {
  double current_A = 0;
  CurrentsAt(JunctionOf(d), {&junction_V}, &current_A);
  return current_A;
}

double JunctionAt(const SingleDiodeFit& d, double current_A) {
  double junction_V = 0;
  VoltagesAt(JunctionOf(d), {&current_A}, &junction_V);
  return junction_V;
}

// Adds points from the last reading to lower currents.
void BeyondOpenCircuit(const SingleDiodeFit& d, double lowest_A, CurvePoints* points) {
  const double last_V = points->voltage_V.back(), last_A = points->current_A.back();
  if (last_A <= lowest_A) return;
  const double start = JunctionAt(d, last_A);
  const double shift = last_V - (start - last_A * d.resistance_series_ohm);
  for (int k = 1; k <= kMostSteps; ++k) {
    const double junction = start + 0.05 * k * d.nNsVth_V;
    const double current = JunctionCurrentOf(d, junction);
    points->voltage_V.push_back(junction - current * d.resistance_series_ohm + shift);
    points->current_A.push_back(current);
    if (current <= lowest_A) return;
  }
}

// Adds points from the first reading to lower voltages, where the diode's slope is nearly constant.
void BeyondShortCircuit(const SingleDiodeFit& d, double lowest_V, CurvePoints* points) {
  const double first_V = points->voltage_V.front(), first_A = points->current_A.front();
  if (first_V <= lowest_V) return;
  constexpr int kSteps = 5;
  const double start = first_V + first_A * d.resistance_series_ohm;
  const double shift = first_A - JunctionCurrentOf(d, start);
  CurvePoints below;
  for (int k = kSteps; k >= 1; --k) {
    const double junction = start + (lowest_V - first_V) * k / kSteps;
    const double current = JunctionCurrentOf(d, junction) + shift;
    below.voltage_V.push_back(junction - current * d.resistance_series_ohm);
    below.current_A.push_back(current);
  }
  points->voltage_V.insert(points->voltage_V.begin(), below.voltage_V.begin(),
                           below.voltage_V.end());
  points->current_A.insert(points->current_A.begin(), below.current_A.begin(),
                           below.current_A.end());
}

}  // namespace

CurvePoints ByVoltage(CurvePoints points) {
  if (std::is_sorted(points.voltage_V.begin(), points.voltage_V.end())) return points;
  CurvePoints sorted;
  for (const int i : RisingOrder(points.voltage_V)) {
    sorted.voltage_V.push_back(points.voltage_V[i]);
    sorted.current_A.push_back(points.current_A[i]);
  }
  return sorted;
}

CurvePoints Completed(const CurvePoints& points, const SingleDiodeFit& diode, double lowest_V,
                      double lowest_A) {
  CurvePoints whole = points;
  if (whole.voltage_V.empty()) return whole;
  BeyondOpenCircuit(diode, lowest_A, &whole);
  BeyondShortCircuit(diode, lowest_V, &whole);
  return whole;
}

}  // namespace lyrefit
