#include "lyrefit/diagnose/breaks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

namespace lyrefit {
namespace {

constexpr int kReach = 3;  // neighbours on either side

// Distance of `off` at reading k from the median of its neighbours in the same stretch. 0 for fewer
// than two neighbours.
double OffNeighbours(const std::vector<Reading>& points, const std::vector<double>& off, int k) {
  std::array<double, 2 * kReach> around;
  auto end = around.begin();
  const int last = std::min(k + kReach, static_cast<int>(points.size()) - 1);
  for (int i = std::max(0, k - kReach); i <= last; ++i) {
    if (i != k && points[i].segment == points[k].segment) *end++ = off[i];
  }
  if (end - around.begin() < 2) return 0;
  const auto middle = around.begin() + (end - around.begin()) / 2;
  std::nth_element(around.begin(), middle, end);
  return std::fabs(off[k] - *middle);
}

// The most significant jump within readings `begin` to `end` - 1.
struct Jump {
  int begin = 0;
  int at = 0;  // first reading after the jump
  int end = 0;
  double square = 0;  // squared size in standard errors, with a straight line fitted too

  bool operator<(const Jump& other) const { return square < other.square; }
};

Jump FindJump(int begin, int end, const std::vector<double>& off,
              const std::vector<double>& sigma) {
  constexpr int kFewestBeside = 3;
  Jump jump{begin, begin, end, 0};
  const double n = end - begin, middle = begin + 0.5 * (n - 1);
  if (end - begin < 2 * kFewestBeside) return jump;
  double mean = 0, variance = 0, along = 0;
  for (int k = begin; k < end; ++k) {
    mean += off[k] / n;
    variance += sigma[k] * sigma[k] / n;
    along += (k - middle) * off[k];
  }
  const double moment = n * (n * n - 1) / 12;  // sum of (k - middle)^2
  const double slope = along / moment;
  double above = 0;  // sum of the residuals of the line from k on
  for (int k = end - 1; k - begin >= kFewestBeside; --k) {
    above += off[k] - mean - slope * (k - middle);
    const double after = end - k, before = n - after;
    if (after < kFewestBeside) continue;
    // Squared norm of the step function at k after projection off constant and line. Off the
    // constant it is after * before / n; its product with k - middle is after * before / 2.
    const double free = after * before / n - std::pow(0.5 * after * before, 2) / moment;
    const double square = above * above / (free * variance);
    if (!(square > jump.square)) continue;
    jump.square = square;
    jump.at = k;
  }
  return jump;
}

}  // namespace

void MarkSudden(const std::vector<Reading>& points, const std::vector<double>& off,
                const std::vector<double>& sigma, std::vector<char>* alone) {
  constexpr double kFar = 4.5, kUsual = 1000;  // limit in standard deviations for kUsual readings
  constexpr double kOfMiddle = 1.25;           // variance of a reading minus the median of six
  constexpr std::size_t kMost = 100;
  // A reading alone competes with averages, not with all readings. To keep the rate of chance
  // outliers independent of the number of readings, its squared limit grows by 4 ln(times).
  const double times = std::max(static_cast<double>(points.size()) / kUsual, 1.0);
  const double far = std::sqrt(kFar * kFar + 4 * kOfMiddle * kOfMiddle * std::log(times));
  std::vector<std::pair<double, int>> sudden;
  for (int k = 0; k < static_cast<int>(points.size()); ++k) {
    const double distance = OffNeighbours(points, off, k);
    if (distance > far * sigma[k]) sudden.emplace_back(distance / sigma[k], k);
  }
  if (sudden.size() > kMost) {
    std::nth_element(sudden.begin(), sudden.begin() + kMost, sudden.end(), std::greater<>());
    sudden.resize(kMost);
  }
  for (const auto& [distance, k] : sudden) (*alone)[k] = 1;
}

std::vector<int> CutAtJumps(std::vector<int> first, const std::vector<double>& off,
                            const std::vector<double>& sigma) {
  constexpr double kSure =
      6;  // standard errors; exceeded by chance in 0.2 % of sweeps of a million readings
  constexpr int kMost = 50;
  std::priority_queue<Jump> jumps;
  const auto look = [&](int begin, int end) {
    const Jump jump = FindJump(begin, end, off, sigma);
    if (jump.square > kSure * kSure) jumps.push(jump);
  };
  for (std::size_t g = 0; g + 1 < first.size(); ++g) look(first[g], first[g + 1]);
  for (int cuts = 0; cuts < kMost && !jumps.empty(); ++cuts) {
    const Jump jump = jumps.top();
    jumps.pop();
    first.push_back(jump.at);
    look(jump.begin, jump.at);
    look(jump.at, jump.end);
  }
  std::sort(first.begin(), first.end());
  return first;
}

}  // namespace lyrefit
