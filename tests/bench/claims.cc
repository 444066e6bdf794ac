#include "claims.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace lyrefit::bench {
namespace {

std::vector<Claim>& Claims() {
  static std::vector<Claim> claims;
  return claims;
}

double CounterOr(const benchmark::BenchmarkReporter::Run& run, const char* name, double otherwise) {
  const auto found = run.counters.find(name);
  return found == run.counters.end() ? otherwise : found->second.value;
}

}  // namespace

void AddClaim(Claim claim) { Claims().push_back(std::move(claim)); }

ClaimReporter::ClaimReporter() : inner_(benchmark::CreateDefaultDisplayReporter()) {}

bool ClaimReporter::ReportContext(const Context& context) { return inner_->ReportContext(context); }

void ClaimReporter::ReportRuns(const std::vector<Run>& report) {
  for (const Run& run : report) {
    if (run.run_type != Run::RT_Iteration || run.error_occurred || run.iterations == 0) continue;
    const double seconds = run.cpu_accumulated_time / static_cast<double>(run.iterations);
    const auto [place, fresh] = results_.emplace(run.run_name.function_name, Result{seconds});
    Result& result = place->second;
    if (!fresh) result.cpu_seconds = std::min(result.cpu_seconds, seconds);
    result.hits = CounterOr(run, "hits", 0);
    result.runs = CounterOr(run, "runs", 0);
  }
  inner_->ReportRuns(report);
}

void ClaimReporter::Finalize() { inner_->Finalize(); }

void ClaimReporter::PrintClaims(std::ostream& out) const {
  char line[512];
  std::snprintf(line, sizeof line, "\n%-66s %10s %10s  %s\n", "claim", "target", "measured", "met");
  out << line << std::string(94, '-') << '\n';
  for (const Claim& claim : Claims()) {
    const auto top = results_.find(claim.numerator);
    const auto bottom = results_.find(claim.denominator);
    if (top == results_.end() || bottom == results_.end()) continue;
    const double ratio = top->second.cpu_seconds / bottom->second.cpu_seconds;
    bool met = claim.at_least ? ratio >= claim.target : ratio <= claim.target;
    std::string remark;
    for (const auto* side : {&*top, &*bottom}) {
      if (side->second.runs <= 0) continue;
      std::snprintf(line, sizeof line, "%s%.0f/%.0f", remark.empty() ? "  hits " : " : ",
                    side->second.hits, side->second.runs);
      remark += line;
    }
    for (const std::string& name : claim.must_all_hit) {
      const auto found = results_.find(name);
      met = met && found != results_.end() && found->second.hits == found->second.runs;
    }
    char target[32] = "";
    if (claim.target > 0) {
      std::snprintf(target, sizeof target, "%s %.2f", claim.at_least ? ">=" : "<=", claim.target);
    }
    std::snprintf(line, sizeof line, "%-66s %10s %10.2f  %-3s", claim.text.c_str(), target, ratio,
                  claim.target > 0 ? (met ? "yes" : "NO") : "");
    out << line << remark << '\n';
  }
}

}  // namespace lyrefit::bench
