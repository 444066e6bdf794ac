#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lyrefit/read/read_curve.h"
#include "lyrefit/study/algorithms.h"
#include "lyrefit/study/compare.h"

namespace lyrefit {

inline CompareCurve RtcFrance(const std::string& bounds = "physical") {
  const auto curve = ReadCurve(std::string(LYREFIT_DATA_DIR) + "/rtc_france");
  EXPECT_TRUE(curve) << curve.error().ToString();
  CompareCurve subject = MakeSubject(*curve, {});
  subject.bounds.name = bounds;
  return subject;
}

// A search that takes about a millisecond.
inline SearchOptions SmallSearch() {
  SearchOptions search;
  search.population = 10;
  search.iterations = 20;
  return search;
}

inline std::vector<ComparedAlgorithm> SmallAlgorithms() {
  return PlainAlgorithms({Algorithm::kMlo, Algorithm::kDe, Algorithm::kRandom}, SmallSearch());
}

inline CompareOptions SmallOptions() {
  CompareOptions options;
  options.models = {Model::kSingleDiode, Model::kDoubleDiode};
  options.runs = 4;
  options.seed = 3;
  options.threads = 2;
  return options;
}

}  // namespace lyrefit
