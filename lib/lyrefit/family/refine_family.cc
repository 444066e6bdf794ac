#include "lyrefit/family/refine_family.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "lyrefit/base/parallel.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/family/family_members.h"
#include "lyrefit/family/family_problem.h"
#include "lyrefit/family/joint.h"
#include "lyrefit/family/key_point_solver.h"

namespace lyrefit {
namespace {

// Starts of a joint fit of key points: for idealities from 0.8 to 2 the curves that pass through
// Isc, Voc and the maximum power point of the brightest of these conditions that states all
// (key_point_solver.h), translated to the reference with usual coefficients.
std::vector<JointPoint> KeyPointStarts(const FamilyProblem& family,
                                       const std::vector<int>& curves) {
  const JointCurve* brightest = nullptr;
  for (const int c : curves) {
    const JointCurve& one = family.curves.members[c].joint;
    if (!one.key_points || one.key_points->size() < kKeyPointRows) continue;
    if (brightest == nullptr || one.irradiance_W_m2 > brightest->irradiance_W_m2) brightest = &one;
  }
  std::vector<JointPoint> starts;
  if (brightest == nullptr) return starts;
  const auto& value = brightest->key_points->value;
  DataSheetValues values;
  values.short_circuit_current_A = value[kIscRow];
  values.open_circuit_voltage_V = value[kVocRow];
  values.max_power_voltage_V = value[kVmpRow];
  values.max_power_current_A = value[kPmpRow] / value[kVmpRow];
  const TranslationSpec& spec = family.translation.spec;
  const KeyPointSheet sheet{
      values, spec.cells_in_series * ThermalVoltage(brightest->temperature_K, spec.constants),
      spec.constants};
  // The lower end of the search is 1 for each junction of a cell.
  const double junctions = std::max(1.0, family.bounds[family.translation.n].search_lower);
  for (const double n : {0.8, 0.95, 1.1, 1.25, 1.4, 1.7, 2.0}) {
    const auto curve = PhysicalCurve(sheet, n * junctions);
    if (!curve) continue;
    const ReferenceDevice device = ToDevice(sheet, *curve);
    std::vector<double> shared =
        StartFromIndividualFit(family, *brightest,
                               {device.photocurrent_A, device.saturation_current_A, device.n,
                                device.resistance_series_ohm, 1 / device.shunt_conductance_S});
    if (!shared.empty()) starts.push_back({std::move(shared), {}});
  }
  return starts;
}

FitOptions SingleFitOptions(const FamilyOptions& options) {
  FitOptions fit = OwnFitOptions(options);
  fit.search.seed = options.search.seed;
  // One curve hardly determines two idealities; the law fixes the second one as well.
  if (options.model == Model::kDoubleDiode) fit.fixed["n2"] = 2;
  return fit;
}

// Fixes the integer-valued parameters at the values that the starts selected.
void SettleWhole(const std::vector<double>& shared, FamilyProblem* family) {
  for (std::size_t i = 0; i < family->bounds.size(); ++i) {
    if (family->bounds[i].whole == 0) continue;
    const double at = family->fixed[i] = shared[i];
    family->bounds[i] = {at, at, at, at, SearchScale::kLinear};
  }
}

}  // namespace

Expected<PreparedFamily> PrepareFamily(const CurveSet& set, const FamilyOptions& options) {
  TRY(ValidateThreads(options.threads));
  TRY(FamilyProblem family, MakeFamilyProblem(set, options));
  TRY(CheckAgainst(family, options));
  const std::vector<int>& fitted = family.curves.fitted;
  std::size_t points = 0;
  for (const int c : fitted) {
    points += static_cast<std::size_t>(family.curves.members[c].joint.residuals());
  }
  if (static_cast<int>(points) <= family.free_parameters) {
    return Fail(fmt::format("{} points cannot determine {} shared parameters", points,
                            family.free_parameters),
                set.source);
  }
  std::vector<int> search_curves =
      CurveSubset(ConditionsOf(family.curves), fitted, options.search_curves);
  return PreparedFamily{set, options, std::move(family), std::move(search_curves)};
}

CurvesAlone FitCurvesAlone(const PreparedFamily& prepared, const Observer& observer) {
  const FamilyOptions& options = prepared.options;
  const FamilyMembers& members = prepared.family.curves;
  const std::vector<int>& search = prepared.search_curves;
  CurvesAlone alone;
  if (members.key_points) {  // too few for a fit of a condition by itself
    alone.starts = KeyPointStarts(prepared.family, members.fitted);
    return alone;
  }
  alone.curves = search;
  if (options.individual_fits) {
    alone.curves = members.fitted;
    alone.curves.insert(alone.curves.end(), members.held_out.begin(), members.held_out.end());
  }
  std::vector<const IvCurve*> curves;
  curves.reserve(alone.curves.size());
  for (const int c : alone.curves) curves.push_back(&prepared.set.curves[c]);
  alone.fits = FitEveryCurve(curves, SingleFitOptions(options), options.threads, observer);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const int c = alone.curves[k];
    const std::optional<Expected<FitReport>>& one = alone.fits.reports[k];
    const bool of_search = std::find(search.begin(), search.end(), c) != search.end();
    if (!one || !*one || !of_search || members.members[c].IsDark()) continue;
    std::vector<double> start =
        StartFromIndividualFit(prepared.family, members.members[c].joint, (**one).refined);
    if (!start.empty()) alone.starts.push_back({std::move(start), {}});
  }
  return alone;
}

RefinedFamily RefineFamily(const PreparedFamily& prepared, const FamilySearchEnd& searched,
                           const std::vector<JointPoint>& individual_starts,
                           const Observer& observer) {
  const FamilyOptions& options = prepared.options;
  const FamilyProblem& family = prepared.family;
  const std::vector<int>& search_curves = prepared.search_curves;
  RefinedFamily refined;
  refined.family = family;
  refined.problem = JointProblemOn(family, options, family.curves.fitted);
  JointPoint candidate = searched.elites[0];
  candidate.local.assign(refined.problem.curves.size(), {0, 0});
  refined.searched = FamilyRmse(refined.problem, candidate);
  if (family.curves.key_points) {
    refined.searched_key_points = KeyPointRms(refined.problem, candidate);
  }
  if (options.plain_polish) {
    refined.candidate = PolishCandidate(family, options, search_curves, searched.elites[0],
                                        observer, refined.problem);
  }
  const Instant begin = Now();
  std::vector<JointPoint> starts = searched.elites;
  starts.insert(starts.end(), individual_starts.begin(), individual_starts.end());
  starts = ChooseStarts(family, options, search_curves, std::move(starts),
                        static_cast<std::ptrdiff_t>(searched.elites.size()), observer);
  refined.end = FitJointly(family, options, search_curves, starts, observer, &refined.problem);
  refined.weights =
      SettleWeights(options, observer, &refined.family, &refined.problem, &refined.end);
  SettleWhole(refined.end.point.shared, &refined.family);
  refined.seconds = SecondsSince(begin);
  return refined;
}

}  // namespace lyrefit
