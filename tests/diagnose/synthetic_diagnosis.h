#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lyrefit/diagnose/diagnose.h"
#include "synthetic/curves.h"

namespace lyrefit {

// Options without held-out fits, for tests in which they do not matter.
inline DiagnoseOptions Quick(DiagnoseOptions options = {}) {
  options.held_out = false;
  return options;
}

// Diagnoses a curve or a set of curves; the test fails on an error.
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

// A sweep of a cell of 8 A in which the current steps up by 0.12 A.
inline IvCurve CurveWithAStep() {
  IvCurve curve = SyntheticCurve({});
  for (std::size_t k = 26; k < curve.size(); ++k) curve.current_A[k] += 0.12;
  return curve;
}

}  // namespace lyrefit
