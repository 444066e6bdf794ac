#include "lyrefit/fit/prove_floor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/try.h"
#include "lyrefit/certify/certify.h"

namespace lyrefit {
namespace {

// Limits for the solved current. A proof that reaches the tolerance does so within this number of
// problems; the time of each is proportional to the number of readings.
constexpr double kSolvedTolerance = 1e-6;
constexpr std::int64_t kSolvedEffort = 1500;
constexpr std::size_t kMostReadings = 2000;

}  // namespace

Expected<FloorReport> ProveFloor(const IvCurve& curve, CertifyOptions ranges, double refined_A,
                                 const Observer& observer, bool* interrupted) {
  if (ranges.objective == Objective::kSolvedCurrent) {
    if (curve.size() > kMostReadings) {
      return Fail(
          fmt::format("of the solved current it takes too long for {} readings, more than {}",
                      curve.size(), kMostReadings));
    }
    ranges.tolerance = kSolvedTolerance;
    ranges.effort = kSolvedEffort;
  }
  TRY(const Certificate certificate, Certify(curve, ranges, observer));
  *interrupted = certificate.interrupted;
  FloorReport floor;
  floor.objective = ranges.objective;
  floor.rmse_A = std::min(certificate.floor.rmse_A, refined_A);
  floor.lower_bound_A = std::min(certificate.floor.lower_bound_A, floor.rmse_A);
  floor.n_lower = ranges.n_lower;
  floor.n_upper = ranges.n_upper;
  double largest_A = 0;
  for (const double current : curve.current_A) {
    largest_A = std::max(largest_A, std::fabs(current));
  }
  const double rounding_A = kCertifiedRounding * largest_A;
  const double room_A = refined_A - floor.rmse_A;
  floor.above = room_A > rounding_A ? room_A / floor.rmse_A : 0;
  const double open_A = floor.rmse_A - floor.lower_bound_A;
  floor.gap = open_A > rounding_A ? open_A / floor.rmse_A : 0;
  return floor;
}

}  // namespace lyrefit
