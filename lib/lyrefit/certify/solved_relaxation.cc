#include "lyrefit/certify/solved_relaxation.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/certify/mixture.h"
#include "lyrefit/certify/solved_part.h"

namespace lyrefit {
namespace {

constexpr int kMostNewtonSteps = 12;  // Gauss-Newton steps
constexpr int kMostSharpenings = 12;  // rounds that tighten the bounds of one part
constexpr double kCoarse = 0.3;       // largest slope error e at which BoundNear() alone suffices
constexpr double kNearby = 4;         // BoundNear() is used below this multiple of the best value

double BoundDarkCurrent(const MixtureData& data, double rs, double known) {
  return std::min(BoundDarkCurrent(data, rs, rs, known).current_A,
                  1e3 * data.target_A.cwiseAbs().maxCoeff());
}

double Spread(const KnownValues& known) {
  return (known.each_A + known.common_A.cwiseAbs()).sum() + known.radius_A * known.shared.norm();
}

// Enclosures of the junction voltages between V + J' Rs and V + J Rs, for every Rs of the part.
void SlopeEnds(const SolvedPart& work, std::vector<double>* below, std::vector<double>* above) {
  for (Eigen::Index k = 0; k < work.reference_A.size(); ++k) {
    const double a = work.region.rs0 * work.reference_A[k],
                 b = work.region.rs1 * work.reference_A[k];
    const double reach = work.region.rs1 * work.deviation_A[k];
    below->push_back(work.data.voltage_V[k] + std::min(a, b) - reach);
    above->push_back(work.data.voltage_V[k] + std::max(a, b) + reach);
  }
}

// Tightens the bounds of the slopes in rounds, as long as that helps to prove `target`.
void Sharpen(const DarkCurrentBound& dark_bound, double light_A, double target, SolvedPart* work) {
  std::vector<SlopeRange> slopes(static_cast<std::size_t>(work->error.size()));
  double radius = kInfinity, unsure = kInfinity;
  for (int round = 0; round < kMostSharpenings; ++round) {
    if (work->bound.lower - work->loss >= target) return;
    std::vector<double> below, above;
    SlopeEnds(*work, &below, &above);
    KnownValues known = ValuesFromDeviations(*work);
    if (std::isfinite(radius)) {
      KnownValues from_duals = ValuesFromDuals(*work, slopes, radius);
      if (Spread(from_duals) < Spread(known)) known = std::move(from_duals);
    }
    known.dark_bound = dark_bound;
    known.largest_light_A = light_A;
    const double precision =
        std::min(1e-4, 0.3 * std::sqrt(1 - target / work->known)) / work->region.rs1;
    const std::vector<SlopeRange> now = BoundSlopes(known, work->windows, below, above, precision);
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      slopes[k].lower = std::max(slopes[k].lower, now[k].lower);
      slopes[k].upper = std::min(
          {slopes[k].upper, now[k].upper, work->highest_slope_S[static_cast<Eigen::Index>(k)]});
    }
    SetErrors(slopes, work);
    work->loss = std::min(work->loss, Loss(*work));
    if (work->bound.lower < target) return;
    const double now_unsure = work->error.min(1).sum();
    if (now_unsure > 0.9 * unsure) return;
    unsure = now_unsure;
    radius = std::min(radius, Radius(*work, LinearKnown(*work)));
    const Eigen::ArrayXd reach = (1 + work->error) * (radius + Departure(*work));
    work->deviation_A = work->deviation_A.min(reach / work->data.weight.array());
  }
}

// Bounds a part by the problem linearised around a mixture fitted to it, solved at both ends.
void BoundNear(const SolvedMixture& fit, double tolerance, double target, SolvedPart* work) {
  const BranchPart& part = work->region;
  work->reference_A = fit.current_A;
  work->slope_S = fit.slope_S;
  work->residual = work->data.weight.array() * (work->data.target_A - work->reference_A).array();
  work->linear = Linearise(work->data, work->middle, work->reference_A, work->slope_S);
  const Eigen::Index points = work->reference_A.size();
  work->deviation_A.resize(points);
  for (Eigen::Index k = 0; k < points; ++k) {
    work->deviation_A[k] =
        Allowed(*work, k) + std::fabs(work->reference_A[k] - work->data.target_A[k]);
  }
  const DarkCurrentBound dark_bound = CompetitorDarkCurrent(*work);
  if (!std::isfinite(dark_bound.current_A)) return;
  const double light = LargestLight(*work, dark_bound);
  work->highest_slope_S = RoughSlopes(*work, light, false);
  work->error.resize(points);
  std::vector<SlopeRange> slopes;
  for (const double highest : work->highest_slope_S) slopes.push_back({0, highest});
  SetErrors(slopes, work);
  const double solve_dark_A = std::min(dark_bound.current_A, 1e3 * work->data.target_A.maxCoeff());
  work->left = SolveMixture(work->linear, work->windows, part.rs0, fit.mixture.atoms, tolerance,
                            solve_dark_A);
  work->right = part.rs1 > part.rs0 ? SolveMixture(work->linear, work->windows, part.rs1,
                                                   fit.mixture.atoms, tolerance, solve_dark_A)
                                    : work->left;
  work->bound = BoundPart(work->linear, work->windows, work->left, work->right, dark_bound,
                          LinearKnown(*work));
  work->loss = Loss(*work);
  if (part.rs1 > 0) Sharpen(dark_bound, light, target, work);
}

// Bounds a part by the measured-current problem. Each residual is divided by 1 + Rs times the
// largest slope there.
void BoundFar(double tolerance, SolvedPart* work) {
  const BranchPart& part = work->region;
  work->reference_A = work->data.target_A;
  work->slope_S = Eigen::VectorXd::Zero(work->reference_A.size());
  work->deviation_A.resize(work->reference_A.size());
  for (Eigen::Index k = 0; k < work->deviation_A.size(); ++k) {
    work->deviation_A[k] = Allowed(*work, k);
  }
  work->loss = 0;
  const DarkCurrentBound dark_bound = CompetitorDarkCurrent(*work);
  if (!std::isfinite(dark_bound.current_A)) return;
  const Eigen::ArrayXd slopes = RoughSlopes(*work, LargestLight(*work, dark_bound), true);
  work->linear = work->data;
  work->linear.weight =
      work->data.weight.array() / (1 + part.rs1 * slopes.min(1e12 / (part.rs1 + 1e-12)));
  const double solve_dark_A = std::min(dark_bound.current_A, 1e3 * work->data.target_A.maxCoeff());
  work->left = SolveMixture(work->linear, work->windows, part.rs0, {}, tolerance, solve_dark_A);
  work->right = part.rs1 > part.rs0 ? SolveMixture(work->linear, work->windows, part.rs1,
                                                   work->left.atoms, tolerance, solve_dark_A)
                                    : work->left;
  work->bound =
      BoundPart(work->linear, work->windows, work->left, work->right, dark_bound, work->known);
}

SolvedPart Begin(const MixtureData& data, const BranchPart& part, double known) {
  SolvedPart work{data, part};
  work.windows = Union(part.windows);
  work.known = known;
  for (const Window& window : work.windows) work.steepest = std::max(work.steepest, window.upper);
  work.middle = 0.5 * (part.rs0 + part.rs1);
  return work;
}

void Take(const SolvedPart& work, bool coarse, BranchPart* part) {
  part->left = std::make_shared<Mixture>(work.left);
  part->right = std::make_shared<Mixture>(work.right);
  part->lower = std::isfinite(work.loss) ? work.bound.lower - work.loss : 0;
  part->ends = work.bound.ends;
  part->between = work.bound.lower;
  part->coarse = coarse;
  part->lacking = coarse ? 0
                         : std::max(work.left.relative_gap * work.left.primal,
                                    work.right.relative_gap * work.right.primal);
}

}  // namespace

MixtureData Linearise(const MixtureData& data, double rs, const Eigen::VectorXd& reference_A,
                      const Eigen::VectorXd& slope_S) {
  MixtureData linear = data;
  const Eigen::ArrayXd factor = 1 + rs * slope_S.array();
  linear.current_A = reference_A;
  linear.target_A = reference_A.array() - (reference_A - data.target_A).array() * factor;
  linear.weight = data.weight.array() / factor;
  return linear;
}

SolvedMixture SolveSolvedMixture(const MixtureData& data, const std::vector<Window>& windows,
                                 double rs, const std::vector<Atom>& start, double tolerance) {
  SolvedMixture best;
  Eigen::VectorXd reference = data.target_A;
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(reference.size());
  std::vector<Atom> atoms = start;
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    const MixtureData linear = Linearise(data, rs, reference, slope);
    Mixture mixture =
        SolveMixture(linear, windows, rs, atoms, tolerance,
                     BoundDarkCurrent(linear, rs, 0.5 * linear.WeightedTarget().squaredNorm()));
    ++best.steps;
    const MixtureLaw law(data, mixture);
    reference = SolvedCurrents(data, mixture);
    const Eigen::VectorXd vd = data.voltage_V + rs * reference;
    for (Eigen::Index k = 0; k < vd.size(); ++k) slope[k] = law.Slope(vd[k]);
    const double value = 0.5 * data.weight.cwiseProduct(reference - data.target_A).squaredNorm();
    if (!(value < best.value)) break;
    const bool settled = value > best.value * (1 - 1e-13);
    atoms = mixture.atoms;
    best.mixture = std::move(mixture);
    best.current_A = reference;
    best.slope_S = slope;
    best.value = value;
    if (settled || !reference.allFinite()) break;
  }
  return best;
}

void SolvedRelaxation::Bound(const BranchPart* parent, BranchPart* part,
                             Incumbent* incumbent) const {
  if (NoneCompetes(data_, part->rs0, incumbent->primal)) {
    part->lower = incumbent->primal;
    return;
  }
  const double tolerance = 0.01 * incumbent->tolerance;
  const std::vector<Atom> none;
  const std::vector<Atom>& start = parent == nullptr ? none : parent->left->atoms;
  const std::vector<Window> windows = Union(part->windows);
  const double middle = 0.5 * (part->rs0 + part->rs1);
  const SolvedMixture fit = SolveSolvedMixture(data_, windows, middle, start, tolerance);
  incumbent->solved += fit.steps;
  incumbent->Note(fit.mixture, fit.value);
  const double target = incumbent->primal * (1 - incumbent->tolerance);
  part->left = part->right = nullptr;  // drops the end solutions of the parent
  SolvedPart near = Begin(data_, *part, incumbent->primal);
  bool coarse = true;
  if (fit.value < kNearby * incumbent->primal) {
    incumbent->solved += 2;
    BoundNear(fit, tolerance, target, &near);
    if (near.left.y.size() > 0) {
      coarse = false;
      Take(near, coarse, part);
      if (part->lower >= target || near.error.maxCoeff() < kCoarse) return;
    }
  }
  SolvedPart far = Begin(data_, *part, incumbent->primal);
  incumbent->solved += 2;
  BoundFar(tolerance, &far);
  if (part->left == nullptr) {
    Take(far, coarse, part);
  } else {
    part->lower = std::max(part->lower, far.bound.lower);
  }
}

double SolvedRelaxation::Beyond(double rs) const { return BoundTailSolved(data_, rs); }

// Windows are halved if the dual values at the ends are too low. They are also halved if the slopes
// are known too inaccurately and the windows are relatively wider than the range of Rs.
bool SolvedRelaxation::SplitsWindows(const BranchPart& part, double target) const {
  constexpr double kNarrow = 0.05, kNarrowest = 1e-7;
  if (part.coarse && part.rs1 - part.rs0 > kNarrow * part.rs1) return false;
  if (part.rs1 - part.rs0 <= kNarrowest * part.rs1) return true;
  if (part.ends < target && target - part.ends > 0.5 * (target - part.between)) return true;
  double widest = 0;
  for (const Window& window : part.windows) {
    widest = std::max(widest, (window.upper - window.lower) / window.upper);
  }
  return part.between >= target && widest * part.rs1 > part.rs1 - part.rs0;
}

double SolvedRelaxation::Scale() const { return data_.WeightedTarget().cwiseAbs().maxCoeff(); }

}  // namespace lyrefit
