#include "faults/field_misfit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace faults::field {
namespace {

struct Curve {
  const std::vector<double>& voltage;
  const std::vector<double>& current;
  double open;  // largest voltage
  double ohm;   // open / largest current
};

using Two = std::array<double, 2>;  // log(scale / open), root of series ohm / ohm

// Linear least squares over photocurrent, saturation current and shunt conductance. The saturation
// current is in units of its value at the largest junction voltage. Parameters that would be
// negative are left out.
struct Linear {
  std::array<double, 3> x;
  bool ok;
};

Linear Solve(const double (&normal)[3][4], const std::array<bool, 3>& used) {
  double a[3][4];
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) {
      const bool own = used[r] && (c == 3 || used[c]);
      a[r][c] = own ? normal[r][c] : (r == c ? 1.0 : 0.0);
    }
  }
  for (int k = 0; k < 3; ++k) {
    for (int r = k + 1; r < 3; ++r) {
      const double factor = a[r][k] / a[k][k];
      for (int c = k; c < 4; ++c) a[r][c] -= factor * a[k][c];
    }
  }
  Linear linear{{}, true};
  for (int k = 2; k >= 0; --k) {
    double rest = a[k][3];
    for (int c = k + 1; c < 3; ++c) rest -= a[k][c] * linear.x[c];
    linear.x[k] = rest / a[k][k];
    linear.ok &= linear.x[k] >= 0;
  }
  return linear;
}

OneDiode Best(const Curve& curve, const Two& at) {
  OneDiode diode;
  diode.scale_V = curve.open * std::exp(at[0]);
  diode.series_ohm = curve.ohm * at[1] * at[1];
  double top = 0;
  for (std::size_t i = 0; i < curve.voltage.size(); ++i) {
    top = std::max(top, curve.voltage[i] + curve.current[i] * diode.series_ohm);
  }
  for (int pass = 0; pass < 3; ++pass) {
    double normal[3][4] = {};
    for (std::size_t i = 0; i < curve.voltage.size(); ++i) {
      const double junction = curve.voltage[i] + curve.current[i] * diode.series_ohm;
      const double e = std::exp((junction - top) / diode.scale_V);
      const double slope =
          diode.saturation_A * std::exp(junction / diode.scale_V) / diode.scale_V + diode.shunt_S;
      const double weight = std::pow(1 + slope * diode.series_ohm, -2);
      const double row[4] = {1, -e, -junction / curve.ohm, curve.current[i]};
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 4; ++c) normal[r][c] += weight * row[r] * row[c];
      }
    }
    Linear linear = Solve(normal, {true, true, true});
    if (!linear.ok) linear = Solve(normal, {true, true, false});
    if (!linear.ok) linear = Solve(normal, {true, false, true});
    diode.photocurrent = linear.x[0];
    diode.saturation_A = linear.x[1] * std::exp(-top / diode.scale_V);
    diode.shunt_S = linear.x[2] / curve.ohm;
  }
  return diode;
}

double Rms(const Curve& curve, const Two& at) {
  if (at[0] < -6 || at[0] > 0 || std::fabs(at[1]) > 1) return std::numeric_limits<double>::max();
  const OneDiode diode = Best(curve, at);
  double sum = 0;
  for (std::size_t i = 0; i < curve.voltage.size(); ++i) {
    const double off = CurrentOf(diode, curve.voltage[i], curve.current[i]) - curve.current[i];
    sum += off * off;
  }
  return std::sqrt(sum / static_cast<double>(curve.voltage.size()));
}

struct Corner {
  Two at;
  double rms;
};

Two Along(const Two& from, const Two& to, double part) {
  return {from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])};
}

Corner Descend(const Curve& curve, const Two& start) {
  std::array<Corner, 3> corners;
  const Two strides[] = {{0, 0}, {0.15, 0}, {0, 0.05}};
  for (int k = 0; k < 3; ++k) {
    const Two at = {start[0] + strides[k][0], start[1] + strides[k][1]};
    corners[k] = {at, Rms(curve, at)};
  }
  const auto better = [](const Corner& a, const Corner& b) { return a.rms < b.rms; };
  const auto at = [&](const Two& place) { return Corner{place, Rms(curve, place)}; };
  for (int i = 0; i < 120; ++i) {
    std::sort(corners.begin(), corners.end(), better);
    if (corners[2].rms < (1 + 1e-5) * corners[0].rms) break;
    const Two middle = Along(corners[0].at, corners[1].at, 0.5);
    const Corner mirrored = at(Along(corners[2].at, middle, 2));
    if (mirrored.rms < corners[0].rms) {
      const Corner farther = at(Along(corners[2].at, middle, 3));
      corners[2] = std::min(mirrored, farther, better);
    } else if (mirrored.rms < corners[1].rms) {
      corners[2] = mirrored;
    } else {
      const Corner inner = at(Along(std::min(mirrored, corners[2], better).at, middle, 0.5));
      if (inner.rms < corners[2].rms) {
        corners[2] = inner;
      } else {
        for (int k = 1; k < 3; ++k) corners[k] = at(Along(corners[0].at, corners[k].at, 0.5));
      }
    }
  }
  return *std::min_element(corners.begin(), corners.end(), better);
}

}  // namespace

double CurrentOf(const OneDiode& diode, double voltage, double guess) {
  double current = guess;
  for (int i = 0; i < 60; ++i) {
    const double junction = voltage + current * diode.series_ohm;
    const double e = diode.saturation_A * std::exp(junction / diode.scale_V);
    const double off =
        diode.photocurrent - (e - diode.saturation_A) - diode.shunt_S * junction - current;
    const double fall = 1 + diode.series_ohm * (e / diode.scale_V + diode.shunt_S);
    double step = off / fall;  // limits the exponent to a rise of two scales
    if (diode.series_ohm > 0) step = std::min(step, 2 * diode.scale_V / diode.series_ohm);
    current += step;
    if (std::fabs(step) < 1e-12 * (diode.photocurrent + std::fabs(current))) break;
  }
  return current;
}

OneDiodeFit BestOneDiode(const std::vector<double>& voltage, const std::vector<double>& current) {
  const double open = *std::max_element(voltage.begin(), voltage.end());
  const double largest = *std::max_element(current.begin(), current.end());
  const Curve curve{voltage, current, open, open / largest};
  std::vector<Corner> starts;
  for (const double scale : {-3.9, -3.4, -2.9, -2.4, -1.8}) {
    for (const double series : {0.05, 0.17, 0.3}) {
      starts.push_back({{scale, series}, Rms(curve, {scale, series})});
    }
  }
  const auto better = [](const Corner& a, const Corner& b) { return a.rms < b.rms; };
  std::sort(starts.begin(), starts.end(), better);
  Corner best = std::min(Descend(curve, starts[0].at), Descend(curve, starts[1].at), better);
  best = Descend(curve, best.at);  // restart, in case the simplex collapsed too early
  OneDiodeFit fit{Best(curve, best.at), best.rms, {}};
  for (std::size_t i = 0; i < voltage.size(); ++i) {
    fit.residuals.push_back(CurrentOf(fit.diode, voltage[i], current[i]) - current[i]);
  }
  return fit;
}

}  // namespace faults::field
