#include <algorithm>
#include <cmath>
#include <functional>

#include "lyrefit/diagnose/null_distribution.h"
#include "lyrefit/diagnose/score.h"

namespace lyrefit {

double Calibration::Corrected(double p) const {
  if (null_statistics.empty()) return p;
  // Beyond the upper fifth, the tail of -ln p is taken as exponential with the mean excess of that
  // fifth. Fraction and mean excess are raised by one standard error, to be conservative.
  constexpr double kPart = 0.2;
  const double x = -std::log(std::max(p, 1e-300));
  const std::size_t count = null_statistics.size();
  const std::size_t edge = count - static_cast<std::size_t>(kPart * static_cast<double>(count)) - 1;
  if (x > null_statistics[edge]) {
    double excess = 0;
    for (std::size_t k = edge + 1; k < count; ++k)
      excess += null_statistics[k] - null_statistics[edge];
    const double beyond = static_cast<double>(count - edge - 1);
    excess *= (1 + 1 / std::sqrt(beyond)) / beyond;
    const double part = kPart + std::sqrt(kPart * (1 - kPart) / static_cast<double>(count));
    return std::min(1.0, std::max(p, part * std::exp(-(x - null_statistics[edge]) / excess)));
  }
  const auto above =
      null_statistics.end() - std::lower_bound(null_statistics.begin(), null_statistics.end(), x);
  return std::max(p, static_cast<double>(above) / static_cast<double>(count));
}

double CorrectedP(const Score& score, double statistic, int degrees,
                  const Calibration& calibration) {
  return calibration.Corrected(
      std::min(1.0, score.catalogue * std::exp(0.5 * score.charge) * TailOf(statistic, degrees)));
}

double HopelessStatistic(const std::vector<Score>& scores) {
  constexpr double kPart = 0.1;
  double best = 0;
  for (const Score& score : scores) {
    if (score.testable) best = std::max(best, score.statistic);
  }
  return kPart * best;
}

double LeastOfTheBest(const std::vector<Score>& scores, int most) {
  std::vector<double> statistics;
  for (const Score& score : scores) {
    if (score.testable && score.effect->probes != nullptr) statistics.push_back(score.statistic);
  }
  const auto count = static_cast<std::size_t>(most);
  if (most == 0 || statistics.size() <= count) return 0;
  std::sort(statistics.begin(), statistics.end(), std::greater<double>());
  return statistics[count - 1];
}

}  // namespace lyrefit
