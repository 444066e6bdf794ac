#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "law/made_curve.h"
#include "lyrefit/diagnose/diagnose.h"

namespace lyrefit {

// Few draws and nothing held out, where neither matters.
inline DiagnoseOptions Quick(DiagnoseOptions options = {}) {
  options.draws = 400;
  options.held_out = false;
  return options;
}

// Of a curve or a set of curves that can be diagnosed.
template <class Data>
Diagnosis DiagnoseOrFail(const Data& data, const DiagnoseOptions& options = Quick()) {
  auto diagnosis = Diagnose(data, options);
  EXPECT_TRUE(diagnosis.has_value()) << diagnosis.error().message;
  return diagnosis ? *diagnosis : Diagnosis();
}

inline std::vector<std::string> Ids(const Diagnosis& diagnosis) {
  std::vector<std::string> ids;
  for (const Cause& cause : diagnosis.verdict.causes) ids.push_back(cause.id);
  return ids;
}

// A sweep during which the light steps up.
inline IvCurve CurveWithAStep() {
  IvCurve curve = MadeCurve({});
  for (std::size_t k = 26; k < curve.size(); ++k) curve.current_A[k] += 0.12;
  return curve;
}

}  // namespace lyrefit
