#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/family/joint.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/translation.h"

namespace lyrefit {

// Irradiance and cell temperature of a synthetic curve.
struct SyntheticAt {
  double irradiance_W_m2;
  double temperature_C;
};

inline const std::vector<SyntheticAt> kSixPlaces = {{1000, 25}, {1000, 60}, {600, 45},
                                                    {400, 20},  {200, 35},  {800, 10}};

inline Translation SyntheticLaw(TranslationLaw law, Model model = Model::kSingleDiode,
                                bool recombination = false) {
  TranslationSpec spec;
  spec.law = law;
  spec.model = model;
  if (law == TranslationLaw::kPvsyst) spec.shunt = ShuntLaw::kExponential;
  spec.recombination = recombination;
  spec.cells_in_series = 36;
  return *MakeTranslation(spec);
}

// Parameters of a plausible 36-cell module under the law, followed by sensor offsets of 0.
inline std::vector<double> SyntheticTruth(const Translation& at) {
  std::vector<double> shared(at.size() + 2, 0);
  const auto set = [&](int i, double value) {
    if (i >= 0) shared[i] = value;
  };
  const bool two = at.saturation_current_2 >= 0;
  set(at.photocurrent, 3.8);
  set(at.saturation_current, two ? 2e-9 : 2e-8);
  set(at.n, two ? 1.07 : 1.2);
  set(at.resistance_series, 0.25);
  set(at.resistance_shunt, 200);
  set(at.alpha_sc, 2e-3);
  set(at.bandgap, 1.121);
  set(at.bandgap_slope, -2.677e-4);
  set(at.n_slope, -5e-4);
  set(at.resistance_shunt_dark, 900);
  set(at.shunt_exponent, 5.5);
  set(at.saturation_current_2, 4e-6);
  set(at.n_2, 2);
  set(at.recombination, 1.0);
  set(at.built_in_voltage, 0.9 * 36);
  return shared;
}

// The curve of the device under these conditions at `points` voltages from 0 to slightly beyond
// Voc, with noise.
inline IvCurve SyntheticCurve(const Translation& law, const std::vector<double>& shared,
                              const SyntheticAt& at, int points, double noise_A,
                              RandomStream* random) {
  const double kelvin = at.temperature_C + 273.15;
  const TranslatedDevice made = TranslateTo(law, shared, at.irradiance_W_m2, kelvin);
  const double voc = ModelKeyPoints(made.device, made.parameters.data()).open_circuit_voltage_V;
  IvCurve curve;
  curve.conditions.irradiance_W_m2 = at.irradiance_W_m2;
  curve.conditions.cell_temperature_K = kelvin;
  curve.conditions.cells_in_series = law.spec.cells_in_series;
  for (int k = 0; k < points; ++k) curve.voltage_V.push_back(1.01 * voc * k / (points - 1));
  curve.current_A = SolveCurrents(made.device, made.parameters.data(), curve.voltage_V);
  for (double& current : curve.current_A) current += noise_A * random->Normal();
  return curve;
}

inline CurveSet SyntheticSet(const Translation& law, const std::vector<double>& shared,
                             const std::vector<SyntheticAt>& places, int points, double noise_A,
                             std::uint64_t seed = 1) {
  RandomStream random(seed);
  CurveSet set;
  set.name = "made";
  for (const SyntheticAt& at : places) {
    set.curves.push_back(SyntheticCurve(law, shared, at, points, noise_A, &random));
    set.curves.back().name = "c" + std::to_string(set.curves.size());
  }
  return set;
}

// `count` conditions spread over 100 to 1000 W/m2 and 10 to 60 C.
inline std::vector<SyntheticAt> ManyPlaces(int count) {
  std::vector<SyntheticAt> places;
  for (int k = 0; k < count; ++k) {
    places.push_back({100.0 + 900.0 * ((7 * k) % count) / count, 10.0 + 50.0 * k / count});
  }
  return places;
}

// The joint problem of a set with wide bounds. Parameters that a family fit fixes by default are
// fixed.
inline JointProblem SyntheticProblem(const CurveSet& set, const Translation& law,
                                     const std::vector<double>& truth) {
  JointProblem problem;
  problem.translation = law;
  for (const IvCurve& curve : set.curves) {
    JointCurve joint;
    joint.voltage_V = curve.voltage_V;
    joint.current_A = curve.current_A;
    joint.weight.assign(curve.size(), 1);
    joint.irradiance_W_m2 = curve.conditions.irradiance_W_m2;
    joint.temperature_K = curve.conditions.cell_temperature_K;
    problem.curves.push_back(std::move(joint));
  }
  problem.lower = problem.upper = truth;
  const auto free = [&](int i, double lower, double upper) {
    if (i < 0) return;
    problem.lower[i] = lower;
    problem.upper[i] = upper;
  };
  const double infinity = HUGE_VAL;
  free(law.photocurrent, 0.5, 20);
  free(law.saturation_current, 0, infinity);
  free(law.n, 0.5, 4);
  free(law.resistance_series, 0, 3);
  free(law.resistance_shunt, 0.5, infinity);
  free(law.alpha_sc, -0.1, 0.1);
  if (law.n_slope < 0) free(law.bandgap, 0.3, 2.5);
  free(law.n_slope, -0.05, 0.05);
  free(law.resistance_shunt_dark, 0, infinity);
  free(law.saturation_current_2, 0, infinity);
  free(law.recombination, 0, 30);
  FindJointScales(&problem);
  return problem;
}

// A point whose local unknowns of the curves are 0.
inline JointPoint PointAt(const JointProblem& problem, std::vector<double> shared) {
  return {std::move(shared), std::vector<JointLocal>(problem.curves.size(), {0, 0})};
}

}  // namespace lyrefit
