#include "lyrefit/diagnose/prove_causes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/certify/cause_floor.h"
#include "lyrefit/certify/concave_floor.h"

namespace lyrefit {
namespace {

constexpr std::size_t kMostReadings = 2000;
constexpr double kBendOfADiode_V = 1;  // voltage range in which a bypass diode starts to conduct

// Reason why no proof is attempted; empty if there is none.
std::string WhyNothing(const CurveSet& set, const Readings& readings) {
  if (set.curves.size() != 1) return "nothing is proved of several curves together";
  const IvCurve& curve = set.curves.front();
  if (readings.traits.only_dark) return "nothing is proved of a dark curve";
  if (!curve.irradiance_W_m2.empty() || !curve.temperature_C.empty()) {
    return "nothing is proved of readings that have an irradiance or a temperature each";
  }
  if (curve.size() > kMostReadings) {
    return fmt::format("nothing is proved of more than {} readings", kMostReadings);
  }
  return "";
}

// The used readings, with the number of cells of the diagnosis.
IvCurve UsedPart(const IvCurve& curve, const WeightedData& weighted) {
  IvCurve used = curve;
  used.conditions.cells_in_series = weighted.readings->scale.cells;
  used.voltage_V.clear();
  used.current_A.clear();
  used.sigma_A.clear();
  used.time_s.clear();
  used.sweep.clear();
  for (std::size_t k = 0; k < weighted.readings->points.size(); ++k) {
    if (weighted.used[k] == 0) continue;
    const auto index = static_cast<std::size_t>(weighted.readings->points[k].index);
    used.voltage_V.push_back(curve.voltage_V[index]);
    used.current_A.push_back(curve.current_A[index]);
  }
  return used;
}

const Trial* TrialOf(const Diagnosis& diagnosis, const std::string& id) {
  for (const Trial& trial : diagnosis.trials) {
    if (trial.effect == id && trial.tried) return &trial;
  }
  return nullptr;
}

void Finish(const Diagnosis& diagnosis, const Trial& trial, CauseProof* proof) {
  proof->effect = trial.effect;
  proof->title = trial.title;
  for (const Cause& cause : diagnosis.verdict.causes) {
    if (cause.id == trial.effect) proof->named = true;
  }
  const double left = proof->lower_bound_A / proof->base_A;
  proof->explains_at_most = proof->base_A > 0 ? std::max(0.0, 1 - left * left) : 0;
}

void AddLinear(const IvCurve& curve, const Selection& selection, const Diagnosis& diagnosis,
               const ProgressReporter& progress, Proofs* proofs) {
  CauseFloorOptions options;
  options.recombination = selection.base.law.model == Model::kDoubleDiode;
  options.stop = progress.stop();
  const auto unknown = [&](const std::string& id) { return TrialOf(diagnosis, id) == nullptr; };
  options.causes.erase(std::remove_if(options.causes.begin(), options.causes.end(), unknown),
                       options.causes.end());
  if (options.causes.empty()) return;
  const auto floors = ProveCauses(curve, options);
  if (!floors) {
    proofs->sentence = floors.error().message;
    return;
  }
  for (const ProvedCause& cause : floors->causes) {
    CauseProof proof;
    proof.objective = Objective::kMeasuredCurrent;
    proof.base_A = floors->without.rmse_A;
    proof.lower_bound_A = cause.lower_bound_A;
    proof.upper_bound_A = cause.rmse_A;
    proof.holds_for = fmt::format(
        "{} with n from {:g} to {:g}, of every strength{}",
        options.recombination ? "a diode and one with n = 2" : "one diode", options.n_lower,
        options.n_upper,
        std::isnan(cause.parameter) ? ""
                                    : fmt::format(" and mixture of exponents from {:g} to {:g}",
                                                  options.exponent_lower, options.exponent_upper));
    Finish(diagnosis, *TrialOf(diagnosis, cause.cause), &proof);
    proofs->causes.push_back(std::move(proof));
  }
}

void AddShapes(const IvCurve& curve, const Selection& selection, const Diagnosis& diagnosis,
               Proofs* proofs) {
  const Trial* unequal = TrialOf(diagnosis, "mismatch");
  const Trial* shaded = TrialOf(diagnosis, "shading");
  if (unequal == nullptr && shaded == nullptr) return;
  const int diodes = std::max(SubstringsOf(selection.weighted.readings->traits) - 1, 1);
  const double bend_V = kBendOfADiode_V * diodes;
  const ConcaveFloor floor = FindConcaveFloor(curve.voltage_V, curve.current_A, bend_V);
  const auto add = [&](const Trial& trial, double lower, std::string holds_for) {
    CauseProof proof;
    proof.objective = Objective::kSolvedCurrent;
    proof.base_A = diagnosis.gain.rmse_before_A;
    proof.lower_bound_A = lower;
    proof.upper_bound_A = trial.rmse_A;
    proof.holds_for = std::move(holds_for);
    Finish(diagnosis, trial, &proof);
    proofs->causes.push_back(std::move(proof));
  };
  if (shaded != nullptr) {
    add(*shaded, floor.step_A,
        fmt::format("two parts of any share, light and cells, the bypass diodes of one taking over "
                    "within {:g} V or {} readings",
                    bend_V, kBendReadings));
  }
  if (unequal != nullptr) {
    add(*unequal, floor.smooth_A,
        "cells of any kinds, number and light, none of them bypassed or in breakdown");
  }
}

}  // namespace

Proofs FindProofs(const CurveSet& set, const Selection& selection, const AtReadings& at,
                  const Diagnosis& diagnosis, const ProgressReporter& progress) {
  Proofs proofs;
  proofs.sentence = WhyNothing(set, *selection.weighted.readings);
  if (!proofs.sentence.empty()) return proofs;
  const IvCurve curve = UsedPart(set.curves.front(), at.weighted);
  AddLinear(curve, selection, diagnosis, progress, &proofs);
  AddShapes(curve, selection, diagnosis, &proofs);
  std::stable_sort(proofs.causes.begin(), proofs.causes.end(),
                   [](const CauseProof& a, const CauseProof& b) {
                     if (a.objective != b.objective) return a.objective < b.objective;
                     return a.explains_at_most > b.explains_at_most;
                   });
  if (proofs.causes.empty() && proofs.sentence.empty()) {
    proofs.sentence = "of the causes that were tried none has a bound that can be proved";
  }
  return proofs;
}

}  // namespace lyrefit
