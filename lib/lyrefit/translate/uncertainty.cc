#include "lyrefit/translate/uncertainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lyrefit/base/distributions.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/random.h"
#include "lyrefit/base/try.h"
#include "lyrefit/translate/translation_budget.h"

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

// Propagates the distributions by Monte Carlo (JCGM 101). Fills `drawn`, `samples` and
// `failed_draws` of the outputs that AddLinearBudget created. If `observer` stops it, they stay
// empty and the budget's `draws` becomes 0.
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

constexpr double kRounding = 1e-10;

Expected<void> CheckSources(const UncertaintySources& sources, std::size_t outputs) {
  for (const UncertainInput& input : sources.inputs) {
    if (!std::isfinite(input.value) || !(input.standard_uncertainty >= 0) ||
        std::isinf(input.standard_uncertainty)) {
      return Fail(input.name + ": expected a finite value and an uncertainty of 0 or more, found " +
                  NumberText(input.value) + " and " + NumberText(input.standard_uncertainty));
    }
  }
  const auto fits = [&](const std::vector<double>& each) { return each.size() == outputs; };
  for (const OutputTerm& term : sources.terms) {
    if (!std::all_of(term.factors.begin(), term.factors.end(), fits)) {
      return Fail(term.name + ": expected factors of " + std::to_string(outputs) + " results");
    }
  }
  for (const OutputChoice& choice : sources.choices) {
    if (!std::all_of(choice.answers.begin(), choice.answers.end(), fits)) {
      return Fail(choice.name + ": expected answers of " + std::to_string(outputs) + " results");
    }
  }
  return {};
}

}  // namespace

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

Expected<UncertaintyBudget> Propagate(const UncertainModel& model,
                                      const UncertaintySources& sources,
                                      const UncertaintyOptions& options, const Observer& observer) {
  TRY(ValidateOptions(options, kUncertaintyOptionTable));
  TRY(CheckSources(sources, model.outputs.size()));
  UncertaintyBudget budget;
  budget.coverage_factor = options.coverage_factor;
  budget.coverage_probability = 1 - 2 * NormalTail(options.coverage_factor);
  budget.draws = options.draws;
  budget.seed = options.seed;
  AddLinearBudget(model, sources, &budget);
  if (std::none_of(budget.outputs.begin(), budget.outputs.end(),
                   [](const UncertainOutput& each) { return std::isfinite(each.value); })) {
    return Fail("none of the results has a value at the inputs as they are");
  }
  if (options.draws > 0) AddDraws(model, sources, options.threads, observer, &budget);
  JudgeAgreement(model, sources, options.significant_digits, &budget);
  return budget;
}

double UncertainOutput::low() const {
  return agreement == Agreement::kDisagree ? drawn.low : value - expanded_uncertainty;
}

double UncertainOutput::high() const {
  return agreement == Agreement::kDisagree ? drawn.high : value + expanded_uncertainty;
}

double UncertainOutput::ProbabilityBelow(double x) const {
  if (!samples.empty()) {
    const auto below = std::lower_bound(samples.begin(), samples.end(), x) - samples.begin();
    return static_cast<double>(below) / static_cast<double>(samples.size());
  }
  if (!(standard_uncertainty > 0)) return value < x ? 1 : 0;
  return NormalTail((value - x) / standard_uncertainty);
}

std::vector<std::vector<double>> FactorsOf(std::vector<std::vector<double>> covariance) {
  const std::size_t n = covariance.size();
  std::vector<double> whole(n);
  for (std::size_t k = 0; k < n; ++k) whole[k] = covariance[k][k];
  std::vector<std::vector<double>> factors;
  for (std::size_t k = 0; k < n; ++k) {
    // A variable that is determined by the previous ones has only rounding left.
    if (!(covariance[k][k] > kRounding * whole[k])) continue;
    const double root = std::sqrt(covariance[k][k]);
    std::vector<double> factor(n, 0);
    for (std::size_t i = k; i < n; ++i) factor[i] = covariance[i][k] / root;
    for (std::size_t i = k; i < n; ++i) {
      for (std::size_t j = k; j < n; ++j) covariance[i][j] -= factor[i] * factor[j];
    }
    factors.push_back(std::move(factor));
  }
  return factors;
}

}  // namespace lyrefit
