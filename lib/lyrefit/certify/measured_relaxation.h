#pragma once

#include "lyrefit/certify/relaxation.h"

namespace lyrefit {

// Relaxation of the measured-current problem of mixture.h. Between two neighbouring Rs the
// interpolated dual vectors of both ends prove a lower bound for every Rs between them. They are
// feasible up to second order in the distance, and the infeasibility is subtracted as a penalty.
class MeasuredRelaxation : public Relaxation {
 public:
  // `data` must outlive this object. With `rigorous`, rounding cannot raise a bound above the
  // truth.
  explicit MeasuredRelaxation(const MixtureData& data, bool rigorous = false)
      : data_(data), rigorous_(rigorous) {}
  MixturePtr At(const std::vector<Window>& windows, double rs, const std::vector<Atom>& start,
                Incumbent* incumbent) const override;
  void Bound(const BranchPart* parent, BranchPart* part, Incumbent* incumbent) const override;
  double Beyond(double rs) const override;
  bool SplitsWindows(const BranchPart& part, double target) const override {
    return part.ends < target || !(part.rs1 > part.rs0);
  }
  double Scale() const override;
  Eigen::Index Points() const override { return data_.target_A.size(); }

 private:
  const MixtureData& data_;
  bool rigorous_;
};

}  // namespace lyrefit
