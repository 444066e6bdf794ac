#pragma once

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/base/parallel.h"

namespace lyrefit {

// Multistart of a local method: many starts take a few steps each and the better ones take more,
// stage by stage. The last stage runs those near the best to convergence, one at a time, until
// enough of them have reached the best optimum.

// Current state of one start. Callers derive from it and add the point.
struct MultistartEnd {
  double value = HUGE_VAL;  // lower is better; HUGE_VAL: not evaluated, or cannot be
  int group = 0;            // index of a model variant, for example
  bool finished = false;    // has run in the last stage, or is at the best end that has
};

constexpr std::size_t kAllEnds = static_cast<std::size_t>(-1);

struct MultistartStage {
  int steps = 0;                // for the refinement alone
  std::size_t keep = kAllEnds;  // number of best ends that go on; of the last stage: that run in it
  // Index of the data or weights that the refinement uses. Values of different problems do not
  // compare, so they are forgotten when it changes.
  int problem = 0;
  // The best `of_group` of each group also go on; with `spare_hopeless` even if hopeless.
  int of_group = 0;
  bool spare_hopeless = false;
};

struct MultistartRules {
  std::vector<MultistartStage> stages;
  MultistartStage last;
  double hopeless = 1e100;  // times the best value: ends above it do not go on
  // The last stage does not run an end above `close` times the best value; nor one less than a
  // relative `apart` above the entry value of the end run before it; nor one of the best end's
  // group after `visits` ends have reached the best optimum.
  double close = HUGE_VAL;
  double apart = 0;
  int visits = INT_MAX;
  int threads = 1;  // of all stages but the last; never changes a result
  // Counts one step a refinement. After a stop request, each stage but the last refines one end,
  // and the last stage one if there is no best end.
  ProgressReporter progress = {};
};

// The ends of all starts, in order of the starts.
template <class End>
struct Multistart {
  std::vector<End> ends;
  int best = -1;  // index of the lowest value, of equal ones the first to reach it; -1: none

  const End& Best() const { return ends[best]; }
};

// For a multistart that does not compare its ends.
inline bool NeverSame(const MultistartEnd& /*a*/, const MultistartEnd& /*b*/) { return false; }

// Number of finished ends in the best optimum.
template <class End, class Same>
int Visits(const Multistart<End>& run, const Same& same) {
  return static_cast<int>(std::count_if(run.ends.begin(), run.ends.end(), [&](const End& end) {
    return end.finished && same(end, run.Best());
  }));
}

// For each finished end the index of the first one in its optimum, compared with first ones alone;
// -1 for the others.
template <class End, class Same>
std::vector<int> FirstOfOptimum(const std::vector<End>& ends, const Same& same) {
  std::vector<int> first(ends.size(), -1);
  for (int i = 0; i < static_cast<int>(ends.size()); ++i) {
    if (!ends[i].finished) continue;
    int k = 0;
    while (k < i && !(first[k] == k && same(ends[i], ends[k]))) ++k;
    first[i] = k;
  }
  return first;
}

namespace multistart {

template <class End>
void UpdateBest(Multistart<End>* run, int i) {
  if (run->best < 0 || run->ends[i].value < run->Best().value) run->best = i;
}

template <class End>
void ForgetValues(Multistart<End>* run) {
  for (End& end : run->ends) end.value = HUGE_VAL;
  run->best = -1;
}

// Refines the ends `on`, then leaves those that go on, best first.
template <class End, class Refine>
void RunStage(const MultistartRules& rules, const MultistartStage& stage, const Refine& refine,
              Multistart<End>* run, std::vector<int>* on) {
  ParallelFor(static_cast<int>(on->size()), rules.threads, [&](int k) {
    if (k > 0 && rules.progress.stop().requested()) return;
    refine(stage, &run->ends[(*on)[k]]);
    rules.progress.Step();
  });
  for (const int i : *on) UpdateBest(run, i);
  std::stable_sort(on->begin(), on->end(),
                   [&](int a, int b) { return run->ends[a].value < run->ends[b].value; });
  std::vector<int> left;
  std::map<int, int> of_group;
  for (const int i : *on) {
    const bool hopeless = run->ends[i].value > rules.hopeless * run->Best().value;
    const bool first = ++of_group[run->ends[i].group] <= stage.of_group;
    if (hopeless ? first && stage.spare_hopeless : first || left.size() < stage.keep) {
      left.push_back(i);
    }
  }
  *on = std::move(left);
}

template <class End, class Refine, class Same>
void RunLastStage(const MultistartRules& rules, const std::vector<double>& entry,
                  const Refine& refine, const Same& same, const std::vector<int>& on,
                  Multistart<End>* run) {
  std::size_t refined = 0;
  double previous = 0;
  for (std::size_t k = 0; k < on.size() && refined < rules.last.keep; ++k) {
    End& at = run->ends[on[k]];
    if (run->best >= 0) {
      const End& best = run->Best();
      const bool reached = best.finished && best.group == at.group;
      if (rules.progress.stop().requested()) return;
      if (entry[k] > rules.close * best.value) continue;
      if (reached && Visits(*run, same) >= rules.visits) continue;
      at.finished = reached && same(at, best);
      if (at.finished) continue;
    }
    if (entry[k] < (1 + rules.apart) * previous) continue;
    previous = entry[k];
    refine(rules.last, &at);
    at.finished = true;
    ++refined;
    UpdateBest(run, on[k]);
    rules.progress.Step();
  }
}

}  // namespace multistart

// Appends `starts` to `run` and takes them through the stages. Ends of earlier calls count for the
// best value and its visits. refine(stage, &end) continues a descent and sets its value; except in
// the last stage it must depend on this end alone. same(a, b): whether two ends are in one optimum.
template <class End, class Refine, class Same>
void RunMultistart(const MultistartRules& rules, std::vector<End> starts, const Refine& refine,
                   const Same& same, Multistart<End>* run) {
  std::vector<int> on;
  on.reserve(starts.size());
  for (End& start : starts) {
    on.push_back(static_cast<int>(run->ends.size()));
    run->ends.push_back(std::move(start));
    if (std::isfinite(run->ends.back().value)) multistart::UpdateBest(run, on.back());
  }
  int problem = rules.stages.empty() ? rules.last.problem : rules.stages.front().problem;
  for (const MultistartStage& stage : rules.stages) {
    if (stage.problem != problem) multistart::ForgetValues(run);
    problem = stage.problem;
    multistart::RunStage(rules, stage, refine, run, &on);
  }
  std::vector<double> entry;
  entry.reserve(on.size());
  for (const int i : on) entry.push_back(run->ends[i].value);
  if (rules.last.problem != problem) multistart::ForgetValues(run);
  multistart::RunLastStage(rules, entry, refine, same, on, run);
}

}  // namespace lyrefit
