#include "lyrefit/devices/superposition.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lyrefit/devices/line.h"

namespace lyrefit {
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
                    "a barrier that the light changes", "collection that depends on voltage"};
    found.decides =
        "Voc at once after the light is switched on and after a minute tells warming (it falls) "
        "and soaking (it settles) apart; a second light tells collection apart";
    return found;
  }
  found.causes = {"collection that depends on voltage (photoshunt)",
                  "a barrier that the light changes", "light soaking",
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
