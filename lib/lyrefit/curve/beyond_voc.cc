#include "lyrefit/curve/beyond_voc.h"

#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/median.h"
#include "lyrefit/curve/dark.h"
#include "lyrefit/curve/key_points.h"

namespace lyrefit {
namespace {

// The misfit of diode models is 0.05 to 0.3 % of Isc for healthy devices, up to some 2 % for noisy
// or drifting ones (see WhyNotUsable).
constexpr double kHealthyMisfit = 0.01;  // of Isc
constexpr double kWorse = 5;             // of the misfit up to Voc
constexpr double kKnee = 0.05;           // of Isc: the least junction current that is used
constexpr double kLeastLogarithm = 6;    // ln(Isc / Is) = Voc / n Vt of what is a diode at all
constexpr std::size_t kFewest = 6;       // readings that three parameters are judged by

// A reading on the diode's side of the knee.
struct KneeReading {
  double voltage_V;
  double forward_A;   // -I
  double junction_A;  // current of the diode: photocurrent minus I and the shunt's
};

// Least-squares line of the current over voltage, up to a fraction of Voc: photocurrent and shunt.
std::pair<double, double> LineUpToKnee(const IvCurve& curve, const KeyPoints& key) {
  constexpr double kTo = 0.4;  // of Voc, on both sides of 0 V
  const double to_V = kTo * key.open_circuit_voltage_V;
  double count = 0, v = 0, i = 0, vv = 0, vi = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    if (std::fabs(curve.voltage_V[k]) > to_V) continue;
    count += 1;
    v += curve.voltage_V[k];
    i += curve.current_A[k];
    vv += curve.voltage_V[k] * curve.voltage_V[k];
    vi += curve.voltage_V[k] * curve.current_A[k];
  }
  const double spread = vv - v * v / std::max(count, 1.0);
  if (!(spread > 0)) return {key.short_circuit_current_A, 0};
  const double slope = std::min((vi - v * i / count) / spread, 0.0);
  return {(i - slope * v) / count, slope};
}

// Largest forward current that is not held: three readings and more at the same one are a limit of
// the source, which says nothing of the diode.
double LargestNotHeld_A(const IvCurve& curve, double isc_A) {
  constexpr double kEqual = 2e-4;  // of Isc
  constexpr int kFewest = 3;
  const double least_A = *std::min_element(curve.current_A.begin(), curve.current_A.end());
  const auto held = std::count_if(curve.current_A.begin(), curve.current_A.end(),
                                  [&](double i_A) { return i_A < least_A + kEqual * isc_A; });
  return held < kFewest ? HUGE_VAL : -least_A - kEqual * isc_A;
}

// Readings on the diode's side of the knee, by rising voltage.
std::vector<KneeReading> KneeOf(const IvCurve& curve, const KeyPoints& key) {
  const auto [photo_A, slope] = LineUpToKnee(curve, key);
  const double most_A = LargestNotHeld_A(curve, key.short_circuit_current_A);
  std::vector<KneeReading> knee;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double voltage_V = curve.voltage_V[k], current_A = curve.current_A[k];
    const double junction_A = photo_A + slope * voltage_V - current_A;
    if (!(voltage_V > 0) || !(junction_A > kKnee * key.short_circuit_current_A)) continue;
    if (-current_A > most_A) continue;
    knee.push_back({voltage_V, -current_A, junction_A});
  }
  std::stable_sort(knee.begin(), knee.end(), [](const KneeReading& a, const KneeReading& b) {
    return a.voltage_V < b.voltage_V;
  });
  return knee;
}

// Junction that describes readings best.
struct Junction {
  double misfit_A = HUGE_VAL;  // root mean square of the residuals; infinite: none describes them
  double thermal_V = 0;        // b: n Vt of all cells
};

// Junction of the first `count` readings. Voltages are regressed, with the weights of currents: dV/dI
// is Rs + b / J.
Junction JunctionOf(const std::vector<KneeReading>& knee, std::size_t count) {
  constexpr int kRounds = 6;
  double rs = 0, b = 1;
  Junction junction;
  for (int round = 0; round < kRounds; ++round) {
    const auto rows = static_cast<Eigen::Index>(count);
    for (const bool resistance : {true, false}) {
      Eigen::MatrixXd a(rows, resistance ? 3 : 2);
      Eigen::VectorXd y(rows);
      for (Eigen::Index k = 0; k < rows; ++k) {
        const KneeReading& one = knee[static_cast<std::size_t>(k)];
        const double weight = round == 0 ? 1 : 1 / (rs + b / one.junction_A);
        a(k, 0) = weight;
        a(k, 1) = weight * std::log(one.junction_A);
        if (resistance) a(k, 2) = weight * one.forward_A;
        y(k) = weight * one.voltage_V;
      }
      const Eigen::VectorXd found = LeastSquares(a, y);
      if (resistance && !(found(2) >= 0 && found(1) > 0)) continue;
      if (!(found(1) > 0)) return {};
      b = found(1);
      junction = {Residual(y, a, found).norm() / std::sqrt(static_cast<double>(count)), b};
      rs = resistance ? found(2) : 0;
      break;
    }
  }
  return junction;
}

}  // namespace

BeyondVoc FindBeyondVoc(const IvCurve& curve) {
  BeyondVoc found;
  const KeyPoints key = FindKeyPoints(curve.voltage_V, curve.current_A);
  const double isc_A = key.short_circuit_current_A;
  if (!(isc_A > 0) || !(key.open_circuit_voltage_V > 0) || curve.suns_voc_A || IsDark(curve)) {
    return found;
  }
  const std::vector<KneeReading> knee = KneeOf(curve, key);
  for (const KneeReading& one : knee) found.largest_A = std::max(found.largest_A, one.forward_A);
  if (!(found.largest_A > isc_A)) return found;
  // The readings up to Voc and the first beyond, by which Voc is interpolated.
  std::size_t to_voc = 0;
  while (to_voc < knee.size() && knee[to_voc].voltage_V < key.open_circuit_voltage_V) ++to_voc;
  const std::size_t judged = std::max(++to_voc, kFewest);
  if (judged >= knee.size()) return found;
  const Junction up_to_voc = JunctionOf(knee, judged);
  if (!(up_to_voc.thermal_V * kLeastLogarithm < key.open_circuit_voltage_V)) return found;
  const double most_A = std::max(kHealthyMisfit * isc_A, kWorse * up_to_voc.misfit_A);
  if (!(JunctionOf(knee, knee.size()).misfit_A > most_A)) return found;
  found.last_V = knee[to_voc - 1].voltage_V;
  for (const double voltage_V : curve.voltage_V) found.left_out += voltage_V > found.last_V ? 1 : 0;
  return found;
}

IvCurve WithoutBeyondVoc(IvCurve curve) {
  if (curve.as_is) return curve;
  const BeyondVoc beyond = FindBeyondVoc(curve);
  if (beyond.left_out == 0) return curve;
  const double isc_A = FindKeyPoints(curve.voltage_V, curve.current_A).short_circuit_current_A;
  std::vector<int> kept;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    if (curve.voltage_V[k] <= beyond.last_V) kept.push_back(static_cast<int>(k));
  }
  KeepReadings(kept, &curve);
  curve.assumptions.push_back(fmt::format(
      "{} readings beyond Voc, above {:.4g} V and with a forward current of up to {:.3g} times "
      "Isc, "
      "were left out: the diode that describes the readings up to there does not describe them "
      "(injection, leads, another conduction, a limit of the instrument or wrong readings; --as-is "
      "takes them)",
      beyond.left_out, beyond.last_V, beyond.largest_A / isc_A));
  return curve;
}

namespace {

constexpr std::size_t kFewestPoints = 10;  // bins with readings
constexpr int kBins = 64;
constexpr double kDeep = 0.02;  // of the largest current
constexpr double kNoises = 6;

struct StepPoint {
  double voltage_V = 0;
  double current_A = 0;
};

double Median3(double a, double b, double c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

// Currents at forward voltage up to the last delivering voltage, as means over equal voltage bins.
// Binning merges sweeps up and down and repeated readings at one voltage.
std::vector<StepPoint> Binned(const IvCurve& curve) {
  double last_V = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    if (curve.current_A[k] > 0) last_V = std::max(last_V, curve.voltage_V[k]);
  }
  struct VoltageBin {
    double voltage_V = 0, current_A = 0;
    int readings = 0;
  };
  std::vector<VoltageBin> bins(kBins);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double voltage_V = curve.voltage_V[k];
    if (voltage_V < 0 || voltage_V > last_V || !(last_V > 0)) continue;
    VoltageBin& bin = bins[std::min(static_cast<int>(voltage_V / last_V * kBins), kBins - 1)];
    bin.voltage_V += voltage_V;
    bin.current_A += curve.current_A[k];
    ++bin.readings;
  }
  std::vector<StepPoint> points;
  for (const VoltageBin& bin : bins) {
    if (bin.readings == 0) continue;
    points.push_back({bin.voltage_V / bin.readings, bin.current_A / bin.readings});
  }
  return points;
}

// Removes single outliers by a running median of three.
std::vector<StepPoint> Smooth(const std::vector<StepPoint>& points) {
  std::vector<StepPoint> smooth = points;
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    smooth[k].current_A =
        Median3(points[k - 1].current_A, points[k].current_A, points[k + 1].current_A);
  }
  return smooth;
}

// Standard deviation of the noise from the median second difference, which knees and steps hardly
// affect.
double NoiseOf(const std::vector<StepPoint>& points) {
  std::vector<double> differences;
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    differences.push_back(points[k - 1].current_A - 2 * points[k].current_A +
                          points[k + 1].current_A);
  }
  return RobustScale(std::move(differences), UpperMedian) / std::sqrt(6.0);
}

// Whether b lies on or below the line from a to c.
bool Below(const StepPoint& a, const StepPoint& b, const StepPoint& c) {
  return (b.current_A - a.current_A) * (c.voltage_V - a.voltage_V) <=
         (c.current_A - a.current_A) * (b.voltage_V - a.voltage_V);
}

std::vector<StepPoint> UpperHull(const std::vector<StepPoint>& points) {
  std::vector<StepPoint> hull;
  for (const StepPoint& point : points) {
    while (hull.size() > 1 && Below(hull[hull.size() - 2], hull.back(), point)) hull.pop_back();
    hull.push_back(point);
  }
  return hull;
}

}  // namespace

std::optional<CurveStep> FindStep(const IvCurve& curve) {
  const std::vector<StepPoint> binned = Binned(curve);
  if (binned.size() < kFewestPoints) return std::nullopt;
  const std::vector<StepPoint> points = Smooth(binned);
  const std::vector<StepPoint> hull = UpperHull(points);
  CurveStep step;
  double largest_A = 0;
  std::size_t right = 1;
  for (const StepPoint& point : points) {
    largest_A = std::max(largest_A, point.current_A);
    while (right + 1 < hull.size() && hull[right].voltage_V < point.voltage_V) ++right;
    const StepPoint& a = hull[right - 1];
    const StepPoint& b = hull[right];
    const double part = (point.voltage_V - a.voltage_V) / (b.voltage_V - a.voltage_V);
    const double depth_A = a.current_A + part * (b.current_A - a.current_A) - point.current_A;
    if (depth_A > step.depth_A) step = {point.voltage_V, depth_A};
  }
  if (step.depth_A <= kDeep * largest_A || step.depth_A <= kNoises * NoiseOf(binned)) {
    return std::nullopt;
  }
  return step;
}

}  // namespace lyrefit
