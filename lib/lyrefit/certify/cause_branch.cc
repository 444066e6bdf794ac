#include "lyrefit/certify/cause_branch.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>
#include <vector>

#include "lyrefit/certify/cause_upper_bound.h"
#include "lyrefit/certify/part_bound.h"

namespace lyrefit {
namespace {

constexpr double kSolveTolerance = 1e-5;  // relative duality gap of one convex problem
// An RMSE below this fraction of the largest current counts as an exact fit.
constexpr double kExact = 1e-9;
// Weight of the width of a theta span against ln(upper / lower) of the window of u, to select a
// split.
constexpr double kThetaWeight = 0.5;

using MixturePtr = std::shared_ptr<const Mixture>;

struct CausePart {
  MixturePtr left, right;
  Window u;
  Span theta;
  double lower = 0;
  double raw_ends = 0;  // lower of the dual values at both ends
  double ends = 0;      // lower of the bounds at both ends, penalties subtracted
};

struct LowestFirst {
  bool operator()(const CausePart& a, const CausePart& b) const { return a.lower > b.lower; }
};

class CauseBranch {
 public:
  CauseBranch(const MixtureData& data, const std::shared_ptr<const CauseShape>& shape,
              const CauseRegion& region, const CausePoint& start, const CauseLimits& limits)
      : data_(data), shape_(shape), region_(region), limits_(limits) {
    end_.best = start;
  }

  CauseEnd Run() {
    CausePart whole;
    whole.u = region_.u;
    if (shape_ != nullptr) whole.theta = shape_->theta;
    Fill(&whole, region_.rs_lower, region_.rs_upper);
    Push(std::move(whole));
    while (!open_.empty() && open_.top().lower < Target()) {
      if (end_.solved >= limits_.most_solved || limits_.stop.Stopped()) break;
      const CausePart part = open_.top();
      open_.pop();
      Split(part);
    }
    const double left = open_.empty() ? kInfinity : open_.top().lower;
    end_.lower = std::min({settled_, left, end_.best.primal});
    end_.complete = end_.lower >= std::min(Target(), end_.best.primal);
    return end_;
  }

 private:
  double Target() const {
    const double known = end_.best.primal;
    const double exact = kExact * Scale();
    if (2 * known <= exact * exact * static_cast<double>(data_.voltage_V.size())) return 0;
    return known - std::max(limits_.relative_gap * known, limits_.absolute_gap);
  }

  double Scale() const { return data_.WeightedTarget().cwiseAbs().maxCoeff(); }

  MixtureData DataOf(const Span& theta) const {
    std::vector<double> ends = {theta.lower};
    if (theta.upper > theta.lower) ends.push_back(theta.upper);
    return WithCause(data_, shape_, ends);
  }

  MixturePtr Solve(const CausePart& part, double rs, const std::vector<Atom>& start) {
    ++end_.solved;
    const MixtureData data = DataOf(part.theta);
    const double dual_gain = ComputeDualGain(data, rs, rs, end_.best.primal).current_A;
    auto mixture = std::make_shared<Mixture>(SolveMixture(
        data, {part.u}, rs, start, kSolveTolerance, std::min(dual_gain, 1e3 * Scale())));
    Note(*mixture, part);
    return mixture;
  }

  // Builds a model from a mixture that is below the best value known: its strongest diode, and
  // theta weighted by strength. Descends from the model if it is close to the best one. Keeps the
  // lower of both.
  void Note(const Mixture& mixture, const CausePart& part) {
    if (mixture.atoms.empty() || mixture.primal >= end_.best.primal) return;
    const auto by_current = [](const Atom& a, const Atom& b) { return a.current_A < b.current_A; };
    const Atom& atom = *std::max_element(mixture.atoms.begin(), mixture.atoms.end(), by_current);
    CausePoint point = {mixture.rs, atom.u, part.theta.lower, kInfinity};
    if (part.theta.upper > part.theta.lower) {
      const double low = mixture.linear[mixture.linear.size() - 2];
      const double high = mixture.linear[mixture.linear.size() - 1];
      const double weight = low + high > 0 ? high / (low + high) : 0.5;
      point.theta += weight * (part.theta.upper - part.theta.lower);
    }
    Evaluate(data_, shape_, &point);
    if (point.primal >= 1.5 * end_.best.primal || descents_ >= kMostDescents) {
      if (point.primal < end_.best.primal) end_.best = point;
      return;
    }
    ++descents_;
    const CausePoint end = Descend(data_, shape_, region_, point);
    if (end.primal < end_.best.primal) end_.best = end;
  }

  void Fill(CausePart* part, double rs0, double rs1) {
    part->left = Solve(*part, rs0, part->left ? part->left->atoms : std::vector<Atom>());
    part->right =
        rs1 > rs0 ? Solve(*part, rs1, (part->right ? part->right : part->left)->atoms) : part->left;
  }

  // Lower bound at the Rs of one end, all penalties subtracted.
  double EndBound(const MixtureData& data, const Window& u, const Mixture& end) const {
    const double known = end_.best.primal;
    return BoundPart(data, {u}, end, end, ComputeDualGain(data, end.rs, end.rs, known), known)
        .lower;
  }

  void Push(CausePart part) {
    const Mixture &a = *part.left, &b = *part.right;
    const MixtureData data = DataOf(part.theta);
    const double known = end_.best.primal;
    const PartBound bound =
        BoundPart(data, {part.u}, a, b, ComputeDualGain(data, a.rs, b.rs, known), known);
    part.raw_ends = std::min(a.dual, b.dual);
    part.ends = std::min(EndBound(data, part.u, a), EndBound(data, part.u, b));
    part.lower = std::max(bound.lower, std::max(part.lower, 0.0));
    if (part.lower >= Target()) {
      settled_ = std::min(settled_, part.lower);
      return;
    }
    open_.push(std::move(part));
  }

  // Halves the window of u or the span of theta if even the bounds at the ends are too low,
  // otherwise divides the range of Rs.
  void Split(const CausePart& part) {
    if (part.ends >= Target() && part.right->rs > part.left->rs) return SplitResistance(part);
    const double of_theta = kThetaWeight * (part.theta.upper - part.theta.lower);
    const double of_u = std::log(part.u.upper / part.u.lower);
    if (of_theta > 0 && (part.raw_ends >= Target() || of_theta > of_u)) return SplitTheta(part);
    if (of_u > 1e-9) return SplitWindow(part);
    settled_ = std::min(settled_, part.lower);
  }

  void SplitResistance(const CausePart& part) {
    const Mixture &a = *part.left, &b = *part.right;
    double t = 0.5;
    if (std::max(a.primal, b.primal) < 4 * end_.best.primal && a.slope < 0 && b.slope > 0) {
      t = std::min(std::max(a.slope / (a.slope - b.slope), 0.05), 0.95);
    }
    const double rs = a.rs + t * (b.rs - a.rs);
    if (!(rs > a.rs && rs < b.rs)) {
      settled_ = std::min(settled_, part.lower);
      return;
    }
    const MixturePtr middle = Solve(part, rs, (t < 0.5 ? a : b).atoms);
    CausePart left = part, right = part;
    left.right = right.left = middle;
    Push(std::move(left));
    Push(std::move(right));
  }

  void SplitTheta(const CausePart& part) {
    const double middle = 0.5 * (part.theta.lower + part.theta.upper);
    for (const Span& half : {Span{part.theta.lower, middle}, Span{middle, part.theta.upper}}) {
      CausePart child = part;
      child.theta = half;
      Fill(&child, part.left->rs, part.right->rs);
      Push(std::move(child));
    }
  }

  void SplitWindow(const CausePart& part) {
    const double middle = std::sqrt(part.u.lower * part.u.upper);
    for (const Window& half : {Window{part.u.lower, middle}, Window{middle, part.u.upper}}) {
      CausePart child = part;
      child.u = half;
      Fill(&child, part.left->rs, part.right->rs);
      Push(std::move(child));
    }
  }

  static constexpr int kMostDescents = 8;

  const MixtureData& data_;
  const std::shared_ptr<const CauseShape>& shape_;
  const CauseRegion& region_;
  const CauseLimits& limits_;
  int descents_ = 0;
  double settled_ = kInfinity;
  std::priority_queue<CausePart, std::vector<CausePart>, LowestFirst> open_;
  CauseEnd end_;
};

}  // namespace

CauseEnd BranchOverCause(const MixtureData& data, const std::shared_ptr<const CauseShape>& shape,
                         const CauseRegion& region, const CausePoint& start,
                         const CauseLimits& limits) {
  return CauseBranch(data, shape, region, start, limits).Run();
}

}  // namespace lyrefit
