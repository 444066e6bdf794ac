#include "lyrefit/family/family_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "lyrefit/base/observer.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/try.h"
#include "lyrefit/estimate/fit/prepare_fit.h"
#include "lyrefit/family/family_search.h"
#include "lyrefit/model/extended_set.h"

namespace lyrefit {
namespace {

constexpr std::size_t kProbes = 4;
constexpr std::size_t kElites = 3;

const DeviceEffects& EffectsOf(const Translation& translation) {
  return *translation.extended->effects;
}

Expected<void> CheckTogether(const FamilyOptions& options, const FamilyProblem& family) {
  if (options.law != TranslationLaw::kDeSoto) {
    return Fail(
        "with: effects stand beside the law of De Soto, not beside pvsyst: expected the family "
        "desoto, or free");
  }
  TRY(CheckObjectiveOfEffects(options.objective));
  if (std::isnan(family.fixed[family.translation.bandgap_slope])) {
    return Fail("free: dEgdT is fixed beside effects");
  }
  if (options.irradiance_offset || options.temperature_offset) {
    return Fail(fmt::format(
        "{}: beside effects the common error of a sensor is one of them: expected the effect {}",
        options.irradiance_offset ? "irradiance-offset" : "temperature-offset",
        options.irradiance_offset ? "sensor_offset" : "temp_offset"));
  }
  if (options.irradiance_accuracy > 0 || options.temperature_accuracy_K > 0) {
    return Fail(fmt::format(
        "{}: beside effects curves have no unknowns of their own: leave it out",
        options.irradiance_accuracy > 0 ? "irradiance-accuracy" : "temperature-accuracy"));
  }
  return {};
}

// The curves that are not left out, with the irradiance and temperature that the fit uses.
Expected<CurveSet> Kept(const CurveSet& set, const FamilyMembers& members) {
  CurveSet kept;
  for (std::size_t c = 0; c < set.curves.size(); ++c) {
    const FamilyMember& member = members.members[c];
    if (member.role == CurveRole::kLeftOut) continue;
    kept.curves.push_back(set.curves[c]);
    IvCurve& curve = kept.curves.back();
    if (member.joint.irradiance_sd > 0 || member.joint.temperature_sd_K > 0) {
      return Fail(fmt::format(
          "curve {} states no {}, which it has to beside effects: state it, or leave the curve out",
          curve.name, member.joint.irradiance_sd > 0 ? "irradiance" : "cell temperature"));
    }
    curve.conditions.irradiance_W_m2 = member.joint.irradiance_W_m2;
    curve.conditions.cell_temperature_K = member.joint.temperature_K;
    curve.irradiance_known = curve.temperature_known = true;
  }
  return kept;
}

}  // namespace

Expected<void> AddFamilyEffects(const CurveSet& set, const FamilyOptions& options,
                                FamilyProblem* family) {
  TRY(CheckTogether(options, *family));
  TRY(const CurveSet kept, Kept(set, family->curves));
  Translation& at = family->translation;
  const int first = at.size();
  TRY(ExtendTranslation(kept, family->fixed[at.bandgap_slope], options.with, options.force_effects,
                        &at));
  TRY(CheckFitRanges(EffectsOf(at)));
  const std::vector<ParameterBounds>& bounds = EffectsOf(at).bounds;
  family->bounds.insert(family->bounds.begin() + first, bounds.begin(), bounds.end());
  std::vector<double> fixed;
  for (const ParameterBounds& b : bounds) {
    fixed.push_back(b.lower == b.upper ? b.lower : kUnknown);
    family->free_parameters += b.lower < b.upper;
  }
  family->fixed.insert(family->fixed.begin() + first, fixed.begin(), fixed.end());
  int next = 0;
  for (FamilyMember& member : family->curves.members) {
    if (member.role == CurveRole::kLeftOut) continue;
    member.joint.extended = std::make_shared<const Device>(OfCurve(*at.extended, next++));
  }
  return {};
}

std::vector<JointPoint> FamilyEffectStarts(const FamilyProblem& family,
                                           const FamilyOptions& options,
                                           const std::vector<int>& search_curves,
                                           const std::vector<JointPoint>& elites,
                                           std::vector<JointPoint> starts,
                                           const Observer& observer) {
  const DeviceEffects& device_effects = EffectsOf(family.translation);
  const int first = family.translation.first_effect;
  const JointProblem problem = JointProblemOn(family, options, search_curves);
  const std::vector<JointLocal> none(problem.curves.size(), {0, 0});
  JointProblem fixed = problem;
  std::copy(device_effects.usual.begin(), device_effects.usual.end(), fixed.lower.begin() + first);
  std::copy(device_effects.usual.begin(), device_effects.usual.end(), fixed.upper.begin() + first);
  const ProgressReporter progress(observer, "without effects",
                                  static_cast<std::int64_t>(starts.size()));
  std::vector<JointEnd> ends(starts.size());
  ParallelFor(static_cast<int>(starts.size()), options.threads, [&](int s) {
    if (progress.Stopped()) return;
    JointOptions quick;
    quick.function_tolerance = 1e-10;
    quick.stop = progress.stop();
    std::vector<double>& shared = starts[s].shared;
    std::copy(device_effects.usual.begin(), device_effects.usual.end(), shared.begin() + first);
    ends[s] = RefineJointly(fixed, {shared, none}, quick);
    progress.Step();
  });
  std::vector<JointPoint> chosen(
      elites.begin(),
      elites.begin() + static_cast<std::ptrdiff_t>(std::min(kElites, elites.size())));
  if (progress.Stopped()) return chosen;
  const auto best =
      std::min_element(ends.begin(), ends.end(),
                       [](const JointEnd& a, const JointEnd& b) { return a.squares < b.squares; });
  struct Trial {
    JointPoint point;
    double rmse;
  };
  std::vector<Trial> trials;
  for (const std::vector<double>& effects : EffectStarts(device_effects)) {
    JointPoint point{best->point.shared, none};
    std::copy(effects.begin(), effects.end(), point.shared.begin() + first);
    const double rmse = FamilyRmse(problem, point).solved_current_A;
    if (std::isfinite(rmse)) trials.push_back({std::move(point), rmse});
  }
  std::stable_sort(trials.begin(), trials.end(),
                   [](const Trial& a, const Trial& b) { return a.rmse < b.rmse; });
  for (std::size_t k = 0; k < std::min(kProbes, trials.size()); ++k) {
    chosen.push_back(std::move(trials[k].point));
  }
  return chosen;
}

std::vector<JointPoint> ChooseStarts(const FamilyProblem& family, const FamilyOptions& options,
                                     const std::vector<int>& search_curves,
                                     std::vector<JointPoint> starts, std::ptrdiff_t elites,
                                     const Observer& observer) {
  const auto others = starts.begin() + elites;
  std::vector<JointPoint> candidates(starts.begin(), others);
  if (options.starts == StartsFrom::kSearch) return candidates;
  if (options.starts == StartsFrom::kShape && others != starts.end()) {
    starts.erase(starts.begin(), others);
    candidates.clear();
  }
  if (!family.translation.extended) return starts;
  return FamilyEffectStarts(family, options, search_curves, candidates, std::move(starts),
                            observer);
}

}  // namespace lyrefit
