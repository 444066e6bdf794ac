#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace lyrefit::bench {

// A speed that the project claims: the ratio of the processor times per iteration of two benchmarks
// from one run.
struct Claim {
  std::string text;
  std::string numerator;  // full names of the two benchmarks
  std::string denominator;
  double target;  // 0: for information only
  bool at_least;  // otherwise at most
  // Benchmarks whose counter `hits` must equal their counter `runs` for the claim to hold.
  std::vector<std::string> must_all_hit;
};

// Claims are collected while benchmarks are registered, and evaluated after the run.
void AddClaim(Claim claim);

// Forwards everything to the reporter selected by --benchmark_format, and stores the results.
class ClaimReporter : public benchmark::BenchmarkReporter {
 public:
  ClaimReporter();
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& report) override;
  void Finalize() override;

  // Prints the table 'claim, target, measured, met'. Claims whose benchmarks did not run are left
  // out.
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
