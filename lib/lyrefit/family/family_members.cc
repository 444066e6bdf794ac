#include "lyrefit/family/family_members.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "lyrefit/base/median.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/curve/dark.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/model/translation.h"

namespace lyrefit {
namespace {

struct Place {
  double irradiance;   // ln of the ratio to the reference
  double temperature;  // steps of 25 K
};

Place PlaceOf(const Conditions& at) {
  return {std::log(std::max(at.irradiance_W_m2, 1.0) / kReferenceIrradiance_W_m2),
          (at.cell_temperature_K - kReferenceTemperature_K) / 25};
}

double Distance(const Place& a, const Place& b) {
  return std::hypot(a.irradiance - b.irradiance, a.temperature - b.temperature);
}

}  // namespace

std::vector<int> CurveSubset(const std::vector<Conditions>& conditions,
                             const std::vector<int>& among, int count) {
  if (static_cast<int>(among.size()) <= count) return among;
  if (count < 1) return {};
  std::vector<Place> places;
  places.reserve(among.size());
  for (const int c : among) places.push_back(PlaceOf(conditions[c]));
  std::vector<double> nearest(among.size(), std::numeric_limits<double>::max());
  std::vector<int> taken;
  std::size_t next = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (Distance(places[i], {0, 0}) < Distance(places[next], {0, 0})) next = i;
  }
  while (static_cast<int>(taken.size()) < count) {
    taken.push_back(among[next]);
    nearest[next] = -1;
    std::size_t farthest = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (nearest[i] >= 0) nearest[i] = std::min(nearest[i], Distance(places[i], places[next]));
      if (nearest[i] > nearest[farthest]) farthest = i;
    }
    next = farthest;
  }
  std::sort(taken.begin(), taken.end());
  return taken;
}

namespace {

constexpr double kSameLight = 0.02;  // relative difference of Isc at equal irradiance

double Isc(const IvCurve& curve) {
  const double isc = FindKeyPoints(curve.voltage_V, curve.current_A).short_circuit_current_A;
  if (std::isfinite(isc)) return isc;
  return *std::max_element(curve.current_A.begin(), curve.current_A.end());
}

void LeaveOut(std::string reason, FamilyMember* member) {
  member->role = CurveRole::kLeftOut;
  member->reason = std::move(reason);
}

int UsualCells(const CurveSet& set) {
  std::vector<double> cells;
  for (const IvCurve& curve : set.curves) cells.push_back(curve.conditions.cells_in_series);
  return cells.empty() ? 0 : static_cast<int>(UpperMedian(cells));
}

// Leaves out the curves that cannot be fitted. `refusal` receives the first error of implausible
// readings.
void LeaveOutMisfits(const CurveSet& set, const FamilyOptions& options,
                     const std::set<std::string>& unwanted, std::vector<FamilyMember>* members,
                     std::optional<Error>* refusal) {
  const int cells = UsualCells(set);
  for (std::size_t c = 0; c < set.curves.size(); ++c) {
    const IvCurve& curve = set.curves[c];
    FamilyMember& member = (*members)[c];
    const double irradiance = curve.conditions.irradiance_W_m2;
    const double isc = member.short_circuit_current_A;
    if (unwanted.count(curve.name) > 0) {
      LeaveOut("left out as asked", &member);
    } else if (curve.conditions.cells_in_series != cells) {
      LeaveOut(fmt::format("has {} cells in series, the others {}: another device",
                           curve.conditions.cells_in_series, cells),
               &member);
    } else if (const auto judged = JudgeReadings(curve); !judged) {
      LeaveOut(judged.error().message, &member);
      if (!refusal->has_value()) *refusal = judged.error();
    } else if (curve.suns_voc_A) {
      LeaveOut(
          "a Suns-Voc trace: series resistance is not in it, and each reading has a light of "
          "its own",
          &member);
    } else if (member.irradiance_known && !(irradiance > 0)) {
      const bool lit = !IsDark(curve);
      if (!lit && !options.with.empty()) {  // models with effects include dark curves
        member.joint.irradiance_W_m2 = 0;
        continue;
      }
      LeaveOut(lit ? fmt::format("its irradiance is stated as 0 W/m2 but it delivers {:.4g} A: "
                                 "the statement is wrong, or the curve is another's",
                                 isc)
                   : "a dark curve: no law of irradiance places it",
               &member);
    } else if (!(isc > 0) || IsDark(curve)) {
      LeaveOut(
          fmt::format("delivers no current at 0 V ({:.4g} A) under {:.4g} W/m2", isc, irradiance),
          &member);
    }
  }
}

// If no curve states an irradiance, the brightest is taken as 1000 W/m2.
void GuessIrradiances(std::vector<FamilyMember>* members, std::vector<std::string>* notes) {
  std::vector<double> per_sun;
  double brightest = 0;
  bool any_unknown = false;
  for (const FamilyMember& member : *members) {
    if (member.role == CurveRole::kLeftOut) continue;
    brightest = std::max(brightest, member.short_circuit_current_A);
    any_unknown = any_unknown || !member.irradiance_known;
    if (!member.irradiance_known || member.IsDark()) continue;
    per_sun.push_back(member.short_circuit_current_A / member.joint.irradiance_W_m2 *
                      kReferenceIrradiance_W_m2);
  }
  if (!any_unknown) return;
  const bool none = per_sun.empty();
  const double one_sun = none ? brightest : UpperMedian(per_sun);
  if (none) {
    notes->push_back(
        "no curve states its irradiance: the brightest counts as 1000 W/m2, and photocurrent, "
        "coefficients and shunt are relative to that");
  }
  for (FamilyMember& member : *members) {
    if (member.role == CurveRole::kLeftOut || member.irradiance_known) continue;
    const double ratio = member.short_circuit_current_A / one_sun;
    const bool same = none && ratio > 1 - kSameLight;
    member.joint.irradiance_W_m2 = kReferenceIrradiance_W_m2 * (same ? 1 : ratio);
    if (!same) member.joint.irradiance_sd = kInfinity;
  }
}

Expected<void> GuessTemperatures(std::vector<FamilyMember>* members,
                                 std::vector<std::string>* notes) {
  std::vector<double> known;
  bool any_unknown = false;
  for (const FamilyMember& member : *members) {
    if (member.role == CurveRole::kLeftOut) continue;
    any_unknown = any_unknown || !member.temperature_known;
    if (member.temperature_known) known.push_back(member.joint.temperature_K);
  }
  if (!any_unknown) return {};
  if (known.empty()) {
    notes->push_back(
        "no curve states its temperature: 25 C counts for all, and n and the saturation current "
        "absorb the difference");
    for (FamilyMember& member : *members) member.joint.temperature_K = kReferenceTemperature_K;
    return {};
  }
  for (FamilyMember& member : *members) {
    if (member.role == CurveRole::kLeftOut || member.temperature_known) continue;
    member.joint.temperature_K = UpperMedian(known);
    member.joint.temperature_sd_K = kInfinity;
  }
  return {};
}

// Sets the weights from the standard deviations of single points. Returns false if some curve has
// none.
bool UseSigmas(const CurveSet& set, std::vector<FamilyMember>* members) {
  std::vector<double> sigmas;
  for (const IvCurve& curve : set.curves) {
    if (curve.sigma_A.empty()) return false;
    sigmas.insert(sigmas.end(), curve.sigma_A.begin(), curve.sigma_A.end());
  }
  const double usual = UpperMedian(sigmas);
  for (std::size_t c = 0; c < set.curves.size(); ++c) {
    for (std::size_t k = 0; k < set.curves[c].size(); ++k) {
      const double ratio = usual / set.curves[c].sigma_A[k];
      (*members)[c].joint.weight[k] = ratio * ratio;
    }
  }
  return true;
}

// Whether the residuals are those of key points.
Expected<bool> TakesKeyPoints(const CurveSet& set, const FamilyOptions& options,
                              const std::vector<FamilyMember>& members) {
  if (options.residuals == FamilyResiduals::kCurrents) return false;
  if (!options.with.empty()) {
    if (options.residuals == FamilyResiduals::kAuto) return false;
    return Fail("residuals: with effects beside the diodes: expected currents, not key-points");
  }
  if (options.residuals == FamilyResiduals::kKeyPoints) return true;
  for (std::size_t c = 0; c < set.curves.size(); ++c) {
    if (members[c].role != CurveRole::kLeftOut && !set.curves[c].key_points) return false;
  }
  return true;
}

// Key points of a curve, stated or found on its sweep, with their errors. At low light those of Isc
// and Pmp are larger parts: a law is an approximation, and a watt counts the same at every light.
// `part`: Isc as a part of that at the reference.
KeyPointResiduals ResidualsOf(const IvCurve& curve, const FamilyOptions& options, double part) {
  const KeyPointErrors& errors = options.key_point_errors;
  const double power = options.weights == FamilyWeights::kEqual ? 1
                       : options.weights == FamilyWeights::kIsc ? 0
                                                                : 0.5;
  const double dim = std::pow(part, -power);
  const KeyPoints points =
      curve.key_points.value_or(FindKeyPoints(curve.voltage_V, curve.current_A));
  return {{points.short_circuit_current_A, points.open_circuit_voltage_V,
           points.max_power_voltage_V, points.max_power_W},
          {dim * errors.short_circuit_current, errors.open_circuit_voltage,
           errors.max_power_voltage, dim * errors.max_power}};
}

void AddSensorUnknowns(const FamilyOptions& options, std::vector<FamilyMember>* members) {
  for (FamilyMember& member : *members) {
    if (member.irradiance_known) member.joint.irradiance_sd = options.irradiance_accuracy;
    if (member.temperature_known) member.joint.temperature_sd_K = options.temperature_accuracy_K;
  }
}

// The ids to leave out; those of the set may hold commas, at which the option's text was split.
// Errors: two curves of one id, an id that the set lacks.
Expected<std::set<std::string>> IdsToLeaveOut(const CurveSet& set, const FamilyOptions& options) {
  std::set<std::string> ids, unwanted;
  for (const IvCurve& curve : set.curves) {
    if (ids.insert(curve.name).second) continue;
    return Fail(
        fmt::format("two curves are named {}: every curve needs an id of its own", curve.name),
        set.source);
  }
  const std::vector<std::string>& parts = options.leave_out;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    std::string id = parts[k];
    std::size_t last = k;
    while (ids.count(id) == 0 && last + 1 < parts.size()) id += "," + parts[++last];
    if (ids.count(id) == 0)
      return Fail(fmt::format("leave-out: the set has no curve {}", parts[k]));
    unwanted.insert(id);
    k = last;
  }
  return unwanted;
}

}  // namespace

std::vector<Conditions> ConditionsOf(const FamilyMembers& members) {
  std::vector<Conditions> conditions(members.members.size());
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    conditions[c].irradiance_W_m2 = members.members[c].joint.irradiance_W_m2;
    conditions[c].cell_temperature_K = members.members[c].joint.temperature_K;
  }
  return conditions;
}

void WeighMembers(FamilyWeights weights, FamilyMembers* members) {
  for (FamilyMember& member : members->members) {
    double weight = 1;
    if (weights == FamilyWeights::kIsc) {
      const double own = member.IsDark() ? LargestMagnitude(member.joint.current_A)
                                         : member.short_circuit_current_A;
      const double ratio = members->reference_current_A / own;
      weight = ratio * ratio;
    }
    member.joint.weight.assign(member.joint.voltage_V.size(), weight);
  }
}

Expected<FamilyMembers> MakeFamilyMembers(const CurveSet& set, const FamilyOptions& options) {
  TRY(const std::set<std::string> unwanted, IdsToLeaveOut(set, options));
  FamilyMembers result;
  for (const IvCurve& curve : set.curves) {
    if (auto valid = Validate(curve); !valid) {
      return Fail(fmt::format("curve {}: {}", curve.name, valid.error().message), curve.source);
    }
    FamilyMember member;
    member.joint.voltage_V = curve.voltage_V;
    member.joint.current_A = curve.current_A;
    member.joint.irradiance_W_m2 = curve.conditions.irradiance_W_m2;
    member.joint.temperature_K = curve.conditions.cell_temperature_K;
    member.short_circuit_current_A = Isc(curve);
    member.irradiance_known = curve.irradiance_known;
    member.temperature_known = curve.temperature_known;
    result.members.push_back(std::move(member));
  }
  std::optional<Error> refusal;
  LeaveOutMisfits(set, options, unwanted, &result.members, &refusal);
  AddSensorUnknowns(options, &result.members);
  GuessIrradiances(&result.members, &result.notes);
  TRY(GuessTemperatures(&result.members, &result.notes));
  std::vector<int> usable;
  std::vector<double> per_sun;  // of light curves
  for (std::size_t c = 0; c < result.members.size(); ++c) {
    const FamilyMember& member = result.members[c];
    if (member.role == CurveRole::kLeftOut) continue;
    usable.push_back(static_cast<int>(c));
    if (member.IsDark()) continue;
    per_sun.push_back(member.short_circuit_current_A / member.joint.irradiance_W_m2 *
                      kReferenceIrradiance_W_m2);
  }
  const bool enough = usable.size() >= 2 && !per_sun.empty();
  if (!enough && refusal) return tl::unexpected(*refusal);
  if (!enough) {
    return Fail(
        fmt::format("expected at least two light curves, found {}: one curve cannot tell "
                    "temperature, irradiance scale or sensor errors from device parameters (n and "
                    "the saturation current absorb the temperature, the photocurrent the "
                    "irradiance)",
                    per_sun.size()),
        set.source);
  }
  result.reference_current_A = UpperMedian(per_sun);
  TRY(result.key_points, TakesKeyPoints(set, options, result.members));
  if (result.key_points) {
    for (const int c : usable) {
      result.members[c].joint.key_points =
          ResidualsOf(set.curves[c], options,
                      result.members[c].short_circuit_current_A / result.reference_current_A);
    }
  }
  WeighMembers(options.weights, &result);
  result.stated_errors = UseSigmas(set, &result.members);
  result.fitted = usable;
  if (options.fit_curves > 0) {
    result.fitted = CurveSubset(ConditionsOf(result), usable, options.fit_curves);
  }
  for (const int c : usable) {
    if (std::binary_search(result.fitted.begin(), result.fitted.end(), c)) continue;
    result.members[c].role = CurveRole::kHeldOut;
    result.held_out.push_back(c);
  }
  return result;
}

}  // namespace lyrefit
