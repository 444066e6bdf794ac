#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/model/device_effects.h"
#include "lyrefit/model/reporting_units.h"
#include "studies/coverage.h"
#include "synthetic/draw.h"

// Shared parts of the rate tests of the catalogue for single curves and for sets of curves. They
// draw an effect and suitable noise, fit the effect, and count how often the interval contains its
// strength.
namespace lyrefit {

// Number of fits per row: LYREFIT_WALK_CURVES, or `usual`. All rows together then have enough fits
// to detect wrong intervals in the time of a CI run.
inline int WalkCurves(int usual) {
  const char* const asked = std::getenv("LYREFIT_WALK_CURVES");
  return asked != nullptr ? std::max(1, std::atoi(asked)) : usual;
}

// LYREFIT_WALK_ROWS selects rows by a part of their name, such as "transient, one sweep".
inline bool IsWalked(const std::string& name) {
  const char* const asked = std::getenv("LYREFIT_WALK_ROWS");
  return asked == nullptr || name.find(asked) != std::string::npos;
}

// A seed for each row that is independent of the other rows (FNV-1a).
inline std::uint64_t SeedOf(const std::string& effect, const std::string& data) {
  std::uint64_t seed = 14695981039346656037U;
  for (const char c : effect + "," + data) {
    seed = (seed ^ static_cast<unsigned char>(c)) * 1099511628211U;
  }
  return seed;
}

// An effect with all its true values, and its request for the fit. Parameters that are fixed by
// default get their true values, except the strength.
struct DrawnEffect {
  EffectUse truth;
  EffectUse asked;
  std::string symbol;  // symbol of the strength
  double strength = 0;
  bool whole = false;  // the strength is a whole number of substrings
};

// A random point between two probes of the effect, with the strength multiplied by 0.5 to 2, unless
// it is a whole number, and of random sign if both are possible. `device` must have this effect only.
inline DrawnEffect DrawEffect(const Device& device, const Effect& effect, RandomStream* random) {
  const std::vector<Probe> probes = effect.probes(device.effects->readings.traits);
  Probe p = probes[random->Index(static_cast<std::uint32_t>(probes.size()))];
  const Probe& other = probes[random->Index(static_cast<std::uint32_t>(probes.size()))];
  for (int k = 0; k < effect.size(); ++k) {
    const EffectParameter& info = effect.parameters[k];
    if (!info.searched && !info.fixed_by_default) p[k] = Between(random, p[k], other[k]);
  }
  const EffectParameter& strength = effect.parameters[0];
  if (strength.neutral == 0 && strength.whole == Whole::kNo) p[0] *= LogUniform(random, 0.5, 2);
  if (strength.lower == -strength.upper && random->Index(2) == 1) p[0] = -p[0];
  p[0] = std::min(p[0], 0.9 * strength.upper);
  const int first = device.size() - effect.size();
  std::vector<double> all(first, 0);
  all.insert(all.end(), p.begin(), p.end());
  const std::vector<double> values = Reported(device, all);
  DrawnEffect drawn{{&effect, {}},
                    {&effect, {}},
                    device.parameters[first].symbol,
                    values[first],
                    strength.whole != Whole::kNo};
  for (int k = 0; k < effect.size(); ++k) {
    const EffectParameter& info = effect.parameters[k];
    const std::pair<double, double> value(values[first + k], values[first + k]);
    drawn.truth.ranges[info.symbol] = value;
    if (info.fixed_by_default)
      drawn.asked.ranges[info.symbol] = k == 0 ? std::pair(info.lower, info.upper) : value;
  }
  return drawn;
}

// Noise in ampere for which the effect stands out by 10 to 50 standard deviations. `misfit`: root
// of the sum of squares that a fit of the diodes alone leaves. The noise is limited to 2e-5 to 5e-3
// of the short-circuit current, which a usable fit keeps to as well.
inline double NoiseFor(double misfit, double isc_A, RandomStream* random) {
  const double noise = misfit / LogUniform(random, 10, 50);
  return std::min(std::max(noise, 2e-5 * isc_A), 5e-3 * isc_A);
}

struct WalkRow {
  int curves = 0;
  int held = 0;
  int counted = 0;           // with an identifiable strength
  int not_identifiable = 0;  // according to the report
  int failed = 0;
  double milliseconds = 0;
};

// Adds a FitReport or a FamilyReport and its duration to the row. With LYREFIT_WALK_VERBOSE, prints
// a line for each fit.
template <class Report>
void CountFit(const Expected<Report>& report, std::chrono::duration<double, std::milli> took,
              const DrawnEffect& drawn, WalkRow* row) {
  row->milliseconds += took.count();
  ++row->curves;
  if (!report || !report->usable) {
    ++row->failed;
    ADD_FAILURE() << DescribeUse(drawn.truth) << ": "
                  << (report ? "not usable" : report.error().ToString());
    return;
  }
  const Estimate& e =
      *std::find_if(report->estimates.begin(), report->estimates.end(),
                    [&](const Estimate& one) { return one.info.symbol == drawn.symbol; });
  // A whole number has no interval.
  const bool held = drawn.whole ? std::fabs(e.refined - drawn.strength) < 1e-3
                                : e.low_95 <= drawn.strength && drawn.strength <= e.high_95;
  if (std::getenv("LYREFIT_WALK_VERBOSE") != nullptr) {
    std::printf("   %s is %.5g [%.5g, %.5g] %s%s, rmse %.4g A %s\n",
                DescribeUse(drawn.truth).c_str(), e.refined, e.low_95, e.high_95,
                ToText(e.interval).c_str(), held ? "" : " MISSED",
                report->rmse.refined.solved_current_A, e.reason.c_str());
  }
  row->not_identifiable += !e.identifiable;
  row->counted += e.identifiable;
  row->held += e.identifiable && held;
}

// Probability of at most `hits` successes in `trials`, each with probability p (binomial
// distribution).
inline double AtMost(int hits, int trials, double p) {
  double sum = 0;
  for (int k = 0; k <= hits; ++k) {
    sum +=
        std::exp(std::lgamma(trials + 1.0) - std::lgamma(k + 1.0) - std::lgamma(trials - k + 1.0) +
                 k * std::log(p) + (trials - k) * std::log1p(-p));
  }
  return sum;
}

inline void PrintRow(const std::string& effect, const std::string& data, const WalkRow& row) {
  const Share share = WilsonInterval(row.held, row.counted);
  std::printf("%-16s %-12s %6d %7.1f  %5.1f to %5.1f %6d %6d %8.1f\n", effect.c_str(), data.c_str(),
              row.curves, 100.0 * row.held / std::max(row.counted, 1), 100 * share.low_95,
              100 * share.high_95, row.not_identifiable, row.failed,
              row.milliseconds / std::max(row.curves, 1));
  std::fflush(stdout);
}

// Expects the counts of a row to be compatible with a coverage of 95 %.
inline void JudgeRow(const WalkRow& row) {
  constexpr double kVanishing = 1e-4;  // significance level of either test
  EXPECT_EQ(row.failed, 0);
  const int missed = row.counted - row.held;
  EXPECT_GT(AtMost(row.held, row.counted, 0.95), kVanishing) << "too narrow";
  EXPECT_GT(AtMost(missed, row.counted, 0.05), kVanishing) << "too wide";
}

// Prints the table, and tests each row and the sum of all rows, since the few fits of one row say
// little. `walk` makes the row of a place; a place has `effect`, Data() and Curves().
template <class Place, class Walk>
void WalkAll(const std::vector<Place>& places, const Walk& walk) {
  std::printf("%-16s %-12s %6s %7s  %-15s %6s %6s %8s\n", "effect", "data", "fits", "held %",
              "Wilson 95 %", "not id", "failed", "ms a fit");
  WalkRow all;
  for (const Place& place : places) {
    const std::string effect = place.effect->id;
    if (!IsWalked(effect + ", " + place.Data())) continue;
    SCOPED_TRACE(effect + ", " + place.Data());
    const WalkRow row = walk(place);
    PrintRow(effect, place.Data(), row);
    JudgeRow(row);
    EXPECT_EQ(row.curves, place.Curves());
    all.curves += row.curves;
    all.held += row.held;
    all.counted += row.counted;
    all.not_identifiable += row.not_identifiable;
    all.failed += row.failed;
    all.milliseconds += row.milliseconds;
  }
  PrintRow("all", "", all);
  JudgeRow(all);
}

}  // namespace lyrefit
