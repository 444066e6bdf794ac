#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <vector>

#include "plant/synthetic_scale.h"
#include "plant/synthetic_table.h"

namespace made {
namespace {

// Of one fault, or of the healthy strings.
struct Tally {
  int strings = 0;
  int first = 0;   // the first name is right
  int in_set = 0;  // the first name is not, one beside it is
  int silent = 0;  // no claim
  int wrong = 0;   // neither
  std::map<std::string, int> instead;
};

struct Wilson {
  double low, high;
};

Wilson WilsonOf(int hits, int of) {
  constexpr double kZ = 1.959964;
  const double n = std::max(of, 1), p = hits / n;
  const double centre = p + kZ * kZ / (2 * n), norm = 1 + kZ * kZ / n;
  const double half = kZ * std::sqrt(p * (1 - p) / n + kZ * kZ / (4 * n * n));
  return {std::max(100 * (centre - half) / norm, 0.0), 100 * (centre + half) / norm};
}

std::string Rate(int hits, int of) {
  const Wilson wilson = WilsonOf(hits, of);
  char buffer[80];
  std::snprintf(buffer, sizeof buffer, "%5d of %5d  %5.1f %% [%.1f, %.1f]", hits, of,
                100.0 * hits / std::max(of, 1), wilson.low, wilson.high);
  return buffer;
}

constexpr char kShared[] = "shared ";

// Names that are right for a fault: its own, and that of its twin.
std::set<std::string> RightNames(const std::string& fault, double isc_percent) {
  const bool shared = fault.rfind(kShared, 0) == 0;
  const std::string name = shared ? fault.substr(sizeof kShared - 1) : fault;
  std::set<std::string> right = {name};
  // Less current than at the stated light: dirt, or a sensor that reads high.
  if (name == "uniform_soiling") right.insert("light_sensor");
  if (name == "light_sensor" && isc_percent < 0) right.insert("uniform_soiling");
  return right;
}

void Count(const Row& truth, const Row& row, Tally* tally) {
  ++tally->strings;
  const std::string cause = At(row, "plan_cause");
  if (cause.empty()) {
    ++tally->silent;
    return;
  }
  const auto right = RightNames(At(truth, "fault"), std::atof(At(row, "plan_Isc_percent").c_str()));
  if (right.count(cause) > 0) {
    ++tally->first;
    return;
  }
  const auto alternatives = Words(At(row, "plan_equivalents"), " ");
  const bool named = std::any_of(alternatives.begin(), alternatives.end(),
                                 [&](const std::string& name) { return right.count(name) > 0; });
  ++(named ? tally->in_set : tally->wrong);
  ++tally->instead[cause];
}

}  // namespace

std::string ScoreScalePlants(const ScaleScoreRequest& request, std::string* text) {
  std::map<std::string, Tally> tallies;
  Tally healthy, faulty, shape;
  int plants = 0;
  for (int number = 0;; ++number) {
    char name[40];
    std::snprintf(name, sizeof name, "plant%03d", number);
    const auto folder = std::filesystem::path(request.folder) / name;
    if (!std::filesystem::exists(folder / "truth.csv")) break;
    std::vector<Row> truths, results;
    std::string error = ReadRows((folder / "truth.csv").string(), &truths);
    if (error.empty()) {
      error = ReadRows((folder / request.results / "results.csv").string(), &results);
    }
    if (!error.empty()) return error;
    std::map<std::string, Row> by_id;
    for (const Row& row : results) by_id[At(row, "id")] = row;
    ++plants;
    std::set<std::string> shared;  // combiners; an error that strings share counts once
    for (const Row& truth : truths) {
      std::string fault = At(truth, "fault");
      const std::string id = At(truth, "id");
      const bool of_all = fault.rfind(kShared, 0) == 0;
      if (request.planned && of_all && !shared.insert(id.substr(0, id.rfind('/'))).second) continue;
      // Neighbours that share an error do not show it.
      if (!request.planned && of_all) fault.clear();
      Row known = truth;
      known["fault"] = fault;
      Tally* const tally = fault.empty() ? &healthy : fault == "shape" ? &shape : &tallies[fault];
      Count(known, by_id[id], tally);
    }
  }
  if (plants == 0) return "no plants in " + request.folder;
  char line[300];
  for (const auto& [fault, tally] : tallies) {
    faulty.strings += tally.strings;
    faulty.first += tally.first;
    faulty.in_set += tally.in_set;
    faulty.wrong += tally.wrong;
    faulty.silent += tally.silent;
    std::snprintf(line, sizeof line, "%-26s first %s  in the set %d, wrong %d, silent %d",
                  fault.c_str(), Rate(tally.first, tally.strings).c_str(), tally.in_set,
                  tally.wrong, tally.silent);
    *text += line;
    for (const auto& [cause, count] : tally.instead) {
      *text += "  " + cause + " " + std::to_string(count);
    }
    *text += '\n';
  }
  const int claims_on_healthy = healthy.strings - healthy.silent;
  const int claims_on_shape = shape.strings - shape.silent;
  const int claims = faulty.strings - faulty.silent + claims_on_healthy + claims_on_shape;
  const int wrong = faulty.wrong + claims_on_healthy + claims_on_shape;
  *text += std::to_string(plants) + " plants\n";
  *text += "first name right             " + Rate(faulty.first, faulty.strings) + "\n";
  *text +=
      "  of those that are claimed  " + Rate(faulty.first, faulty.strings - faulty.silent) + "\n";
  *text += "wrong claims of all claims   " + Rate(wrong, claims) + "\n";
  *text += "claims of healthy strings    " + Rate(claims_on_healthy, healthy.strings) + "\n";
  *text += "claims of strings with a     " + Rate(claims_on_shape, shape.strings) +
           "\n  fault of the shape alone\n";
  for (const auto& [what, tally] :
       {std::make_pair("healthy", &healthy), std::make_pair("shape", &shape)}) {
    for (const auto& [cause, count] : tally->instead) {
      *text += std::string("  ") + what + ": " + cause + " " + std::to_string(count) + "\n";
    }
  }
  return "";
}

}  // namespace made
