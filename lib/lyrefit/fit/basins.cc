#include "lyrefit/fit/basins.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/fit/form_problem.h"
#include "lyrefit/law/law.h"

namespace lyrefit {
namespace {

constexpr int kFirst = 5, kMore = 9, kOn = 20, kToTheEnd = 100;  // steps
constexpr std::size_t kOnwards = 12, kAhead = 6;
constexpr int kOfEachForm = 2;       // go on whatever the others do
constexpr double kClose = 1.02;      // of the lowest RMSE: what may be the best after so many steps
constexpr double kNear = 3;          // of the lowest RMSE: what may still become the best
constexpr int kEnough = 3;           // ends in the best basin
constexpr double kSameBasin = 1e-6;  // relative, of the mean square

// A form that another one holds in it comes to the same curve.
bool SameBasin(const BasinEnd& a, const BasinEnd& b) {
  return std::fabs(a.end.mean_square - b.end.mean_square) <= kSameBasin * b.end.mean_square;
}

}  // namespace

void Basins::Descend(std::vector<PolishStart> starts) {
  std::vector<int> ways;
  for (PolishStart& start : starts) {
    RefineEnd here;
    here.p = start.p;
    LawWorkspace impatient(GiveUp::kSlow);
    here.mean_square = MeanSquare(problem_, start.p, &impatient);
    here.held.assign(start.p.size(), false);
    ways.push_back(static_cast<int>(ends_.size()));
    ends_.emplace_back();
    ends_.back().start = std::move(start);
    Take(ways.back(), std::move(here));
  }
  GoOn(&ways, kFirst, kOnwards);
  GoOn(&ways, kMore, kAhead);
  GoOn(&ways, kOn, kAhead);
  ways.erase(
      std::remove_if(ways.begin(), ways.end(), [this](int way) { return IsHopeless(ends_[way]); }),
      ways.end());
  GoOn(&ways, kToTheEnd, kAhead);
  Finish(ways);
}

// All go on by so many steps; the `most` best of them are left, the best first.
void Basins::GoOn(std::vector<int>* ways, int steps, std::size_t most) {
  RefineOptions briefly;
  briefly.small = true;
  briefly.let_in = false;
  briefly.max_rounds = 1;
  briefly.max_iterations = briefly.first_iterations = steps;
  briefly.trust_radius = 1e4;
  briefly.impatient = true;
  briefly.stop = watch_->stop();
  for (const int way : *ways) {
    const BasinEnd& at = ends_[way];
    const RefineProblem own = InForm(problem_, forms_[at.start.form], at.end.p);
    Take(way, Refine(own, at.end.p, briefly));
    if (watch_->Next()) break;
  }
  std::stable_sort(ways->begin(), ways->end(),
                   [this](int a, int b) { return ends_[a].paid < ends_[b].paid; });
  std::vector<int> left, of_form(forms_.size(), 0);
  for (const int way : *ways) {
    const BasinEnd& at = ends_[way];
    const bool among_first = ++of_form[at.start.form] <= kOfEachForm;
    if (among_first || (left.size() < most && !IsHopeless(at))) left.push_back(way);
  }
  *ways = std::move(left);
}

// Far above what has been reached already.
bool Basins::IsHopeless(const BasinEnd& end) const {
  return end.paid > kNear * kNear * ends_[best_].paid;
}

void Basins::Finish(const std::vector<int>& ways) {
  RefineOptions whole;
  whole.stop = watch_->stop();
  for (const int way : ways) {
    BasinEnd& at = ends_[way];
    const BasinEnd& best = ends_[best_];
    const bool known = best.finished && best.start.form == at.start.form && visits() >= kEnough;
    if (watch_->stopped()) break;
    if (known || at.paid > kClose * kClose * best.paid) continue;
    // On its way it came to where another one ended.
    at.finished = best.finished && best.start.form == at.start.form && SameBasin(at, best);
    if (at.finished) continue;
    const RefineProblem own = InForm(problem_, forms_[at.start.form], at.end.p);
    Take(way, Refine(own, at.end.p, whole));
    at.finished = true;
  }
}

// Where a way has come to, unless it was lower before; and whether it is the best.
void Basins::Take(int way, RefineEnd end) {
  BasinEnd& at = ends_[way];
  const double factor = FormFactor(problem_, forms_[at.start.form]);
  const double paid = end.mean_square * factor * factor;
  constexpr double kSame = 1e-12;  // relative: rounding of one evaluation or another
  if (!at.end.p.empty() && !(paid <= at.paid * (1 + kSame))) return;
  at.end = std::move(end);
  at.paid = std::isfinite(paid) ? paid : HUGE_VAL;
  if (best_ < 0 || at.paid < ends_[best_].paid) best_ = way;
}

int Basins::visits() const {
  return static_cast<int>(std::count_if(ends_.begin(), ends_.end(), [this](const BasinEnd& end) {
    return end.finished && SameBasin(end, ends_[best_]);
  }));
}

BasinCount Basins::Count() const {
  struct Basin {
    const BasinEnd* first;
    int ends, apart;
  };
  std::vector<Basin> basins;
  BasinCount count;
  for (const BasinEnd& end : ends_) {
    if (!end.finished) continue;
    auto basin = std::find_if(basins.begin(), basins.end(),
                              [&](const Basin& known) { return SameBasin(end, *known.first); });
    if (basin == basins.end()) basin = basins.insert(basin, {&end, 0, 0});
    ++basin->ends;
    basin->apart += end.start.beside ? 0 : 1;
  }
  BasinCount::Independent& independent = count.independent;
  for (const Basin& basin : basins) {
    count.ends += basin.ends;
    independent.ends += basin.apart;
    independent.basins += basin.apart > 0 ? 1 : 0;
    independent.once += basin.apart == 1 ? 1 : 0;
    independent.twice += basin.apart == 2 ? 1 : 0;
    if (!SameBasin(*basin.first, ends_[best_])) continue;
    count.best_visits += basin.ends;
    independent.best_visits += basin.apart;
  }
  count.basins = static_cast<int>(basins.size());
  constexpr int kLeast = 3;
  if (independent.ends >= kLeast) {
    count.unseen = independent.once * (independent.once - 1) / (2.0 * (independent.twice + 1));
  }
  return count;
}

}  // namespace lyrefit
