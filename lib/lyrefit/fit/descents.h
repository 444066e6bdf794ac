#pragma once

#include <vector>

#include "lyrefit/fit/fit_report.h"
#include "lyrefit/fit/fit_watch.h"
#include "lyrefit/fit/polish.h"
#include "lyrefit/law/variants.h"
#include "lyrefit/refine/refine.h"

namespace lyrefit {

// Where the descent from a start has come to. `penalised`: its mean square with what the variant pays for
// its free parameters (VariantPenalty), which decides between variants.
struct DescentEnd {
  PolishStart start;
  RefineEnd end;
  double penalised = 0;
  bool finished = false;  // false: given up, out of reach of the best
};

// Descents of a device with effects, whose landscape has many local optima: from many starts a few steps
// each, from the better ones some more, and to the end from those that are then near the best,
// until that has been reached often enough.
class Descents {
 public:
  Descents(const RefineProblem& problem, const std::vector<Variant>& variants, FitWatch* watch)
      : problem_(problem), variants_(variants), watch_(watch) {}

  // At least one start in all before anything is asked.
  void Descend(std::vector<PolishStart> starts);

  const std::vector<DescentEnd>& ends() const { return ends_; }  // in the order of the starts
  int best() const { return best_; }                           // index into ends()
  int visits() const;                                          // finished ends in the best local optimum
  OptimumCount Count() const;

 private:
  void GoOn(std::vector<int>* ways, int steps, std::size_t most);
  void Finish(const std::vector<int>& ways);
  void Take(int way, RefineEnd end);
  bool IsHopeless(const DescentEnd& end) const;

  const RefineProblem& problem_;
  const std::vector<Variant>& variants_;
  FitWatch* watch_;
  std::vector<DescentEnd> ends_;
  int best_ = -1;
};

}  // namespace lyrefit
