// Measures every speed that lyrefit claims, on one thread in one run.

#include <benchmark/benchmark.h>

#include <cstring>
#include <iostream>

#include "benchmarks.h"
#include "claims.h"

namespace {

// Whether standard output has a machine-readable format. The table of claims then goes to standard
// error.
bool OutputIsForPrograms(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--benchmark_format=json") == 0) return true;
    if (std::strcmp(argv[i], "--benchmark_format=csv") == 0) return true;
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  const bool for_programs = OutputIsForPrograms(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  lyrefit::bench::RegisterExpBenchmarks();
  lyrefit::bench::RegisterKernelBenchmarks();
  lyrefit::bench::RegisterSolverBenchmarks();
  lyrefit::bench::RegisterSearchBenchmarks();
  lyrefit::bench::RegisterFitBenchmarks();
  lyrefit::bench::RegisterFamilyBenchmarks();
  lyrefit::bench::RegisterDiagnoseBenchmarks();
  lyrefit::bench::ClaimReporter reporter;
  if (benchmark::RunSpecifiedBenchmarks(&reporter) > 0) {
    reporter.PrintClaims(for_programs ? std::cerr : std::cout);
  }
  benchmark::Shutdown();
  return 0;
}
