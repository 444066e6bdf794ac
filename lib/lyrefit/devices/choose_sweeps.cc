#include "lyrefit/devices/choose_sweeps.h"

#include <algorithm>
#include <cmath>

namespace lyrefit {
namespace {

constexpr double kSameLight = 0.02;

bool IsSameLight(const CellSweep& a, const CellSweep& b) {
  return std::fabs(a.irradiance_W_m2 - b.irradiance_W_m2) <=
         kSameLight * std::max(a.irradiance_W_m2, b.irradiance_W_m2);
}

}  // namespace

double ReachedIsc(const CellSweep& sweep) { return sweep.key.short_circuit_current_A; }

int BrightestOf(const std::vector<CellSweep>& sweeps) {
  int main = -1;
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    if (sweeps[i].kind != SweepKind::kLit || !(sweeps[i].key.max_power_W > 0)) continue;
    const bool brighter = main == -1 || (sweeps[i].irradiance_W_m2 > sweeps[main].irradiance_W_m2 &&
                                         !IsSameLight(sweeps[i], sweeps[main]));
    if (brighter) main = static_cast<int>(i);
  }
  return main;
}

int FindSweep(const CellReport& report, SweepKind kind, const CellSweep& like) {
  int found = -1;
  for (std::size_t i = 0; i < report.sweeps.size(); ++i) {
    if (report.sweeps[i].kind != kind) continue;
    if (report.sweeps[i].direction == like.direction) return static_cast<int>(i);
    if (found == -1) found = static_cast<int>(i);
  }
  return found;
}

std::vector<int> LightsOf(const CellReport& report, double (*isc_of)(const CellSweep&)) {
  std::vector<int> lights;
  for (std::size_t i = 0; report.main != -1 && i < report.sweeps.size(); ++i) {
    const CellSweep& sweep = report.sweeps[i];
    if (sweep.kind != SweepKind::kLit || sweep.direction != report.sweeps[report.main].direction) {
      continue;
    }
    const bool known = std::any_of(lights.begin(), lights.end(), [&](int other) {
      return IsSameLight(report.sweeps[other], sweep);
    });
    if (!known && isc_of(sweep) > 0) lights.push_back(static_cast<int>(i));
  }
  std::stable_sort(lights.begin(), lights.end(), [&](int a, int b) {
    return report.sweeps[a].irradiance_W_m2 > report.sweeps[b].irradiance_W_m2;
  });
  return lights;
}

std::vector<int> BrightestSweeps(const CellReport& report) {
  std::vector<int> brightest;
  for (std::size_t i = 0; report.main != -1 && i < report.sweeps.size(); ++i) {
    const CellSweep& sweep = report.sweeps[i];
    if (sweep.kind == SweepKind::kLit && IsSameLight(sweep, report.sweeps[report.main])) {
      brightest.push_back(static_cast<int>(i));
    }
  }
  return brightest;
}

}  // namespace lyrefit
