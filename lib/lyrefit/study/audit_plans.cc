#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/study/audit_reading.h"

namespace lyrefit {
namespace {

constexpr int kColdestTried_C = -20;
constexpr int kHottestTried_C = 120;
// Round temperatures in kelvin that publications use.
constexpr double kRoundKelvin[] = {298, 300};
// Wrong zero of the Celsius scale that publications use: 273 instead of 273.15 K.
constexpr double kShortZero_K = 273;

// Largest relative difference between a photocurrent and a curve's short-circuit current at which
// the curve is still considered.
constexpr double kLikeCurrent = 0.1;

struct CurrentUnit {
  double in_ampere;
  const char* name;
};
constexpr CurrentUnit kUnits[] = {{1, "A"}, {1e-3, "mA"}, {1e-6, "uA"}, {1e-9, "nA"}};

const char* UnitName(double in_ampere) {
  for (const CurrentUnit& unit : kUnits) {
    if (unit.in_ampere == in_ampere) return unit.name;
  }
  return "?";
}

// Alternatives of a plan along one kind of change. The functions below append to them.
using Alternatives = std::vector<ReadingPlan>;

void OtherCurves(const AuditSubject& subject, const ReadingPlan& plan, Alternatives* out) {
  for (std::size_t c = 0; c < subject.shelf->curves.size(); ++c) {
    const double isc = subject.shelf->curves[c].short_circuit_A;
    const double photocurrent_A = subject.row->parameters[kIph].value;
    if (static_cast<int>(c) == subject.stated.curve) continue;
    if (!(std::fabs(photocurrent_A - isc) <= kLikeCurrent * isc)) continue;
    ReadingPlan other = plan;
    other.curve = static_cast<int>(c);
    other.conditions = subject.shelf->curves[c].curve.conditions;
    out->push_back(other);
  }
}

void Resistances(const AuditSubject&, const ReadingPlan& plan, Alternatives* out) {
  if (plan.conditions.cells_in_series == 1) return;
  out->push_back(plan);
  out->back().resistances_per_cell = true;
}

void Ideality(const AuditSubject&, const ReadingPlan& plan, Alternatives* out) {
  if (plan.conditions.cells_in_series == 1) return;
  out->push_back(plan);
  out->back().ideality_of_module = true;
}

void SaturationCurrents(const AuditSubject& subject, const ReadingPlan& plan, Alternatives* out) {
  const AuditRow& row = *subject.row;
  std::vector<int> diodes;  // positions of diodes that carry current
  for (int d = 0; d < static_cast<int>(row.model); ++d) {
    if (row.parameters[SaturationCurrentIndex(d)].value > 0) diodes.push_back(d);
  }
  for (const CurrentUnit& unit : kUnits) {
    std::vector<int> changed;
    for (const int d : diodes) {
      if (row.parameters[SaturationCurrentIndex(d)].factor != unit.in_ampere) changed.push_back(d);
    }
    ReadingPlan other = plan;
    other.unit = unit.in_ampere;
    for (const int d : changed) {
      other.diode = d;
      out->push_back(other);
    }
    if (changed.size() < 2 || changed.size() < diodes.size()) continue;
    other.diode = ReadingPlan::kAllDiodes;
    out->push_back(other);
  }
}

void Temperatures(const AuditSubject&, const ReadingPlan& plan, Alternatives* out) {
  const double said_K = plan.conditions.cell_temperature_K;
  std::vector<double> kelvins;
  for (int celsius = kColdestTried_C; celsius <= kHottestTried_C; ++celsius) {
    kelvins.push_back(celsius + kZeroCelsius_K);
  }
  kelvins.insert(kelvins.end(), std::begin(kRoundKelvin), std::end(kRoundKelvin));
  kelvins.push_back(said_K - kZeroCelsius_K + kShortZero_K);
  std::vector<double> taken = {said_K};
  for (const double kelvin : kelvins) {
    const auto near = [&](double other) { return std::fabs(other - kelvin) < 1e-6; };
    if (std::any_of(taken.begin(), taken.end(), near)) continue;
    taken.push_back(kelvin);
    out->push_back(plan);
    out->back().conditions.cell_temperature_K = kelvin;
  }
}

void OtherObjective(const AuditSubject&, const ReadingPlan& plan, Alternatives* out) {
  out->push_back(plan);
  out->back().objective = plan.objective == Objective::kMeasuredCurrent
                              ? Objective::kSolvedCurrent
                              : Objective::kMeasuredCurrent;
  out->push_back(plan);
  out->back().objective = Objective::kSolvedCurrent;
  out->back().newton_step = true;
}

void OtherConstants(const AuditSubject&, const ReadingPlan& plan, Alternatives* out) {
  if (!plan.constants) return;
  for (const auto& row : EnumTable<ConstantSet>::kRows) {
    if (row.value == *plan.constants) continue;
    out->push_back(plan);
    out->back().constants = row.value;
  }
}

// Only tried without another change: it doubles the tolerance and so the chance of an accidental
// match.
void CutOffDigits(const AuditSubject&, const ReadingPlan& plan, Alternatives* out) {
  if (plan.changes > 0) return;
  out->push_back(plan);
  out->back().cut_off = true;
}

std::string TemperatureWords(double said_K, double kelvin) {
  const auto celsius = [](double k) { return std::round((k - kZeroCelsius_K) * 1e4) / 1e4; };
  const bool whole = std::fabs(kelvin - std::round(kelvin)) < 1e-6;
  return fmt::format("at {:g} C{} in place of {:g} C", celsius(kelvin),
                     whole ? fmt::format(" ({:g} K)", kelvin) : "", celsius(said_K));
}

std::string CurrentWords(const AuditSubject& subject, const ReadingPlan& plan) {
  const AuditRow& row = *subject.row;
  const Device device = MakeDevice(row.model, plan.conditions);
  std::string names, printed;
  for (int d = 0; d < static_cast<int>(row.model); ++d) {
    const int i = SaturationCurrentIndex(d);
    if (plan.diode != d && plan.diode != ReadingPlan::kAllDiodes) continue;
    if (row.parameters[i].value == 0) continue;
    const std::string unit = UnitName(row.parameters[i].factor);
    printed = names.empty() || printed == unit ? unit : "the units of their columns";
    names += (names.empty() ? "" : ", ") + device.parameters[i].symbol;
  }
  return fmt::format("{} in {} instead of {}", names, UnitName(plan.unit), printed);
}

}  // namespace

std::vector<ReadingPlan> ReadingPlans(const AuditSubject& subject, int most_changes) {
  std::vector<ReadingPlan> plans = {subject.stated};
  // Another curve has its own conditions, so it must come before the changes of conditions.
  for (const auto append : {OtherCurves, Resistances, Ideality, SaturationCurrents, Temperatures,
                            OtherObjective, OtherConstants, CutOffDigits}) {
    const std::size_t count = plans.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (plans[i].changes >= most_changes) continue;
      Alternatives alternatives;
      append(subject, plans[i], &alternatives);
      for (ReadingPlan& alternative : alternatives) {
        ++alternative.changes;
        plans.push_back(alternative);
      }
    }
  }
  std::stable_sort(plans.begin(), plans.end(), [](const ReadingPlan& a, const ReadingPlan& b) {
    return a.changes < b.changes;
  });
  return plans;
}

std::vector<std::string> ChangesOf(const AuditSubject& subject, const ReadingPlan& plan) {
  const ReadingPlan& stated = subject.stated;
  const AuditCurve& curve = subject.shelf->curves[plan.curve];
  const int cells = plan.conditions.cells_in_series;
  std::vector<std::string> changes;
  if (plan.curve != stated.curve) {
    changes.push_back(fmt::format("on the curve of {}", curve.curve.name));
  }
  if (plan.resistances_per_cell) {
    changes.push_back(fmt::format("with Rs and Rsh per cell (x {})", cells));
  }
  if (plan.ideality_of_module) {
    changes.push_back(fmt::format("with n of the whole module (/ {})", cells));
  }
  if (plan.diode != ReadingPlan::kNoDiode) {
    changes.push_back("with " + CurrentWords(subject, plan));
  }
  const double said_K = plan.curve == stated.curve ? stated.conditions.cell_temperature_K
                                                   : curve.curve.conditions.cell_temperature_K;
  if (plan.conditions.cell_temperature_K != said_K) {
    changes.push_back(TemperatureWords(said_K, plan.conditions.cell_temperature_K));
  }
  if (plan.newton_step) {
    changes.emplace_back("as the RMSE of one Newton step from the measured currents");
  } else if (plan.objective != stated.objective) {
    changes.push_back(fmt::format("as the {} RMSE", ToText(plan.objective)));
  }
  if (plan.cut_off) changes.emplace_back("with its printed digits cut off instead of rounded");
  if (plan.constants != stated.constants) {
    changes.push_back(fmt::format("with the constants {} in place of {}", ToText(*plan.constants),
                                  ToText(*stated.constants)));
  }
  return changes;
}

}  // namespace lyrefit
