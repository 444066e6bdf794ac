#include "lyrefit/certify/part_bound.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/certify/correlation.h"
#include "lyrefit/certify/real_data.h"

namespace lyrefit {
namespace {

using std::exp;
using std::max;
using std::sqrt;

// Excess of a mixture's diode columns, converted to columns scaled at `voltage`.
template <class Real>
Real Excess(const Mixture& mixture, const std::vector<Window>& windows, double voltage) {
  const Real above = Real(mixture.scale_voltage_V) - Real(voltage);
  if (Upper(above) <= 0 || mixture.excess == 0) return Real(mixture.excess);
  double u = 0;
  for (const Window& window : windows) u = std::max(u, window.upper);
  return Real(mixture.excess) * (Real(mixture.scale_voltage_V) / Real(voltage)) *
         exp(Real(u) * above);
}

// The largest coefficient of a linear term in a model that the bound of the dark current allows.
template <class Real>
double LargestCoefficient(const MixtureData& data, const LinearTerm& term,
                          const DarkCurrentBound& dark_bound, double known) {
  double largest = kInfinity;
  if (term.light()) {
    const ArrayOf<Real> allowed = RealArray<Real>(data.target_A) +
                                  sqrt(Real(2 * known)) / RealArray<Real>(data.weight) +
                                  Real(dark_bound.current_A);
    const double most = std::max(Upper(allowed.maxCoeff()), 0.0);
    for (const double lit : term.constant) {
      if (lit > 0) largest = std::min(largest, Upper(Real(most) / Real(lit)));
    }
  } else {
    const ArrayOf<Real> leak = -(RealArray<Real>(term.constant) +
                                 RealArray<Real>(term.per_volt) * Real(dark_bound.voltage_V));
    const Real least = leak.minCoeff();
    if (Lower(least) > 0) largest = Upper(Real(dark_bound.current_A) / least);
  }
  return std::min(largest, term.upper);
}

// The least of (1 - t) left + t right + t (1 - t) curvature for t in [0, 1], where `curvature` is
// not positive.
double LeastBetween(double left, double right, double curvature) {
  const double difference = right - left;
  const double t = std::min(std::max(0.5 * (1 + difference / curvature), 0.0), 1.0);
  return left + t * difference + t * (1 - t) * curvature;
}
// Lower bound in intervals. If the minimum is inside, it is
// left + (right - left + curvature)^2 / (4 curvature). That expression never exceeds the minimum.
double LeastBetween(const Interval& left, const Interval& right, const Interval& curvature) {
  const Interval l(Lower(left)), r(Lower(right)), c(Lower(curvature));
  if (Lower(abs(r - l) + c) >= 0) return std::min(Lower(l), Lower(r));
  return Lower(l + square(r - l + c) / (4.0 * c));
}

}  // namespace

template <class Real>
DarkCurrentBound BoundDarkCurrent(const MixtureData& data, double rs0, double rs1, double known) {
  const ArrayOf<Real> v0 = JunctionVoltage<Real>(data, rs0);
  const ArrayOf<Real> v1 = JunctionVoltage<Real>(data, rs1);
  // Bounds of each junction voltage over all Rs of the range.
  Eigen::ArrayXd least(v0.size()), most(v0.size());
  for (Eigen::Index k = 0; k < v0.size(); ++k) {
    least[k] = std::min(Lower(v0[k]), Lower(v1[k]));
    most[k] = std::max(Upper(v0[k]), Upper(v1[k]));
  }
  int high, low;
  const double v_high = least.maxCoeff(&high);
  const double v_low = std::max(0.0, most.minCoeff(&low));
  if (v_low >= v_high) return {kInfinity, v_high};
  if (!std::isfinite(known)) {
    known = Upper(Real(0.5) * WeightedArray<Real>(data, data.target_A).square().sum());
  }
  const Real allowed = sqrt(Real(2 * known)) *
                       (Real(1) / Real(data.weight[low]) + Real(1) / Real(data.weight[high]));
  const Real difference = Real(data.target_A[low]) - Real(data.target_A[high]) + allowed;
  const Real part = Real(1) - Real(v_low) / Real(v_high);
  if (!(Lower(part) > 0)) return {kInfinity, v_high};
  return {Upper(Real(std::max(Upper(difference), 0.0)) / part), v_high};
}

template <class Real>
PartBound BoundPart(const MixtureData& data, const std::vector<Window>& windows, const Mixture& a,
                    const Mixture& b, const DarkCurrentBound& dark_bound, double known) {
  PartBound bound{-kInfinity, std::min(a.dual, b.dual)};
  if (!std::isfinite(dark_bound.current_A)) return bound;
  const Real dr = Real(b.rs) - Real(a.rs);
  const ArrayOf<Real> step = RealArray<Real>(b.y) - RealArray<Real>(a.y);
  const Real current(dark_bound.current_A);
  Real left = Real(a.dual) - current * Excess<Real>(a, windows, dark_bound.voltage_V);
  Real right = Real(b.dual) - current * Excess<Real>(b, windows, dark_bound.voltage_V);
  Real bend(0);  // at t: (1 - t) left + t right + t (1 - t) / 2 (|step|^2 - bend)
  const ArrayOf<Real> per_ohm = WeightedArray<Real>(data, data.current_A);
  for (std::size_t j = 0; j < data.terms.size(); ++j) {
    const LinearTerm& term = data.terms[j];
    const auto index = static_cast<Eigen::Index>(j);
    const Real largest(LargestCoefficient<Real>(data, term, dark_bound, known));
    if (term.upper == kInfinity) {  // finite ranges are in the dual values already
      if (a.pulls[index] > 0) left -= Real(a.pulls[index]) * largest;
      if (b.pulls[index] > 0) right -= Real(b.pulls[index]) * largest;
    }
    if (term.light()) continue;
    // The pull exceeds its interpolation by t (1 - t) / 2 times this.
    const Real rise = Real(-2) * dr * (per_ohm * RealArray<Real>(term.per_volt) * step).sum();
    const Real highest(std::max(a.pulls[index], b.pulls[index]));
    const Real least = rise * Real(term.lower);
    const bool gains = Upper(highest + 0.125 * std::max(Upper(rise), 0.0)) > 0;
    bend += gains ? max(rise * largest, least) : least;
  }
  bound.lower = std::min(Lower(left), Lower(right));
  if (b.rs > a.rs) {
    bend += current * BoundBend<Real>(data, windows, a.rs, b.rs, a.y, b.y, dark_bound.voltage_V,
                                      a.saturation_pulls, b.saturation_pulls);
    const Real curvature = Real(0.5) * (step.square().sum() - bend);
    if (!(Lower(curvature) >= 0)) bound.lower = LeastBetween(left, right, curvature);
  }
  return bound;
}

void MakeSafe(const MixtureData& data, const std::vector<Window>& windows, double dark_bound_A,
              Mixture* mixture) {
  const Eigen::VectorXd& y = mixture->y;
  std::vector<WideInterval> weighted, wide_vd;
  ArrayOf<Interval> vd(y.size());  // one unit in the last place wide
  WideInterval dual(0);
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    const WideInterval yk(y[k]), current(data.current_A[k]);
    weighted.push_back(WideInterval(data.weight[k]) * yk);
    wide_vd.push_back(WideInterval(data.voltage_V[k]) + WideInterval(mixture->rs) * current);
    vd[k] = Hull(wide_vd.back());
    dual += weighted.back() * WideInterval(data.target_A[k]) - WideInterval(0.5) * yk * yk;
  }
  Interval lack(0);
  for (std::size_t j = 0; j < data.terms.size(); ++j) {
    const LinearTerm& term = data.terms[j];
    const auto index = static_cast<Eigen::Index>(j);
    WideInterval pull(0);
    for (Eigen::Index k = 0; k < y.size(); ++k) {
      WideInterval column(term.constant[k]);
      if (term.per_volt[k] != 0) column += WideInterval(term.per_volt[k]) * wide_vd[k];
      pull += weighted[k] * column;
    }
    // The largest gain of a coefficient within its range. Without an upper end only a negative pull
    // counts here; a positive one is penalised with the bound of the dark current.
    const WideReal zero(0);
    const WideInterval falling(std::min(pull.lower, zero), std::min(pull.upper, zero));
    const WideInterval rising(std::max(pull.lower, zero), std::max(pull.upper, zero));
    dual -= falling * WideInterval(term.lower);
    mixture->pulls[index] = Upper(Hull(pull));
    if (term.upper < kInfinity) {
      dual -= rising * WideInterval(term.upper);
    } else if (pull.upper > 0) {
      lack += Interval(mixture->pulls[index]) * (mixture->linear[index] + Interval(dark_bound_A));
    }
  }
  // Any multiplier of Is proves a bound, so the one found is used unchanged.
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const double pull = mixture->saturation_pulls[w];
    if (pull == 0) continue;
    const Window& window = windows[w];
    dual -= WideInterval(pull) *
            WideInterval(pull < 0 ? window.saturation_lower_A : window.saturation_upper_A);
  }
  mixture->dual = Lower(Hull(dual));
  // Smaller correlations are below rounding.
  const double hidden = 1e-15 * data.weight.cwiseProduct(y).norm();
  mixture->excess =
      BoundCorrelation<Interval>(vd, mixture->scale_voltage_V, WeightedArray<Interval>(data, y),
                                 windows, mixture->atoms, std::max(mixture->excess, hidden),
                                 mixture->saturation_pulls)
          .bound;
  lack += Interval(mixture->excess) * dark_bound_A;
  mixture->relative_gap = Upper(abs(Interval(mixture->primal) - mixture->dual) + lack) /
                          std::max(mixture->primal, 1e-300);
}

template DarkCurrentBound BoundDarkCurrent<double>(const MixtureData&, double, double, double);
template DarkCurrentBound BoundDarkCurrent<Interval>(const MixtureData&, double, double, double);
template PartBound BoundPart<double>(const MixtureData&, const std::vector<Window>&, const Mixture&,
                                     const Mixture&, const DarkCurrentBound&, double);
template PartBound BoundPart<Interval>(const MixtureData&, const std::vector<Window>&,
                                       const Mixture&, const Mixture&, const DarkCurrentBound&,
                                       double);

}  // namespace lyrefit
