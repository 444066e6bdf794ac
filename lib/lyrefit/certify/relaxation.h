#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "lyrefit/certify/mixture.h"

namespace lyrefit {

using MixturePtr = std::shared_ptr<const Mixture>;

// A part of the region of a branch and bound: Rs between two values (ohm), and one window of u per
// diode. There is a single window where any number of diodes is allowed.
struct BranchPart {
  double rs0 = 0;
  double rs1 = 0;
  std::vector<Window> windows;
  MixturePtr left, right;  // solutions at both ends; null: not solved yet
  double lower = 0;        // proved lower bound of the half sum of squares over the part
  double ends = 0;         // lower of the dual values at both ends
  double between = 0;      // bound for all Rs between, no linearisation loss subtracted
  double lacking = 0;      // most that better solutions at the ends could add to `lower`
  bool coarse = false;     // the range of Rs is too wide to judge the windows
  int stuck = 0;           // generations for which `lacking` alone has kept the part open
};

// Best solution known during a branch and bound. Values are half sums of squares.
struct Incumbent {
  Mixture best;               // lowest mixture found that meets `diodes` and `box`
  double primal = kInfinity;  // lowest value known, from a mixture, a model or the caller
  int diodes = 0;             // largest number of diodes of `best`; 0: any number
  std::vector<Window> box;    // one window per diode, which `best` fits
  double tolerance = 1e-10;   // relative gap of the sums of squares to reach
  std::int64_t solved = 0;    // convex problems solved
  // Returns the half sum of squares of a model refined from a mixture with too many diodes. May be
  // empty. It is called again only after `solved` has doubled.
  std::function<double(const Mixture&)> polish;
  std::int64_t next_polish = 0;

  // Records a mixture whose half sum of squares is `value`, or a model refined from it.
  void Note(const Mixture& mixture, double value);
};

// Interface of a lower bound: which sum of squares is bounded, and how. A bound holds for every
// mixture over the windows that is as good as the incumbent's value.
class Relaxation {
 public:
  virtual ~Relaxation() = default;
  // The solution at one Rs if adjacent parts can share it, otherwise null.
  virtual MixturePtr At(const std::vector<Window>& windows, double rs,
                        const std::vector<Atom>& start, Incumbent* incumbent) const = 0;
  // Sets the bounds of the part. Missing end solutions are computed, starting from those of its
  // parent if there is one.
  virtual void Bound(const BranchPart* parent, BranchPart* part, Incumbent* incumbent) const = 0;
  // Lower bound that the order of the points proves for all Rs of `rs` or more.
  virtual double Beyond(double rs) const = 0;
  // True if a part that does not prove `target` needs a window halved; false if it needs its range
  // of Rs divided.
  virtual bool SplitsWindows(const BranchPart& part, double target) const = 0;
  // The largest current, the scale of rounding errors.
  virtual double Scale() const = 0;
  virtual Eigen::Index Points() const = 0;
};

// Merges windows of several diodes that overlap. A mixture needs windows that share at most an end.
// A merged window has the summed ranges of Is of its diodes.
std::vector<Window> Union(std::vector<Window> windows);

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

// Lower bound of half the sum of squares of every mixture with a series resistance of `rs` (ohm) or
// more. A model's current never rises with the junction voltage V + I Rs. Points of rising current
// that have rising junction voltages at `rs` have them at all larger Rs. A model then fits such a
// chain of points no better than their mean does. The bound is the sum over chains. With `Real`
// Interval rounding cannot raise it above the truth.
template <class Real = double>
double BoundTail(const MixtureData& data, double rs);

// Tail bound of the solved-current problem, from the single worst pair of points. The solved
// current never rises with the terminal voltage, and falls by no more than the voltage rises over
// Rs.
double BoundTailSolved(const MixtureData& data, double rs);

}  // namespace lyrefit
