#include "faults/field_sampled.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faults::field {
namespace {

// Sets an end slope to zero, or limits it, where the cubic would not be monotonic.
double Tamed(double slope, double chord) {
  return slope * chord <= 0
             ? 0
             : std::copysign(std::min(std::fabs(slope), 3 * std::fabs(chord)), chord);
}

struct Read {
  double value;
  double slope;
};

// Cubic Hermite interpolant from (x0, y0) to (x1, y1) at x; a straight line beyond the ends.
Read Cubic(double x0, double y0, double s0, double x1, double y1, double s1, double x) {
  const double width = x1 - x0;
  const double t = (x - x0) / width;
  if (t <= 0) return {y0 + s0 * (x - x0), s0};
  if (t >= 1) return {y1 + s1 * (x - x1), s1};
  const double chord = (y1 - y0) / width;
  const double a = Tamed(s0, chord), b = Tamed(s1, chord);
  const double c = 3 * chord - 2 * a - b, d = a + b - 2 * chord;
  return {y0 + width * t * (a + t * (c + t * d)), a + t * (2 * c + 3 * t * d)};
}

Read VoltageBetween(const Point& p, const Point& q, double current) {
  return Cubic(p.current, p.voltage, p.slope, q.current, q.voltage, q.slope, current);
}

Read CurrentBetween(const Point& p, const Point& q, double voltage) {
  return Cubic(p.voltage, p.current, 1 / p.slope, q.voltage, q.current, 1 / q.slope, voltage);
}

// Index of the first point of the piece that contains x.
template <class Before>
std::size_t Piece(const std::vector<Point>& points, double x, const Before& before) {
  const auto after = std::upper_bound(points.begin(), points.end(), x, before);
  const std::ptrdiff_t last = static_cast<std::ptrdiff_t>(points.size()) - 2;
  return std::clamp<std::ptrdiff_t>(after - points.begin() - 1, 0, last);
}

std::size_t PieceOfCurrent(const std::vector<Point>& points, double current) {
  return Piece(points, current, [](double x, const Point& p) { return x < p.current; });
}

std::size_t PieceOfVoltage(const std::vector<Point>& points, double voltage) {
  return Piece(points, voltage, [](double x, const Point& p) { return x > p.voltage; });
}

bool Good(const Point& p, const Point& q, const Point& middle, double tolerance) {
  const double by_voltage = CurrentBetween(p, q, middle.voltage).value - middle.current;
  const double by_current = VoltageBetween(p, q, middle.current).value - middle.voltage;
  return std::fabs(by_voltage) < tolerance && std::fabs(by_current / middle.slope) < tolerance;
}

void Halve(const std::function<Point(double)>& law, const Point& p, const Point& q,
           double tolerance, int depth, std::vector<Point>* points) {
  const Point middle = law(0.5 * (p.current + q.current));
  if (depth > 4 && (depth > 34 || Good(p, q, middle, tolerance))) {
    points->push_back(p);
    points->push_back(middle);
    return;
  }
  Halve(law, p, middle, tolerance, depth + 1, points);
  Halve(law, middle, q, tolerance, depth + 1, points);
}

// Coordinates of the points of all parts within their common range, without near duplicates.
std::vector<double> Places(const std::vector<const Sampled*>& parts,
                           double (*place)(const Point&)) {
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  std::vector<double> all;
  for (const Sampled* part : parts) {
    const double first = place(part->points.front()), last = place(part->points.back());
    low = std::max(low, std::min(first, last));
    high = std::min(high, std::max(first, last));
    for (const Point& point : part->points) all.push_back(place(point));
  }
  std::sort(all.begin(), all.end());
  std::vector<double> kept;
  for (const double x : all) {
    if (x < low || x > high) continue;
    if (kept.empty() || x - kept.back() > 1e-13 * (high - low)) kept.push_back(x);
  }
  return kept;
}

}  // namespace

Point Sampled::PointAtCurrent(double current) const {
  const std::size_t i = PieceOfCurrent(points, current);
  const Read read = VoltageBetween(points[i], points[i + 1], current);
  return {current, read.value, read.slope};
}

Point Sampled::PointAtVoltage(double voltage) const {
  const std::size_t i = PieceOfVoltage(points, voltage);
  const Read read = CurrentBetween(points[i], points[i + 1], voltage);
  return {read.value, voltage, 1 / read.slope};
}

double Sampled::VoltageAt(double current) const { return PointAtCurrent(current).voltage; }
double Sampled::CurrentAt(double voltage) const { return PointAtVoltage(voltage).current; }

double MaximumPower(const Sampled& curve) {
  constexpr int kSteps = 4000;
  const double end = curve.VoltageAt(0);
  double most = 0;
  for (int k = 0; k <= kSteps; ++k) {
    const double voltage = end * k / kSteps;
    most = std::max(most, voltage * curve.CurrentAt(voltage));
  }
  return most;
}

Sampled Sample(const std::function<Point(double)>& law, double low, double high, double tolerance) {
  Sampled sampled;
  const Point last = law(high);
  Halve(law, law(low), last, tolerance, 0, &sampled.points);
  sampled.points.push_back(last);
  return sampled;
}

Sampled InSeries(const std::vector<const Sampled*>& parts) {
  Sampled sum;
  for (const double current : Places(parts, [](const Point& p) { return p.current; })) {
    Point at{current, 0, 0};
    for (const Sampled* part : parts) {
      const Point own = part->PointAtCurrent(current);
      at.voltage += own.voltage;
      at.slope += own.slope;
    }
    sum.points.push_back(at);
  }
  return sum;
}

Sampled SideBySide(const std::vector<const Sampled*>& parts) {
  Sampled sum;
  for (const double voltage : Places(parts, [](const Point& p) { return p.voltage; })) {
    Point at{0, voltage, 0};
    for (const Sampled* part : parts) {
      const Point own = part->PointAtVoltage(voltage);
      at.current += own.current;
      at.slope += 1 / own.slope;
    }
    at.slope = 1 / at.slope;
    sum.points.push_back(at);
  }
  std::reverse(sum.points.begin(), sum.points.end());
  return sum;
}

}  // namespace faults::field
