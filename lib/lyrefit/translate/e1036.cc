#include "lyrefit/translate/e1036.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/roots.h"

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

}  // namespace lyrefit
