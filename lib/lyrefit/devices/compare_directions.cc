#include "lyrefit/devices/cell_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/numbers.h"
#include "lyrefit/devices/describe_sweep.h"
#include "lyrefit/devices/line.h"

namespace lyrefit {
namespace {

constexpr int kSteps = 1000;

// Causes of hysteresis.
constexpr char kIons[] = "ions or traps";
constexpr char kTiming[] = "timing of the meter";
constexpr char kCharge[] = "a capacitance";
constexpr char kDrift[] = "drift of the lamp or the temperature";

double IndexAt(const Line& forward, const Line& reverse, double voltage) {
  return (reverse.At(voltage) - forward.At(voltage)) / reverse.At(voltage);
}

// Causes of a gap that one pair leaves: see the table in doi:10.1039/C4EE03664F and
// doi:10.1021/jz500113x. A capacitance takes current on the way up only, so that reverse gives more
// everywhere; late readings shift the curve sideways, which does nothing where it is flat.
std::vector<std::string> CausesOf(const DirectionPair& pair) {
  constexpr double kSeen = 0.01;
  std::vector<std::string> causes = {kIons};
  if (std::fabs(pair.isc_difference) < kSeen) causes.emplace_back(kTiming);
  if (pair.sense == HysteresisSense::kNormal && pair.isc_difference > -kSeen) {
    causes.emplace_back(kCharge);
  }
  causes.emplace_back(kDrift);
  return causes;
}

// Last voltage of the comparison: the larger of the known Voc, or the end of a sweep below it.
double EndOf(const Line& forward, const Line& reverse, double forward_voc, double reverse_voc) {
  const double voc = std::fmax(forward_voc, reverse_voc);
  return std::fmin(voc, std::min(forward.x.back(), reverse.x.back()));
}

// First voltage of the comparison; NaN if one of the sweeps begins too far above 0 V.
double BeginOf(const Line& forward, const Line& reverse, double end) {
  constexpr double kLatest = 0.05;
  const double begin = std::max({0.0, forward.x.front(), reverse.x.front()});
  return begin <= kLatest * end ? begin : kUnknown;
}

// Whether two numbers are equal within 5 % or `reach`, or one is not known.
bool MayBeEqual(double a, double b, double reach) {
  constexpr double kSame = 0.05;
  return !(std::fabs(a - b) > std::max(kSame * std::max(a, b), reach));
}

constexpr double kSweepPair_h = 0.02;  // between the directions of a pair

bool AreOpposite(const CellSweep& a, const CellSweep& b) {
  constexpr double kSameLight = 0.02;
  const double light = std::max(a.irradiance_W_m2, b.irradiance_W_m2);
  return a.kind == SweepKind::kLit && b.kind == SweepKind::kLit && a.direction != b.direction &&
         std::fabs(a.irradiance_W_m2 - b.irradiance_W_m2) <= kSameLight * light &&
         MayBeEqual(a.scan_rate_V_s, b.scan_rate_V_s, 0) &&
         MayBeEqual(a.elapsed_h, b.elapsed_h, kSweepPair_h);
}

// Standard error of the index by power: each maximum is that of a parabola through three readings.
double NoiseOfIndex(const CellSweep& a, const CellSweep& b) {
  const double imp = b.key.max_power_current_A;
  return std::hypot(a.noise_A, b.noise_A) / std::sqrt(3.0) / imp;
}

// Gap without its noise, at least the noise.
double OwnGap(const DirectionPair& pair) {
  const double squares = std::pow(pair.gap_percent, 2) - std::pow(pair.noise_percent, 2);
  return std::sqrt(std::max(squares, std::pow(std::max(pair.noise_percent, 1e-6), 2)));
}

struct RateFinding {
  std::string what;
  std::vector<std::string> causes;
};

// Least exponent of the gap over the rate in a step that begins with a gap above `least`.
double LeastStep(const std::vector<double>& rate, const std::vector<double>& gap, double least) {
  double smallest = kInfinity;
  for (std::size_t k = 1; k < gap.size(); ++k) {
    if (!(gap[k - 1] > least)) continue;
    smallest = std::min(smallest, std::log(gap[k] / gap[k - 1]) / std::log(rate[k] / rate[k - 1]));
  }
  return smallest;
}

// `rate`, `gap`: by rising rate. The exponent is that of the gap over the rate from end to end.
RateFinding JudgeRates(const std::vector<double>& rate, const std::vector<double>& gap,
                       double noise, bool sense_changes) {
  constexpr double kPeak = 1.5, kProportional = 0.7, kConstant = 0.3, kSaturates = 0.5, kNoises = 3;
  const auto at = std::max_element(gap.begin(), gap.end());
  const double ends = std::max(gap.front(), gap.back());
  const double exponent = std::log(gap.back() / gap.front()) / std::log(rate.back() / rate.front());
  if (*at > kPeak * ends) {
    return {fmt::format("the gap has a maximum at {:.3g} V/s, as ions or slow traps make it; a "
                        "capacitance and late readings only grow with the rate",
                        rate[at - gap.begin()]),
            {kIons}};
  }
  if (sense_changes) return {"the index changes its sign with the rate, as ions make it", {kIons}};
  if (exponent > kProportional && LeastStep(rate, gap, kNoises * noise) > kSaturates) {
    return {
        "the gap grows with the rate: late readings, a capacitance, or ions whose maximum lies "
        "above the fastest rate",
        {kIons, kTiming, kCharge}};
  }
  if (exponent > kConstant) {
    return {
        "the gap grows less than the rate: ions or traps, or the charge of the junction that "
        "saturates; no late readings",
        {kIons, kCharge}};
  }
  if (exponent > -kConstant) {
    return {
        "the gap hardly changes with the rate: ions or traps of many time constants; no "
        "capacitance, no late readings, no drift",
        {kIons}};
  }
  return {
      "the gap falls as the rate rises: ions or traps whose maximum lies below the slowest rate, "
      "or a drift of lamp or temperature",
      {kIons, kDrift}};
}

}  // namespace

DirectionPair CompareDirections(const CellSweep& forward, const CellSweep& reverse,
                                double least_percent) {
  DirectionPair pair;
  const KeyPoints &f = forward.key, &r = reverse.key;
  const Line up = LineOf(forward), down = LineOf(reverse);
  const double isc = r.short_circuit_current_A, voc = r.open_circuit_voltage_V;
  pair.index_power = HysteresisIndex(f, r);
  const double end = EndOf(up, down, f.open_circuit_voltage_V, voc);
  const double begin = BeginOf(up, down, end);
  pair.index_area = 1 - up.Area(begin, f.open_circuit_voltage_V) / down.Area(begin, voc);
  pair.index_at_80 = IndexAt(up, down, 0.8 * voc);
  pair.index_at_50 = IndexAt(up, down, 0.5 * voc);
  pair.voc_difference_V = voc - f.open_circuit_voltage_V;
  pair.isc_difference = (isc - f.short_circuit_current_A) / isc;
  pair.ff_difference = r.fill_factor - f.fill_factor;
  double squares = 0, highest = 0, lowest = 0;
  for (int k = 0; k <= kSteps; ++k) {
    const double v = std::min(begin + (end - begin) * k / kSteps, end);
    const double gap = (down.At(v) - up.At(v)) / isc;
    squares += gap * gap;
    highest = std::max(highest, gap);
    lowest = std::min(lowest, gap);
  }
  pair.gap_percent = 100 * std::sqrt(squares / (kSteps + 1));
  pair.index_noise = NoiseOfIndex(forward, reverse);
  pair.noise_percent = 100 * std::hypot(forward.noise_A, reverse.noise_A) / isc;
  const bool shows = pair.gap_percent >= least_percent && pair.gap_percent > 2 * pair.noise_percent;
  if (shows) {
    constexpr double kErrors = 2;
    pair.sense = std::fabs(pair.index_power) < kErrors * pair.index_noise
                     ? HysteresisSense::kNeither
                 : pair.index_power >= 0 ? HysteresisSense::kNormal
                                         : HysteresisSense::kInverted;
    pair.causes = CausesOf(pair);
  }
  const double seen = std::max(3 * pair.noise_percent, least_percent) / 100;
  pair.cross = shows && highest > seen && -lowest > seen;
  return pair;
}

std::vector<DirectionPair> FindPairs(const std::vector<CellSweep>& sweeps, double least_percent) {
  std::vector<DirectionPair> pairs;
  std::vector<bool> paired(sweeps.size(), false);
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    for (std::size_t j = i + 1; j < sweeps.size() && !paired[i]; ++j) {
      if (paired[j] || !AreOpposite(sweeps[i], sweeps[j])) continue;
      paired[i] = paired[j] = true;
      const bool first = sweeps[i].direction == ScanDirection::kForward;
      const std::size_t forward = first ? i : j, reverse = first ? j : i;
      DirectionPair pair = CompareDirections(sweeps[forward], sweeps[reverse], least_percent);
      pair.forward = static_cast<int>(forward);
      pair.reverse = static_cast<int>(reverse);
      pairs.push_back(pair);
    }
  }
  return pairs;
}

std::optional<HysteresisOverRate> CompareRates(const std::vector<CellSweep>& sweeps,
                                               std::vector<DirectionPair>* pairs) {
  constexpr double kOther = 1.2;
  HysteresisOverRate over;
  const auto rate_of = [&](int pair) { return sweeps[(*pairs)[pair].forward].scan_rate_V_s; };
  for (int i = 0; i < static_cast<int>(pairs->size()); ++i) {
    const CellSweep& first = sweeps[pairs->front().forward];
    const CellSweep& own = sweeps[(*pairs)[i].forward];
    if (own.scan_rate_V_s > 0 && MayBeEqual(own.elapsed_h, first.elapsed_h, kSweepPair_h)) {
      over.pairs.push_back(i);
    }
  }
  std::stable_sort(over.pairs.begin(), over.pairs.end(),
                   [&](int a, int b) { return rate_of(a) < rate_of(b); });
  if (over.pairs.empty() || !(rate_of(over.pairs.back()) > kOther * rate_of(over.pairs.front()))) {
    return std::nullopt;
  }
  std::vector<double> rates, gaps;
  bool shows = false, normal = false, inverted = false;
  double noise = 0;
  const DirectionPair* largest = &(*pairs)[over.pairs.front()];
  for (const int i : over.pairs) {
    const DirectionPair& pair = (*pairs)[i];
    rates.push_back(rate_of(i));
    gaps.push_back(OwnGap(pair));
    noise = std::max(noise, pair.noise_percent);
    if (pair.gap_percent > largest->gap_percent) largest = &pair;
    shows = shows || pair.sense != HysteresisSense::kNone;
    normal = normal || pair.sense == HysteresisSense::kNormal;
    inverted = inverted || pair.sense == HysteresisSense::kInverted;
  }
  if (!shows) return over;
  RateFinding found = JudgeRates(rates, gaps, noise, normal && inverted);
  over.finding = std::move(found.what);
  for (const std::string& cause : found.causes) {
    const auto& own = largest->causes;
    if (std::find(own.begin(), own.end(), cause) != own.end()) over.causes.push_back(cause);
  }
  for (const int i : over.pairs) {
    if (!(*pairs)[i].causes.empty()) (*pairs)[i].causes = over.causes;
  }
  return over;
}

namespace {

// ComparedReadings of the lit curve beside the dark current at their junction voltage.
struct ComparedReadings {
  std::vector<double> voltage;  // of the junction
  std::vector<double> lost;     // Isc - I_light
  std::vector<double> dark;     // forward current
};

ComparedReadings Compare(const CellSweep& lit, const CellSweep& dark, const SeriesOhms& series) {
  Line line;
  for (std::size_t k = 0; k < dark.voltage_V.size(); ++k) {
    const double junction = dark.voltage_V[k] + dark.current_A[k] * series.dark;
    if (!line.x.empty() && junction <= line.x.back()) continue;
    line.x.push_back(junction);
    line.y.push_back(-dark.current_A[k]);
  }
  ComparedReadings found;
  const double isc = lit.key.short_circuit_current_A, voc = lit.key.open_circuit_voltage_V;
  for (std::size_t k = 0; k < lit.voltage_V.size(); ++k) {
    if (lit.voltage_V[k] < 0 || lit.voltage_V[k] > voc) continue;
    const double junction = lit.voltage_V[k] + lit.current_A[k] * series.lit;
    const double current = line.LogAt(junction);
    if (!std::isfinite(current)) continue;
    found.voltage.push_back(junction);
    found.lost.push_back(isc - lit.current_A[k]);
    found.dark.push_back(current);
  }
  return found;
}

double RmsWith(const ComparedReadings& readings, double scale) {
  double squares = 0;
  for (std::size_t k = 0; k < readings.lost.size(); ++k) {
    squares += std::pow(readings.lost[k] - scale * readings.dark[k], 2);
  }
  return std::sqrt(squares / static_cast<double>(readings.lost.size()));
}

// Factor of the dark current by least squares.
double BestScale(const ComparedReadings& readings) {
  double both = 0, own = 0;
  for (std::size_t k = 0; k < readings.lost.size(); ++k) {
    both += readings.lost[k] * readings.dark[k];
    own += readings.dark[k] * readings.dark[k];
  }
  return own > 0 ? both / own : kUnknown;
}

// The comparison with the causes that these two curves leave, the likelier first, and with the
// measurement that decides.
Superposition WithCauses(Superposition found) {
  constexpr double kExplained = 0.1;  // of the rms, by another dark current
  if (found.scaled_rms_percent < kExplained * found.rms_percent) {
    found.causes = {found.dark_scale > 1 ? "the lit cell was warmer than the dark one"
                                         : "the dark cell was warmer than the lit one",
                    "light soaking: the light changed the recombination",
                    "the light drifted during the sweep",
                    "another resistance of the contacts",
                    "a barrier that the light changes",
                    "collection that depends on voltage"};
    found.decides =
        "Voc at once after the light is switched on and after a minute tells warming (it falls) "
        "and soaking (it settles) apart; a second light tells collection apart";
    return found;
  }
  found.causes = {"collection that depends on voltage (photoshunt)",
                  "a barrier that the light changes",
                  "light soaking",
                  "the light drifted during the sweep",
                  "another resistance of the contacts",
                  "the lit cell was warmer than the dark one"};
  found.decides =
      "a second light: the part that grows with the light is collection; a dark curve right after "
      "the lit one shows soaking";
  return found;
}

}  // namespace

Superposition TestSuperposition(const CellSweep& lit, const CellSweep& dark,
                                const SeriesOhms& series, double least_percent) {
  constexpr double kNoises = 3;
  constexpr std::size_t kFewest = 5;
  Superposition found;
  found.lit_rs_ohm = series.lit;
  found.dark_rs_ohm = series.dark;
  const double isc = lit.key.short_circuit_current_A, voc = lit.key.open_circuit_voltage_V;
  const ComparedReadings readings = Compare(lit, dark, series);
  if (readings.lost.size() < kFewest || readings.voltage.back() < 0.9 * voc) return found;
  double largest = 0;
  for (std::size_t k = 0; k < readings.lost.size(); ++k) {
    const double off = readings.dark[k] - readings.lost[k];  // J_light - (Jsc - J_dark)
    if (std::fabs(off) < std::fabs(largest)) continue;
    largest = off;
    found.largest_at_V = readings.voltage[k];
  }
  found.to_V = readings.voltage.back();
  found.largest_percent = 100 * largest / isc;
  found.rms_percent = 100 * RmsWith(readings, 1) / isc;
  found.noise_percent = 100 * std::hypot(lit.noise_A, dark.noise_A) / isc;
  found.dark_scale = BestScale(readings);
  found.scaled_rms_percent = 100 * RmsWith(readings, found.dark_scale) / isc;
  Line over;  // voltage of the junction over the dark current's logarithm
  for (std::size_t k = 0; k < dark.voltage_V.size(); ++k) {
    const double current = -dark.current_A[k];
    if (current <= 0 || (!over.x.empty() && std::log(current) <= over.x.back())) continue;
    over.x.push_back(std::log(current));
    over.y.push_back(dark.voltage_V[k] + dark.current_A[k] * series.dark);
  }
  found.voc_shift_V = voc - over.At(std::log(isc));
  found.departs =
      found.rms_percent >= least_percent && found.rms_percent > kNoises * found.noise_percent;
  return found.departs ? WithCauses(std::move(found)) : found;
}

}  // namespace lyrefit
