#include "lyrefit/translate/draws.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lyrefit/base/observer.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/random.h"
#include "lyrefit/translate/linear_budget.h"

namespace lyrefit {
namespace {

constexpr int kBlock = 256;  // consecutive draws of one thread

int BlocksOf(int draws) { return (draws + kBlock - 1) / kBlock; }

double Draw(const UncertainInput& input, RandomStream* random) {
  const double deviate = input.distribution == Distribution::kNormal
                             ? random->Normal()
                             : std::sqrt(3.0) * (2 * random->Uniform() - 1);
  return input.value + input.standard_uncertainty * deviate;
}

void AddTerm(const OutputTerm& term, RandomStream* random, std::vector<double>* outputs) {
  for (const std::vector<double>& factor : term.factors) {
    const double deviate = random->Normal();
    for (std::size_t k = 0; k < outputs->size(); ++k) (*outputs)[k] += factor[k] * deviate;
  }
}

void AddChoice(const ChoiceRange& range, const std::vector<double>& reported, RandomStream* random,
               std::vector<double>* outputs) {
  const double part = random->Uniform();
  for (std::size_t k = 0; k < outputs->size(); ++k) {
    const double at = range.against[k] != 0 ? 1 - part : part;
    (*outputs)[k] += range.low[k] + at * (range.high[k] - range.low[k]) - reported[k];
  }
}

// samples[result][draw]; incomplete if the observer requested a stop.
std::vector<std::vector<double>> DrawAll(const UncertainModel& model,
                                         const UncertaintySources& sources, int threads,
                                         const UncertaintyBudget& budget,
                                         const ProgressReporter& progress) {
  std::vector<double> reported;
  for (const UncertainOutput& output : budget.outputs) reported.push_back(output.value);
  std::vector<ChoiceRange> ranges;
  for (const OutputChoice& choice : sources.choices) ranges.push_back(RangeOf(choice, reported));
  std::vector<std::vector<double>> samples(reported.size(), std::vector<double>(budget.draws));

  const auto draw_one = [&](int draw) {
    RandomStream random(budget.seed, static_cast<std::uint64_t>(draw));
    std::vector<double> inputs(sources.inputs.size());
    for (std::size_t i = 0; i < inputs.size(); ++i) inputs[i] = Draw(sources.inputs[i], &random);
    std::vector<double> outputs = EvaluateAt(model, inputs);
    for (const OutputTerm& term : sources.terms) AddTerm(term, &random, &outputs);
    for (const ChoiceRange& range : ranges) AddChoice(range, reported, &random, &outputs);
    for (std::size_t k = 0; k < outputs.size(); ++k) samples[k][draw] = outputs[k];
  };
  ParallelFor(BlocksOf(budget.draws), threads, [&](int block) {
    if (progress.Stopped()) return;
    const int end = std::min(budget.draws, (block + 1) * kBlock);
    for (int draw = block * kBlock; draw < end; ++draw) draw_one(draw);
    progress.Step();
  });
  return samples;
}

// Moments are summed in the order of the draws, so that they are reproducible.
void AddMoments(const std::vector<double>& samples, DrawnInterval* drawn) {
  const double n = static_cast<double>(samples.size());
  double sum = 0;
  for (const double sample : samples) sum += sample;
  drawn->mean = sum / n;
  double squares = 0, cubes = 0;
  for (const double sample : samples) {
    const double aside = sample - drawn->mean;
    squares += aside * aside;
    cubes += aside * aside * aside;
  }
  drawn->standard_deviation = std::sqrt(squares / (n - 1));
  const double variance = squares / n;
  drawn->skewness = variance > 0 ? cubes / n / (variance * std::sqrt(variance)) : 0;
}

// Standard error of the order statistic at `part`. The rank of a quantile is binomial, so the error
// is half the distance of the samples one standard deviation in rank to either side.
double EndError(const std::vector<double>& rising, double part) {
  const double n = static_cast<double>(rising.size());
  const double spread = std::sqrt(n * part * (1 - part));
  const auto at = [&](double rank) {
    return rising[static_cast<std::size_t>(std::clamp(rank, 0.0, n - 1))];
  };
  return 0.5 * (at(part * n + spread) - at(part * n - spread));
}

void AddInterval(const std::vector<double>& rising, double probability, DrawnInterval* drawn) {
  const std::size_t n = rising.size();
  const double tail = 0.5 * (1 - probability);
  const auto below = static_cast<std::size_t>(tail * static_cast<double>(n));
  drawn->low = rising[below];
  drawn->high = rising[n - 1 - below];
  drawn->low_error = EndError(rising, tail);
  drawn->high_error = EndError(rising, 1 - tail);
}

}  // namespace

void AddDraws(const UncertainModel& model, const UncertaintySources& sources, int threads,
              const Observer& observer, UncertaintyBudget* budget) {
  const ProgressReporter progress(observer, "draws", BlocksOf(budget->draws));
  std::vector<std::vector<double>> samples = DrawAll(model, sources, threads, *budget, progress);
  if (progress.Stopped()) {
    budget->draws = 0;
    return;
  }
  for (std::size_t k = 0; k < samples.size(); ++k) {
    UncertainOutput& output = budget->outputs[k];
    std::vector<double>& finite = samples[k];
    finite.erase(std::remove_if(finite.begin(), finite.end(),
                                [](double sample) { return !std::isfinite(sample); }),
                 finite.end());
    output.failed_draws = budget->draws - static_cast<int>(finite.size());
    if (!std::isfinite(output.value)) continue;
    if (output.failed_draws > 0) {
      budget->warnings.push_back(fmt::format("{} of {} draws have no {}: they are left out",
                                             output.failed_draws, budget->draws,
                                             output.quantity.title));
    }
    if (finite.size() < 2) continue;
    AddMoments(finite, &output.drawn);
    std::sort(finite.begin(), finite.end());
    AddInterval(finite, budget->coverage_probability, &output.drawn);
    output.samples = std::move(finite);
  }
}

CoverageInterval ShortestInterval(const std::vector<double>& rising, double probability) {
  const std::size_t n = rising.size();
  const auto inside = static_cast<std::size_t>(std::lround(probability * static_cast<double>(n)));
  if (n == 0) return {};
  if (inside >= n) return {rising.front(), rising.back()};
  std::size_t best = 0;
  for (std::size_t i = 0; i + inside < n; ++i) {
    if (rising[i + inside] - rising[i] < rising[best + inside] - rising[best]) best = i;
  }
  return {rising[best], rising[best + inside]};
}

}  // namespace lyrefit
