#include "lyrefit/translate/complete_curve.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/groups.h"
#include "lyrefit/base/numbers.h"

namespace lyrefit {
namespace {

constexpr int kMostSteps = 400;

double JunctionCurrentOf(const SingleDiodeFit& d, double junction_V) {
  return d.photocurrent_A - d.saturation_current_A * std::expm1(junction_V / d.nNsVth_V) -
         junction_V / d.resistance_shunt_ohm;
}

// The junction voltage at which the diode delivers this current. The current falls ever faster with
// voltage. Newton's iteration therefore approaches the root from the right and overshoots at most
// in its first step.
double JunctionAt(const SingleDiodeFit& d, double current_A) {
  const double through_diode = d.photocurrent_A - current_A;
  // Start without shunt current; if the diode cannot carry the current, with all of it in the
  // shunt.
  const double alone = through_diode / d.saturation_current_A;
  double v = alone > -0.5 ? d.nNsVth_V * std::log1p(alone)
                          : (through_diode + d.saturation_current_A) * d.resistance_shunt_ohm;
  if (!std::isfinite(v)) return kUnknown;
  for (int k = 0; k < 60; ++k) {
    const double rise = d.saturation_current_A * std::expm1(v / d.nNsVth_V);
    const double off = through_diode - rise - v / d.resistance_shunt_ohm;
    const double slope = (rise + d.saturation_current_A) / d.nNsVth_V + 1 / d.resistance_shunt_ohm;
    const double step = off / slope;
    v += step;
    if (!(std::fabs(step) > 1e-14 * (std::fabs(v) + d.nNsVth_V))) break;
  }
  return v;
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
