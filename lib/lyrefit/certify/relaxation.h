#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "lyrefit/certify/mixture.h"

namespace lyrefit {

using MixturePtr = std::shared_ptr<const Mixture>;

// A part of the region that a branch and bound goes through: Rs between two values, one window for
// each diode (one in all where any number of diodes is allowed).
struct BranchPart {
  double rs0 = 0;
  double rs1 = 0;
  std::vector<Window> windows;
  MixturePtr left, right;  // solutions at both ends; none yet
  double lower = 0;        // proved: half sum of squares of everything in the part
  double ends = 0;         // what the two ends alone would prove
  double between = 0;      // what they would prove of all Rs between them, nothing else lost
  double lacking = 0;      // so much better solutions at the ends could prove at most
  bool coarse = false;     // its range of Rs is too wide to say anything of the windows
  int stuck = 0;           // generations for which only rounding has kept it from being settled
};

// The best that is known while a branch and bound goes on, as half sums of squares.
struct Incumbent {
  Mixture best;               // the lowest mixture met that counts
  double primal = kInfinity;  // the lowest value known, of a mixture or from elsewhere
  int diodes = 0;             // so many a mixture that counts may have; 0: any number
  std::vector<Window> box;    // one for each of them, which it fits then
  double tolerance = 1e-10;   // relative gap of the sums of squares aimed at
  std::int64_t solved = 0;    // convex problems
  // What a model near a mixture with too many diodes reaches; may be empty. Asked now and then.
  std::function<double(const Mixture&)> polish;
  std::int64_t next_polish = 0;

  // Takes note of a mixture whose half sum of squares is `value`, or of a model near it.
  void Note(const Mixture& mixture, double value);
};

// Which sum of squares is bounded, and how. Whatever Bound() proves holds for every mixture over the
// windows that is as good as the incumbent's value.
class Relaxation {
 public:
  virtual ~Relaxation() = default;
  // The solution at one Rs where parts that end there can share it; none otherwise.
  virtual MixturePtr At(const std::vector<Window>& windows, double rs,
                        const std::vector<Atom>& start, Incumbent* incumbent) const = 0;
  // Fills what the part proves. Ends that are missing are solved for, from those of its parent, if
  // there is one.
  virtual void Bound(const BranchPart* parent, BranchPart* part, Incumbent* incumbent) const = 0;
  // What the order of the points proves of everything with this Rs or more.
  virtual double Beyond(double rs) const = 0;
  // Whether a part that does not prove `enough` is to have its windows halved, rather than its range
  // of Rs.
  virtual bool SplitsWindows(const BranchPart& part, double enough) const = 0;
  // The largest current, which rounding is measured by.
  virtual double Scale() const = 0;
  virtual Eigen::Index Points() const = 0;
};

// Windows of several diodes may overlap; a mixture needs them apart, at most one end shared, each with
// the Is of all diodes in it.
std::vector<Window> Union(std::vector<Window> windows);

}  // namespace lyrefit
