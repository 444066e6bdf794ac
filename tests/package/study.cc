#include <cstdio>

#include "lyrefit/lyrefit.h"
#include "lyrefit/study.h"

// Argument: the folder of a curve. Compares two searches on it and succeeds if both did all their
// runs.
int main(int argc, char** argv) {
  auto curve = lyrefit::ReadCurve(argc > 1 ? argv[1] : ".");
  if (!curve) return std::puts(curve.error().ToString().c_str()), 1;
  lyrefit::CompareOptions options;
  options.models = {lyrefit::Model::kSingleDiode};
  options.runs = 2;
  lyrefit::SearchOptions search;
  search.iterations = 20;
  const auto comparison = lyrefit::Compare(
      {lyrefit::MakeSubject(std::move(*curve), {})},
      lyrefit::PlainAlgorithms({lyrefit::Algorithm::kLo, lyrefit::Algorithm::kMlo}, search),
      options);
  if (!comparison) return std::puts(comparison.error().ToString().c_str()), 1;
  std::fputs(lyrefit::CompareText(*comparison).c_str(), stdout);
  for (const auto& compared : comparison->problems.at(0).algorithms) {
    if (compared.runs.size() != 2) return 1;
  }
  return 0;
}
