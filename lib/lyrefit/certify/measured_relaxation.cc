#include "lyrefit/certify/measured_relaxation.h"

#include <algorithm>

#include "lyrefit/certify/interval.h"
#include "lyrefit/certify/part_bound.h"
#include "lyrefit/certify/tail_bound.h"

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

}  // namespace lyrefit
