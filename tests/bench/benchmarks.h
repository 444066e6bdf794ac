#pragma once

namespace lyrefit::bench {

// One function per source file, which registers the benchmarks and claims of that file.
void RegisterExpBenchmarks();
void RegisterKernelBenchmarks();
void RegisterSolverBenchmarks();
void RegisterSearchBenchmarks();
void RegisterFitBenchmarks();
void RegisterFamilyBenchmarks();
void RegisterDiagnoseBenchmarks();

}  // namespace lyrefit::bench
