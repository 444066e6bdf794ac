#include "lyrefit/certify/relaxation.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>

#include "lyrefit/certify/interval.h"
#include "lyrefit/certify/part_bound.h"
#include "lyrefit/certify/real_data.h"

namespace lyrefit {
namespace {

template <class Real>
PartBound BoundEnds(const MixtureData& data, const BranchPart& part, const Incumbent& incumbent) {
  return BoundPart<Real>(data, Union(part.windows), *part.left, *part.right,
                         BoundDarkCurrent<Real>(data, part.rs0, part.rs1, incumbent.primal),
                         incumbent.primal);
}

}  // namespace

double MeasuredRelaxation::Beyond(double rs) const {
  return rigorous_ ? BoundTail<Interval>(data_, rs) : BoundTail(data_, rs);
}

double MeasuredRelaxation::Scale() const { return data_.WeightedTarget().cwiseAbs().maxCoeff(); }

MixturePtr MeasuredRelaxation::At(const std::vector<Window>& windows, double rs,
                                  const std::vector<Atom>& start, Incumbent* incumbent) const {
  ++incumbent->solved;
  const double dark_bound = BoundDarkCurrent(data_, rs, rs, incumbent->primal).current_A;
  const double dark_bound_A = std::min(dark_bound, 1e3 * Scale());
  auto mixture = std::make_shared<Mixture>(
      SolveMixture(data_, Union(windows), rs, start, 0.01 * incumbent->tolerance, dark_bound_A));
  if (rigorous_) MakeSafe(data_, Union(windows), dark_bound_A, mixture.get());
  incumbent->Note(*mixture, mixture->primal);
  return mixture;
}

void MeasuredRelaxation::Bound(const BranchPart* parent, BranchPart* part,
                               Incumbent* incumbent) const {
  const std::vector<Atom> none;
  if (part->left == nullptr) {
    part->left =
        At(part->windows, part->rs0, parent == nullptr ? none : parent->left->atoms, incumbent);
  }
  if (part->right == nullptr) {
    part->right = part->rs1 > part->rs0
                      ? At(part->windows, part->rs1,
                           parent == nullptr ? part->left->atoms : parent->right->atoms, incumbent)
                      : part->left;
  }
  const Mixture &a = *part->left, &b = *part->right;
  const PartBound bound = rigorous_ ? BoundEnds<Interval>(data_, *part, *incumbent)
                                    : BoundEnds<double>(data_, *part, *incumbent);
  part->lower = bound.lower;
  part->ends = bound.ends;
  part->between = bound.lower;
  part->lacking = std::max(a.relative_gap * a.primal, b.relative_gap * b.primal);
}

namespace {

// Points of rising current whose junction voltage does not fall. A model's current does not rise
// along them, so it fits them no better than their mean does.
struct Chain {
  std::vector<Eigen::Index> points;
};

// Half the sum of squares about the mean.
template <class Real>
Real HalfSpread(const Eigen::VectorXd& current, const Chain& chain) {
  Real sum(0), squares(0);
  for (const Eigen::Index k : chain.points) sum += Real(current[k]);
  const Real mean = sum / Real(static_cast<double>(chain.points.size()));
  for (const Eigen::Index k : chain.points) {
    const Real off = Real(current[k]) - mean;
    squares += off * off;
  }
  return Real(0.5) * squares;
}

}  // namespace

template <class Real>
double BoundTail(const MixtureData& data, double rs) {
  const ArrayOf<Real> vd = JunctionVoltage<Real>(data, rs);
  std::vector<Eigen::Index> rising(static_cast<std::size_t>(vd.size()));
  std::iota(rising.begin(), rising.end(), 0);
  const Eigen::VectorXd& current = data.current_A;
  std::sort(rising.begin(), rising.end(), [&](Eigen::Index a, Eigen::Index b) {
    return current[a] < current[b] ||
           (current[a] == current[b] && data.voltage_V[a] < data.voltage_V[b]);
  });
  // Appends every point to the chain whose last junction voltage is the closest below.
  std::vector<Chain> chains;
  std::multimap<double, std::size_t> ends;
  for (const Eigen::Index k : rising) {
    auto next = ends.upper_bound(Lower(vd[k]));
    std::size_t chain = chains.size();
    if (next == ends.begin()) {
      chains.emplace_back();
    } else {
      chain = std::prev(next)->second;
      ends.erase(std::prev(next));
    }
    chains[chain].points.push_back(k);
    ends.emplace(Upper(vd[k]), chain);
  }
  Real sum(0);
  for (const Chain& chain : chains) sum += HalfSpread<Real>(current, chain);
  return std::max(0.0, Lower(sum));
}

template double BoundTail<double>(const MixtureData&, double);
template double BoundTail<Interval>(const MixtureData&, double);

double BoundTailSolved(const MixtureData& data, double rs) {
  const Eigen::Index points = data.target_A.size();
  const Eigen::ArrayXd square = data.weight.array().square().inverse();
  double largest = 0;
  for (Eigen::Index low = 0; low < points; ++low) {
    for (Eigen::Index high = 0; high < points; ++high) {
      const double width = data.voltage_V[high] - data.voltage_V[low];
      if (width < 0) continue;
      const double fall = data.target_A[low] - data.target_A[high];
      const double miss = std::max(fall - width / rs, -fall);
      if (miss > 0) largest = std::max(largest, 0.5 * miss * miss / (square[low] + square[high]));
    }
  }
  return largest;
}

}  // namespace lyrefit
