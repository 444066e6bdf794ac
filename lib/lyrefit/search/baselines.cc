// Differential evolution DE/rand/1/bin (Storn and Price 1997, doi:10.1023/A:1008202821328). Two
// choices of this library: acceptance is greedy and in place, and mutants are clamped to the box,
// as in lyrebird.cc.
// Uniform random search, the baseline of every comparison of metaheuristics. Slot i of the
// population keeps the best of its own draws, from which the elites are taken.
#include <algorithm>

#include "lyrefit/base/random.h"
#include "lyrefit/search/run.h"

namespace lyrefit {
namespace {

// Draws three different candidates other than `candidate`.
void DrawThree(RandomStream* random, int population, int candidate, int (&three)[3]) {
  for (int k = 0; k < 3; ++k) {
    bool taken;
    do {
      three[k] = static_cast<int>(random->Index(population));
      taken = three[k] == candidate || std::find(three, three + k, three[k]) != three + k;
    } while (taken);
  }
}

}  // namespace

void RunDifferentialEvolution(SearchRun* run, const SearchOptions& options) {
  RandomStream random(options.seed, options.run);
  DrawPopulation(run, &random, options.iterations);
  const Box& box = run->box();
  const int dimensions = run->dimensions();
  std::vector<double> trial(dimensions);
  for (std::int64_t t = 1; !run->stopped(); ++t) {
    for (int i = 0; i < run->population() && !run->stopped(); ++i) {
      int three[3];
      DrawThree(&random, run->population(), i, three);
      const double* a = run->x(three[0]);
      const double* b = run->x(three[1]);
      const double* c = run->x(three[2]);
      const int always = static_cast<int>(random.Index(dimensions));
      for (int j = 0; j < dimensions; ++j) {
        const bool cross = random.Uniform() < options.de_crossover || j == always;
        trial[j] = cross ? a[j] + options.de_scale * (b[j] - c[j]) : run->x(i)[j];
        trial[j] = std::min(std::max(trial[j], box.lower[j]), box.upper[j]);
      }
      const double value = run->Evaluate(trial.data());
      if (value <= run->f(i)) run->Replace(i, trial.data(), value);
    }
    run->EndIteration(t, options.iterations);
  }
}

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
