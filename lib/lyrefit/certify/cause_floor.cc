#include "lyrefit/certify/cause_floor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "lyrefit/base/try.h"
#include "lyrefit/certify/cause_branch.h"
#include "lyrefit/certify/cause_upper_bound.h"
#include "lyrefit/certify/tail_bound.h"
#include "lyrefit/model/device.h"

namespace lyrefit {
namespace {

constexpr double kMostScales = 3;  // largest strength, in multiples of the largest current
constexpr double kRecombination = 2;

// Data shared by the proofs of one curve.
struct Ground {
  MixtureData data;
  CauseRegion region;
  double largest_A = 0;
  double thermal_voltage_V = 0;
  int cells = 1;

  double Rmse(double half) const {
    return std::sqrt(2 * half / static_cast<double>(data.voltage_V.size()));
  }
};

std::shared_ptr<const CauseShape> ShapeOf(const std::string& cause, const Ground& ground,
                                          const CauseFloorOptions& options) {
  const double strongest = kMostScales * ground.largest_A;
  if (cause == "second_diode") {
    return std::make_shared<CauseShape>(DiodeShape(1 / (kRecombination * ground.thermal_voltage_V),
                                                   ground.data.reference_voltage_V, strongest));
  }
  if (cause == "collection") {
    return std::make_shared<CauseShape>(CollectionShape(ground.cells, strongest));
  }
  if (cause != "nonohmic_shunt") return nullptr;
  return std::make_shared<CauseShape>(PowerShape(ground.data.voltage_V.cwiseAbs().maxCoeff(),
                                                 {options.exponent_lower, options.exponent_upper},
                                                 strongest));
}

Expected<void> Check(const IvCurve& curve, const CauseFloorOptions& options) {
  TRY(Validate(curve));
  if (!(options.n_lower > 0 && options.n_lower < options.n_upper)) {
    return Fail(fmt::format("n-lower = {:g} must be above 0 and below n-upper = {:g}",
                            options.n_lower, options.n_upper));
  }
  if (!(options.exponent_lower > 1 && options.exponent_lower <= options.exponent_upper)) {
    return Fail(fmt::format("exponents of a non-ohmic shunt begin above 1, found {:g} to {:g}",
                            options.exponent_lower, options.exponent_upper));
  }
  return {};
}

// Tail bound from disjoint pairs of points, largest currents first. In each pair the current rises
// although the junction voltage does not fall, which no model allows. Returns the larger of this
// and BoundTail().
double BoundTailPairs(const MixtureData& data, double rs) {
  const Eigen::VectorXd vd = data.JunctionVoltage(rs);
  const Eigen::VectorXd& current = data.current_A;
  std::vector<int> rising(static_cast<std::size_t>(vd.size()));
  std::iota(rising.begin(), rising.end(), 0);
  std::sort(rising.begin(), rising.end(), [&](int a, int b) { return current[a] < current[b]; });
  std::vector<char> taken(rising.size(), 0);
  double half = 0;
  for (auto high = rising.rbegin(); high != rising.rend(); ++high) {
    if (taken[static_cast<std::size_t>(*high)] != 0) continue;
    for (const int low : rising) {
      const double drop = current[*high] - current[low];
      if (!(drop > 0)) break;
      if (taken[static_cast<std::size_t>(low)] != 0 || vd[*high] < vd[low]) continue;
      taken[static_cast<std::size_t>(low)] = 1;
      half += 0.25 * drop * drop;
      break;
    }
  }
  return std::max(half, BoundTail(data, rs));
}

// Sets the end of the range of Rs to the smallest Rs found whose tail bound reaches `known`. Models
// with a larger Rs cannot have a half sum of squares below `known`. If no Rs up to 16 times the
// given end reaches `known`, the end is 16 times as large, and its tail bound limits the floor.
void EndRegion(double known, Ground* ground) {
  constexpr int kDoublings = 4, kHalvings = 24;
  double low = 0, high = ground->region.rs_upper;
  for (int k = 0; k < kDoublings && BoundTailPairs(ground->data, high) < known; ++k) high *= 2;
  for (int k = 0; k < kHalvings && BoundTailPairs(ground->data, high) >= known; ++k) {
    const double middle = 0.5 * (low + high);
    if (BoundTailPairs(ground->data, middle) < known) {
      low = middle;
    } else {
      high = middle;
    }
  }
  ground->region.rs_upper = high;
}

Expected<Ground> MakeGround(const IvCurve& curve, const CauseFloorOptions& options) {
  Ground ground;
  ground.data = CurveData(curve.voltage_V, curve.current_A);
  ground.largest_A = ground.data.current_A.maxCoeff();
  ground.cells = curve.conditions.cells_in_series;
  const double reference = ground.data.reference_voltage_V;
  if (!(reference > 0) || !(ground.largest_A > 0)) {
    return Fail("no point delivers current at a forward voltage: a floor needs a lit curve",
                curve.source);
  }
  ground.thermal_voltage_V = curve.conditions.ModuleThermalVoltage(options.constants);
  ground.region.u = {1 / (options.n_upper * ground.thermal_voltage_V),
                     1 / (options.n_lower * ground.thermal_voltage_V)};
  const double steepest = kLargestExponent / ground.data.voltage_V.maxCoeff();
  if (ground.region.u.lower >= steepest) {
    return Fail(fmt::format("every diode's exponent is beyond {:g}: is the number of cells in "
                            "series, {}, right?",
                            kLargestExponent, ground.cells),
                curve.source);
  }
  ground.region.u.upper = std::min(ground.region.u.upper, steepest);
  ground.region.rs_upper = reference / ground.largest_A;
  if (options.recombination) {
    ground.data = WithCause(ground.data, ShapeOf("second_diode", ground, options), {0});
  }
  return ground;
}

// The lowest result of descents from a few starts, or from `known` if it is finite.
CausePoint FindUpperBound(const Ground& ground, const std::shared_ptr<const CauseShape>& shape,
                          const CausePoint& known) {
  CausePoint best = known;
  const double theta = shape != nullptr ? std::sqrt(shape->theta.lower * shape->theta.upper) : 0;
  std::vector<CausePoint> starts;
  if (std::isfinite(known.primal)) {
    starts.push_back({known.rs, known.u, theta, kInfinity});
  } else {
    for (const double n : {1.0, 1.5}) {
      for (const double part : {0.02, 0.1}) {
        starts.push_back(
            {part * ground.region.rs_upper, 1 / (n * ground.thermal_voltage_V), theta, kInfinity});
      }
    }
  }
  for (CausePoint& start : starts) {
    start.u = std::min(std::max(start.u, ground.region.u.lower), ground.region.u.upper);
    Evaluate(ground.data, shape, &start);
    const CausePoint end = Descend(ground.data, shape, ground.region, start);
    if (end.primal < best.primal) best = end;
  }
  return best;
}

ProvedCause Fill(const Ground& ground, double tail, const CauseEnd& end) {
  ProvedCause proved;
  proved.rmse_A = ground.Rmse(end.best.primal);
  proved.lower_bound_A = std::min(ground.Rmse(std::min(end.lower, tail)), proved.rmse_A);
  proved.solved = end.solved;
  proved.complete = end.complete;
  return proved;
}

}  // namespace

Expected<CauseFloors> ProveCauses(const IvCurve& curve, const CauseFloorOptions& options) {
  TRY(Check(curve, options));
  TRY(Ground ground, MakeGround(curve, options));
  CauseFloors floors;
  CauseLimits limits;
  limits.relative_gap = options.relative_gap;
  limits.most_solved = static_cast<int>(std::min<std::int64_t>(options.effort, 1000000));
  limits.stop = options.stop;
  const CausePoint alone = FindUpperBound(ground, nullptr, {});
  EndRegion(alone.primal, &ground);
  floors.rs_upper_ohm = ground.region.rs_upper;
  const double tail = BoundTailPairs(ground.data, ground.region.rs_upper);
  const CauseEnd base = BranchOverCause(ground.data, nullptr, ground.region, alone, limits);
  floors.without = Fill(ground, tail, base);
  limits.absolute_gap = options.absolute_gap * base.best.primal;
  for (const std::string& cause : options.causes) {
    const auto shape = ShapeOf(cause, ground, options);
    if (shape == nullptr) return Fail("no floor is known for '" + cause + "'");
    // At strength 0 the model is the single diode, so its optimum is a valid start.
    const CausePoint start = FindUpperBound(ground, shape, base.best);
    const CauseEnd end = BranchOverCause(ground.data, shape, ground.region, start, limits);
    floors.causes.push_back(Fill(ground, tail, end));
    floors.causes.back().cause = cause;
    if (shape->theta.upper > shape->theta.lower) floors.causes.back().parameter = end.best.theta;
  }
  return floors;
}

}  // namespace lyrefit
