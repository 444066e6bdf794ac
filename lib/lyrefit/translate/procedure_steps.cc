#include "lyrefit/translate/procedure_steps.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/groups.h"
#include "lyrefit/base/roots.h"
#include "lyrefit/model/single_diodes.h"

namespace lyrefit {
namespace {

constexpr int kDegree = 4;

struct Window {
  std::vector<double> x;
  std::vector<double> y;
  void Add(double its_x, double its_y) {
    x.push_back(its_x);
    y.push_back(its_y);
  }
};

// Coefficients of the least-squares polynomial of the window, constant first. None where the window
// has fewer than degree + 1 distinct x.
std::optional<Eigen::VectorXd> Polynomial(const Window& window, int degree) {
  const int rows = static_cast<int>(window.x.size());
  std::vector<double> places = window.x;
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  if (static_cast<int>(places.size()) < degree + 1) return std::nullopt;
  Eigen::MatrixXd powers(rows, degree + 1);
  Eigen::VectorXd y(rows);
  for (int i = 0; i < rows; ++i) {
    double power = 1;
    for (int k = 0; k <= degree; ++k, power *= window.x[i]) powers(i, k) = power;
    y(i) = window.y[i];
  }
  return LeastSquares(powers, y);
}

double ValueAt(const Eigen::VectorXd& coefficients, double x) {
  double value = 0;
  for (int k = static_cast<int>(coefficients.size()) - 1; k >= 0; --k) {
    value = value * x + coefficients(k);
  }
  return value;
}

// Position of the polynomial's maximum within the window: an even grid, then Brent's method. None
// where the maximum of the grid is at an end.
std::optional<double> Top(const Eigen::VectorXd& coefficients, double low, double high) {
  constexpr int kGrid = 200;
  int best = 0;
  const auto place = [&](int i) { return low + (high - low) * i / kGrid; };
  for (int i = 1; i <= kGrid; ++i) {
    if (ValueAt(coefficients, place(i)) > ValueAt(coefficients, place(best))) best = i;
  }
  if (best == 0 || best == kGrid) return std::nullopt;
  const auto value = [&](double x) { return ValueAt(coefficients, x); };
  return MaximumBetween(value, place(best - 1), place(best + 1));
}

}  // namespace

KeyPoints E1036KeyPoints(const std::vector<double>& voltage_V,
                         const std::vector<double>& current_A) {
  KeyPoints key = FindKeyPoints(voltage_V, current_A);
  const KeyPoints first = key;
  const double isc = first.short_circuit_current_A, voc = first.open_circuit_voltage_V;
  const double imp = first.max_power_current_A, vmp = first.max_power_voltage_V;
  Window short_circuit, open_circuit, power;
  for (std::size_t i = 0; i < voltage_V.size(); ++i) {
    const double v = voltage_V[i], current = current_A[i];
    if (std::fabs(v) <= 0.2 * voc && current >= 0.96 * isc) short_circuit.Add(v, current);
    if (std::fabs(current) <= 0.2 * isc && v >= 0.9 * voc) open_circuit.Add(current / isc, v);
    if (current >= 0.75 * imp && current <= 1.15 * imp && v >= 0.75 * vmp && v <= 1.15 * vmp) {
      power.Add(v / vmp - 1, v * current);
    }
  }
  if (const auto line = Polynomial(short_circuit, 1)) key.short_circuit_current_A = (*line)(0);
  if (const auto line = Polynomial(open_circuit, 1)) key.open_circuit_voltage_V = (*line)(0);
  if (const auto curve = Polynomial(power, kDegree)) {
    const auto ends = std::minmax_element(power.x.begin(), power.x.end());
    if (const auto top = Top(*curve, *ends.first, *ends.second)) {
      key.max_power_voltage_V = vmp * (1 + *top);
      key.max_power_W = ValueAt(*curve, *top);
      key.max_power_current_A = key.max_power_W / key.max_power_voltage_V;
    }
  }
  const double ideal_W = key.short_circuit_current_A * key.open_circuit_voltage_V;
  if (ideal_W > 0) key.fill_factor = key.max_power_W / ideal_W;
  return key;
}

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
