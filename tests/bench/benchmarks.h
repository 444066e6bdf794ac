#pragma once

namespace lyrefit::bench {

// One a file: each registers its benchmarks and claims.
void RegisterExpBenchmarks();
void RegisterKernelBenchmarks();
void RegisterSolverBenchmarks();
void RegisterSearchBenchmarks();
void RegisterFitBenchmarks();
void RegisterFamilyBenchmarks();
void RegisterDiagnoseBenchmarks();

}  // namespace lyrefit::bench
