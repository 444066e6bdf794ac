#include "lyrefit/devices/two_junction_problem.h"

#include <algorithm>
#include <cmath>

namespace lyrefit {
namespace {

// Sides of the box; the photocurrents of single curves follow.
enum Side { kCurrent1, kCurrent2, kShare, kIdeality1, kIdeality2, kSeriesPart, kShunt1, kShunt2 };
constexpr int kSides = 8;

constexpr double kLeastCurrent = 0.95;  // photocurrents, in parts of the smallest possible ones
constexpr double kMostCurrent = 1.8;
constexpr double kLeastShare = 0.15;  // of the open-circuit voltage
constexpr double kMostShare = 0.85;
constexpr double kFlattest = 3;               // largest ideality of the search
constexpr double kSteepest = 0.8;             // smallest one
constexpr double kMostSearchedSeries = 0.15;  // of Voc / Isc
constexpr double kLeastLogShunt = 1;          // ln of the shunt in Voc / Isc
constexpr double kMostLogShunt = 10;

// The smallest photocurrent of junction `j` that its curves allow, at full light.
double LeastPhotocurrent(const PreparedTwoJunctions& prepared, int photocurrent) {
  double least = 0;
  for (std::size_t c = 0; c < prepared.isc_A.size(); ++c) {
    for (const JunctionLight& light : prepared.problem.curves[c].light) {
      if (light.photocurrent == photocurrent && light.share > 0) {
        least = std::max(least, prepared.isc_A[c] / light.share);
      }
    }
  }
  return least;
}

double Within(const TwoJunctionProblem& problem, int i, double value) {
  return std::min(std::max(value, problem.lower[i]), problem.upper[i]);
}

// Sum of squared relative differences between the short-circuit currents and the lower
// photocurrents. Unknown lights leave the curve to the other junction.
double CurrentMisfit(const PreparedTwoJunctions& prepared, const std::array<double, 2>& full) {
  double sum = 0;
  for (std::size_t c = 0; c < prepared.isc_A.size(); ++c) {
    double lower = HUGE_VAL;
    bool open = false;
    for (int j = 0; j < 2; ++j) {
      const JunctionLight& light = prepared.problem.curves[c].light[j];
      const bool shared = light.photocurrent < kTwoJunctionParameters;
      open = open || !shared;
      if (shared) lower = std::min(lower, light.share * full[j]);
    }
    if (lower == 0) continue;  // the shunt of a dark junction carries all
    const double miss = lower / prepared.isc_A[c] - 1;
    if (std::isfinite(miss) && !(open && miss > 0)) sum += miss * miss;
  }
  return sum;
}

}  // namespace

Box TwoJunctionBox(const PreparedTwoJunctions& prepared) {
  Box box;
  const auto add = [&box](double lower, double upper) {
    box.lower.push_back(lower);
    box.upper.push_back(upper);
  };
  add(kLeastCurrent, prepared.problem.ordered ? 1.2 : kMostCurrent);
  add(prepared.problem.ordered ? 1 : kLeastCurrent, kMostCurrent);
  add(kLeastShare, kMostShare);
  add(kSteepest, kFlattest);
  add(kSteepest, kFlattest);
  add(0, kMostSearchedSeries);
  add(kLeastLogShunt, kMostLogShunt);
  add(kLeastLogShunt, kMostLogShunt);
  const int further = static_cast<int>(prepared.problem.parameters.size()) - kTwoJunctionParameters;
  for (int k = 0; k < further; ++k) add(kLeastCurrent, kMostCurrent);
  return box;
}

std::vector<double> ParametersAt(const PreparedTwoJunctions& prepared, const double* x) {
  const TwoJunctionProblem& problem = prepared.problem;
  std::vector<double> p(problem.parameters.size());
  const double resistance = prepared.voc_V / problem.current_scale_A;
  const auto set = [&](int i, double value) { p[i] = Within(problem, i, value); };
  // The least photocurrents are those of a junction that limits everywhere. Where the junctions are
  // interchangeable, only the first one limits.
  set(JunctionPhotocurrent(0),
      x[kCurrent1] * (problem.ordered ? prepared.isc_A.front()
                                      : LeastPhotocurrent(prepared, JunctionPhotocurrent(0))));
  set(JunctionPhotocurrent(1),
      problem.ordered ? x[kCurrent2] - 1
                      : x[kCurrent2] * LeastPhotocurrent(prepared, JunctionPhotocurrent(1)));
  for (std::size_t i = kTwoJunctionParameters; i < p.size(); ++i) {
    set(static_cast<int>(i), x[kSides + static_cast<int>(i) - kTwoJunctionParameters] *
                                 LeastPhotocurrent(prepared, static_cast<int>(i)));
  }
  set(kTwoJunctionSeries, x[kSeriesPart] * resistance);
  for (int j = 0; j < 2; ++j) {
    set(JunctionIdeality(j), x[kIdeality1 + j]);
    set(JunctionShunt(j), resistance * std::exp(x[kShunt1 + j]));
    const double share = j == 0 ? x[kShare] : 1 - x[kShare];
    const double exponent =
        share * prepared.voc_V / (p[JunctionIdeality(j)] * problem.thermal_voltage_V);
    set(JunctionSaturation(j), problem.current_scale_A * std::exp(-std::min(exponent, 600.0)));
  }
  return p;
}

std::vector<std::vector<double>> TwoJunctionStarts(const PreparedTwoJunctions& prepared) {
  constexpr double kSteps[] = {1.0, 1.02, 1.05, 1.1, 1.2, 1.4};
  constexpr double kShares[] = {0.35, 0.5, 0.65};
  constexpr double kIdealities[][2] = {{1, 1}, {1.5, 1.5}, {1.1, 1.8}, {1.8, 1.1}};
  constexpr std::size_t kPairs = 4;
  struct Pair {
    double misfit;
    double current[2];  // in parts, as in the box
  };
  std::vector<Pair> pairs;
  const TwoJunctionProblem& problem = prepared.problem;
  const double least[] = {LeastPhotocurrent(prepared, JunctionPhotocurrent(0)),
                          LeastPhotocurrent(prepared, JunctionPhotocurrent(1))};
  const Box box = TwoJunctionBox(prepared);
  for (const double one : kSteps) {
    for (const double two : kSteps) {
      if (problem.ordered && one > 1.0) continue;
      pairs.push_back({CurrentMisfit(prepared, {one * least[0], two * least[1]}), {one, two}});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.misfit < b.misfit; });
  if (!problem.ordered && pairs.size() > kPairs) pairs.resize(kPairs);
  std::vector<std::vector<double>> starts;
  for (const Pair& pair : pairs) {
    for (const double share : kShares) {
      for (const auto& ideality : kIdealities) {
        std::vector<double> x(box.lower.size(), 1.02);
        x[kCurrent1] = pair.current[0];
        x[kCurrent2] = pair.current[1];
        x[kShare] = share;
        x[kIdeality1] = ideality[0];
        x[kIdeality2] = ideality[1];
        x[kSeriesPart] = 0.01;
        x[kShunt1] = x[kShunt2] = 6;
        starts.push_back(std::move(x));
      }
    }
  }
  return starts;
}

}  // namespace lyrefit
