// Flocks of self-tuned lyrebirds one after another in the budget of one search, as many as elites
// are asked for: their ends are independent, so that a polish gets starts from different basins.
//
// What did not help, and is not here: drawing birds away from earlier ends (after the sequential
// niching of Beasley, Bull and Martin 1993, doi:10.1162/evco.1993.1.2.101), since in 7 to 11
// dimensions a random bird is hardly ever near one; ending a flock that crowds or gains nothing;
// ending the search when flocks end where others did.

#include <algorithm>

#include "lyrefit/search/lyrebird.h"

namespace lyrefit {
namespace {

// Half the birds with twice the moves each: the polish of their ends takes less time.
constexpr int kSmallest = 4;  // birds
constexpr int kShortest = 5;  // rounds: a draw and four moves of every bird

void DrawFlock(SearchRun* run, RandomStream* random) {
  std::vector<double> x(run->dimensions());
  for (int i = 0; i < run->population() && !run->stopped(); ++i) {
    DrawPoint(run->box(), random, x.data());
    run->Replace(i, x.data(), run->Evaluate(x.data()));
  }
}

}  // namespace

void RunFlocks(SearchRun* run, const SearchOptions& options) {
  RandomStream random(options.seed, options.run);
  const int birds = std::max(kSmallest, run->population() / 2);
  const int rounds = run->population() / birds;  // in one iteration of the search
  run->UseBirds(birds);
  const std::int64_t all = rounds * (std::int64_t{1} + options.iterations);
  const std::int64_t flocks = std::clamp<std::int64_t>(all / kShortest, 1, options.elites);
  const std::int64_t each = all / flocks;  // rounds of a flock; the last one has what is left over
  Lyrebird flock(run, options, &random);
  for (std::int64_t t = 0, round = 0; !run->stopped(); ++t) {
    for (int k = 0; k < rounds && !run->stopped(); ++k, ++round) {
      const std::int64_t age = round - std::min(round / each, flocks - 1) * each;
      if (age == 0) {
        if (round > 0) run->EndFlock();
        DrawFlock(run, &random);
        flock.Settle();
      } else {
        flock.Move(static_cast<double>(age), static_cast<double>(each - 1));
      }
    }
    run->EndIteration(t, options.iterations);
  }
}

}  // namespace lyrefit
