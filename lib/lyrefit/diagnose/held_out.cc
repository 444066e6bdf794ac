#include "lyrefit/diagnose/describe.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/parallel.h"

namespace lyrefit {
namespace {

struct Squares {
  double sum = 0;
  double count = 0;
  double Mean() const { return count > 0 ? sum / count : 0; }
};

// Sums of squares of one fold, in squared current scales.
struct Fold {
  Squares before;
  Squares after;
  std::vector<Squares> trials;
};

// Used readings of a fold.
std::vector<int> HeldReadings(const std::vector<int>& folds, int fold,
                              const std::vector<char>& counted) {
  std::vector<int> held_out;
  for (std::size_t k = 0; k < folds.size(); ++k) {
    if (folds[k] == fold && counted[k] != 0) held_out.push_back(static_cast<int>(k));
  }
  return held_out;
}

Squares SquaresAt(const Readings& readings, const std::vector<int>& held_out,
                  const std::vector<double>& current) {
  Squares squares;
  for (const int k : held_out) {
    const Reading& reading = readings.points[k];
    const double r = current[k] - reading.current;
    squares.sum += reading.weight * (r * r + reading.scatter);
    squares.count += reading.weight;
  }
  return squares;
}

// Number of effects that a repeated selection fits in a step.
constexpr int kFittedCandidates = 4;

// Fits start at the parameters of the fit to all readings, so a few steps suffice.
const LeastSquaresOptions kNearby = UpTo(8, 1e-5);

void AddSquares(const Squares& from, Squares* to) {
  to->sum += from.sum;
  to->count += from.count;
}

// Sweep number of each reading. With three or more curves a sweep is a curve, else a monotone
// stretch, numbered over the set. A stretch of less than kFewest readings, as from a hesitating
// voltage, belongs to the sweep beside it.
std::vector<int> SweepOfEach(const Readings& readings) {
  constexpr int kFewest = 7;  // fewest readings of a sweep
  const std::vector<Reading>& points = readings.points;
  const std::size_t count = points.size();
  const bool by_curve = readings.traits.curves > 2;
  std::vector<int> of;
  int sweep = 0, length = 0;
  for (std::size_t first = 0, last = 0; first < count; first = last) {
    while (last < count && points[last].segment == points[first].segment) ++last;
    const int stretch = static_cast<int>(last - first);
    const bool next_curve = first > 0 && points[first].curve != points[first - 1].curve;
    if (next_curve || (!by_curve && stretch >= kFewest && length >= kFewest)) {
      ++sweep;
      length = 0;
    }
    length += stretch;
    of.insert(of.end(), stretch, sweep);
  }
  return of;
}

// Options for repeating the selection on a subset of the readings.
SelectOptions Repeated(const SelectOptions& options, const Selection& selection) {
  SelectOptions inner = options;
  inner.repeats = true;
  inner.most_fitted_candidates = kFittedCandidates;
  inner.hint = selection.extended;
  inner.met = &selection.trials.candidates;
  inner.base = selection.base.law;
  inner.start = selection.base.p;
  inner.signatures = selection.signatures;
  return inner;
}

// Squares at the `held_out` readings of a fold. The base model, each trial and the whole selection
// are fitted without these readings. Empty if a fit fails.
Fold MissOf(const std::vector<int>& held_out, const std::vector<char>& used,
            const Measurement& measurement, const SelectOptions& options,
            const Selection& selection) {
  const Readings& readings = measurement.readings;
  const Selection again =
      SelectCauses(measurement, used, selection.weighted.correlation, Repeated(options, selection));
  Fold fold;
  if (!again.base.usable || !again.extended.usable || options.progress.Stopped()) return fold;
  fold.before = SquaresAt(readings, held_out, again.base.current);
  fold.after = SquaresAt(readings, held_out, again.extended.current);
  WeightedData weighted = selection.base_weighted;
  for (std::size_t k = 0; k < used.size(); ++k)
    weighted.used[k] = weighted.used[k] != 0 ? used[k] : 0;
  for (const FittedCandidate& fitted : selection.trials.candidates) {
    Squares squares;
    if (fitted.fit.usable) {
      const LawFit fit = FitLaw(weighted, fitted.fit.law, fitted.fit.p, kNearby);
      if (fit.usable) squares = SquaresAt(readings, held_out, fit.current);
    }
    fold.trials.push_back(squares);
  }
  options.progress.Count();
  return fold;
}

// Combines the folds whose fits succeeded.
HeldOutErrors Summarise(const std::vector<Fold>& folds, const Readings& readings,
                        const std::vector<FittedCandidate>& tried) {
  HeldOutErrors errors;
  Squares before, after;
  std::vector<Squares> by_trial(tried.size());
  std::vector<double> gains;
  for (const Fold& fold : folds) {
    if (fold.before.count == 0) continue;
    AddSquares(fold.before, &before);
    AddSquares(fold.after, &after);
    for (std::size_t t = 0; t < by_trial.size(); ++t) AddSquares(fold.trials[t], &by_trial[t]);
    gains.push_back(fold.before.Mean() - fold.after.Mean());
  }
  errors.folds = static_cast<int>(gains.size());
  errors.by_sweeps = LeavesSweepsOut(readings);
  if (gains.size() < 2) return errors;
  const double scale = readings.scale.current_A;
  errors.before_A = scale * std::sqrt(before.Mean());
  errors.after_A = scale * std::sqrt(after.Mean());
  double mean = 0, square = 0;
  for (const double g : gains) mean += g / static_cast<double>(gains.size());
  for (const double g : gains) square += (g - mean) * (g - mean);
  const double n = static_cast<double>(gains.size());
  errors.gain_A2 = scale * scale * mean;
  errors.gain_error_A2 = scale * scale * std::sqrt(square / (n * (n - 1)));
  for (std::size_t t = 0; t < by_trial.size(); ++t) {
    if (by_trial[t].count == 0) continue;
    errors.effects_A[tried[t].score.effect->id] = scale * std::sqrt(by_trial[t].Mean());
  }
  return errors;
}

}  // namespace

bool LeavesSweepsOut(const Readings& readings) {
  const std::vector<int> sweeps = SweepOfEach(readings);
  return *std::max_element(sweeps.begin(), sweeps.end()) >= 2;
}

std::vector<int> MakeFolds(const Readings& readings, int folds) {
  std::vector<int> of = SweepOfEach(readings);
  const int count = static_cast<int>(of.size());
  if (!LeavesSweepsOut(readings)) {
    const int length = std::max(2, count / (3 * folds));
    for (int k = 0; k < count; ++k) of[k] = k / length;
  }
  for (int& fold : of) fold %= folds;
  return of;
}

HeldOutErrors MeasureHeldOut(const Measurement& measurement, const SelectOptions& options,
                             const Selection& selection, int folds, int threads) {
  const Readings& readings = measurement.readings;
  const std::vector<int> of = MakeFolds(readings, folds);
  const int used_folds = *std::max_element(of.begin(), of.end()) + 1;
  std::vector<Fold> results(used_folds);
  options.progress.Begin("held out", used_folds);
  ParallelFor(used_folds, threads, [&](int f) {
    const std::vector<int> held_out = HeldReadings(of, f, selection.weighted.used);
    if (held_out.empty() || options.progress.Stopped()) return;
    std::vector<char> used(of.size(), 1);
    for (std::size_t k = 0; k < of.size(); ++k) used[k] = of[k] != f ? 1 : 0;
    results[f] = MissOf(held_out, used, measurement, options, selection);
  });
  if (options.progress.Stopped()) return {};
  return Summarise(results, readings, selection.trials.candidates);
}

}  // namespace lyrefit
