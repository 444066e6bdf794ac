#pragma once

#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/fit/polish.h"
#include "lyrefit/law/variants.h"
#include "lyrefit/refine/refine.h"

namespace lyrefit {

// Current end of the descent from one start. `penalised` is its mean square times the squared
// penalty factor of the variant (VariantPenalty); it ranks ends of different variants.
struct DescentEnd {
  PolishStart start;
  RefineEnd end;
  double penalised = 0;
  bool finished = false;  // false: not yet run to convergence, or stopped early
};

// Multi-start descent for a device with effects, which has many local optima. Many starts take a
// few steps each and the better ones take more. Those near the best are then run to convergence,
// until enough of them have reached the best optimum.
class Descents {
 public:
  Descents(const RefineProblem& problem, const std::vector<Variant>& variants,
           const ProgressReporter& progress)
      : problem_(problem), variants_(variants), progress_(progress) {}

  // Descends from `starts`. The other members need at least one start before their first call.
  void Descend(std::vector<PolishStart> starts);

  const std::vector<DescentEnd>& ends() const { return ends_; }  // in the order of the starts
  int best() const { return best_; }                             // index into ends()
  int visits() const;  // finished ends in the best optimum
  OptimumCount Count() const;

 private:
  void GoOn(std::vector<int>* ways, int steps, std::size_t most);
  void Finish(const std::vector<int>& ways);
  void Take(int way, RefineEnd end);
  bool IsHopeless(const DescentEnd& end) const;

  const RefineProblem& problem_;
  const std::vector<Variant>& variants_;
  const ProgressReporter progress_;
  std::vector<DescentEnd> ends_;
  int best_ = -1;
};

}  // namespace lyrefit
