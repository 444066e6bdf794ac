#include "lyrefit/read/read_cell.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "lyrefit/base/try.h"
#include "lyrefit/curve/dark.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/read/cells.h"
#include "lyrefit/read/condition_options.h"
#include "lyrefit/read/read_curve_set.h"

namespace lyrefit {
namespace {

bool IsLitSweep(const IvCurve& curve) { return !curve.suns_voc_A && !IsDark(curve); }

// Short-circuit current at one sun of the brightest lit curve whose light is stated, or assumed
// (`known` false).
std::optional<double> CurrentAtOneSun(const CurveSet& cell, bool known) {
  constexpr double kSun_W_m2 = 1000;
  double brightest = 0;
  std::optional<double> isc;
  for (const IvCurve& curve : cell.curves) {
    const double light = curve.conditions.irradiance_W_m2;
    if (!IsLitSweep(curve) || curve.irradiance_known != known || !(light > brightest)) continue;
    const double found = FindKeyPoints(curve.voltage_V, curve.current_A).short_circuit_current_A;
    if (!(found > 0)) continue;
    brightest = light;
    isc = found * kSun_W_m2 / light;
  }
  return isc;
}

// The curves of the cell that `options.column` names, lit and dark, in a file of several cells.
// nullopt: it names none.
std::optional<CurveSet> NamedCell(const std::string& file, ReadOptions options) {
  const std::string wanted = std::move(options.column);
  options.column.clear();
  auto set = ReadMeasurement(file, options);
  if (!set || !HoldsSeveralCells(*set, UnstatedDark::kDark)) return std::nullopt;
  std::vector<CellCurves> cells = SplitIntoCells(*set);
  const auto found = std::find_if(cells.begin(), cells.end(),
                                  [&](const CellCurves& cell) { return cell.name == wanted; });
  if (found == cells.end()) return std::nullopt;
  set->name += " " + found->name;
  set->curves = std::move(found->curves);
  set->rejected.clear();
  return std::move(*set);
}

Expected<CurveSet> ReadFile(const std::string& file, const ReadOptions& options) {
  if (!options.column.empty()) {
    if (auto cell = NamedCell(file, options)) return std::move(*cell);
  }
  return ReadMeasurement(file, options);
}

void Append(CurveSet more, CurveSet* all) {
  all->name += (all->name.empty() ? "" : " + ") + more.name;
  all->source += (all->source.empty() ? "" : ", ") + more.source;
  for (IvCurve& curve : more.curves) all->curves.push_back(std::move(curve));
  for (RejectedCurve& bad : more.rejected) all->rejected.push_back(std::move(bad));
  for (Assumption& one : more.assumptions) all->assumptions.push_back(std::move(one));
}

// Gives the lit curves without a stated light this one. Returns their number.
Expected<int> GiveLight(double irradiance_W_m2, CurveSet* cell) {
  int given = 0;
  ConditionOptions light;
  light.irradiance_W_m2 = irradiance_W_m2;
  for (IvCurve& curve : cell->curves) {
    if (!IsLitSweep(curve) || curve.irradiance_known) continue;
    TRY(ApplyConditions(light, &curve));
    ++given;
  }
  return given;
}

// Densities without an area become currents of the area that another curve states. Error: they stand
// beside currents of an unknown area.
Expected<void> SettleAreas(std::optional<double> area_cm2, CurveSet* cell) {
  const IvCurve* absolute = nullptr;
  for (const IvCurve& curve : cell->curves) {
    if (!area_cm2) area_cm2 = curve.notes.area_cm2;
    if (!curve.per_area && !curve.suns_voc_A) absolute = &curve;
  }
  for (IvCurve& curve : cell->curves) {
    if (!curve.per_area) continue;
    if (!area_cm2 && absolute != nullptr) {
      return Fail("the currents of " + absolute->source +
                      " are no densities, as those here are: give the area with --area-cm2",
                  curve.source);
    }
    if (!area_cm2) continue;
    for (double& current : curve.current_A) current *= *area_cm2;
    for (double& sigma : curve.sigma_A) sigma *= *area_cm2;
    if (curve.suns_voc_A) *curve.suns_voc_A *= *area_cm2;
    curve.per_area = false;
  }
  return {};
}

}  // namespace

Expected<CurveSet> ReadCell(const std::vector<std::string>& files, const ReadOptions& given,
                            std::optional<double> unstated_W_m2) {
  ReadOptions options = given;
  options.per_area = true;
  CurveSet all;
  std::vector<std::string> later;
  for (const std::string& file : files) {
    auto set = ReadFile(file, options);
    if (set) {
      Append(std::move(*set), &all);
    } else {
      later.push_back(file);
    }
  }
  TRY(SettleAreas(options.area_cm2, &all));
  int lit = 0;
  if (unstated_W_m2) {
    TRY(const int curves, GiveLight(*unstated_W_m2, &all));
    lit = curves;
  }
  ReadOptions with_isc = options;
  if (!with_isc.isc_A) with_isc.isc_A = CurrentAtOneSun(all, true);
  const bool assumed = !with_isc.isc_A;
  if (assumed) with_isc.isc_A = CurrentAtOneSun(all, false);
  for (const std::string& file : later) {
    TRY(CurveSet set, ReadFile(file, with_isc));
    if (assumed && with_isc.isc_A) {
      set.assumptions.emplace_back(
          "no light is stated: the lit curve is taken as under 1000 W/m2, one sun of the Suns-Voc "
          "trace; give the true light with --irradiance-Wm2");
    }
    Append(std::move(set), &all);
  }
  if (unstated_W_m2 && lit == 0 && all.curves.size() > 1) {
    return Fail("irradiance-Wm2: every lit curve states its own light", all.source);
  }
  const bool all_dark = std::all_of(all.curves.begin(), all.curves.end(), IsDark);
  if (all_dark && !all.rejected.empty()) return tl::unexpected(all.rejected.front().error);
  for (IvCurve& curve : all.curves) {
    if (options.area_cm2) curve.notes.area_cm2 = options.area_cm2;
  }
  return all;
}

}  // namespace lyrefit
