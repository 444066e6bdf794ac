#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace lyrefit::bench {

// What the project promises: the processor time per iteration of one benchmark over that of
// another, both measured in the same run.
struct Claim {
  std::string text;
  std::string numerator;  // full names of the two benchmarks
  std::string denominator;
  double target;  // 0: for information only
  bool at_least;  // else at most
  // Benchmarks whose counter `hits` must equal their counter `runs` for the claim to hold.
  std::vector<std::string> must_all_hit;
};

// Claims are collected while the benchmarks register and judged when they have run.
void AddClaim(Claim claim);

// Passes everything on to the reporter that --benchmark_format asks for, and remembers the results.
class ClaimReporter : public benchmark::BenchmarkReporter {
 public:
  ClaimReporter();
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& report) override;
  void Finalize() override;

  // The table 'claim, target, measured, met'. Claims whose benchmarks did not run are left out.
  void PrintClaims(std::ostream& out) const;

 private:
  struct Result {
    double cpu_seconds;  // per iteration, the smallest of the repetitions
    double hits = 0;
    double runs = 0;
  };

  std::unique_ptr<benchmark::BenchmarkReporter> inner_;
  std::map<std::string, Result> results_;
};

}  // namespace lyrefit::bench
