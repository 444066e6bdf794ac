// Uniform random search, the baseline of every comparison of metaheuristics. Slot i of the
// population keeps the best of its own draws, from which the elites are taken.

#include "lyrefit/base/random.h"
#include "lyrefit/search/run.h"

namespace lyrefit {

void RunRandom(SearchRun* run, const SearchOptions& options) {
  RandomStream random(options.seed, options.run);
  DrawPopulation(run, &random, options.iterations);
  std::vector<double> x(run->dimensions());
  for (std::int64_t t = 1; !run->stopped(); ++t) {
    for (int i = 0; i < run->population() && !run->stopped(); ++i) {
      DrawPoint(run->box(), &random, x.data());
      const double value = run->Evaluate(x.data());
      if (value < run->f(i)) run->Replace(i, x.data(), value);
    }
    run->EndIteration(t, options.iterations);
  }
}

}  // namespace lyrefit
