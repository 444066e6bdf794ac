#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "faults/field_case.h"
#include "faults/score.h"
#include "faults/study.h"
#include "faults/study_field.h"
#include "studies/coverage.h"

namespace faults {
namespace {

// A probability that was stated, and whether what it was stated of is true.
struct Outcome {
  double stated = 0;
  bool is_true = false;
};

// Of one case: what is stated of every finding before anything is named, and the first finding that
// is named.
struct Outcomes {
  std::vector<Outcome> all;
  std::vector<Outcome> named;
  std::string row;
};

bool Holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// `accepted`: the findings that are true; empty: none. `material`: whether they exceed the floors.
Outcomes OutcomesOf(std::vector<std::string> accepted, bool material, const Answer& answer) {
  for (std::string& name : accepted) name = FindingOf(name);
  Outcomes outcomes;
  double right = 0;
  for (const Stated& stated : answer.stated) {
    if (stated.id == "none") {
      outcomes.all.push_back({stated.probability, accepted.empty() || !material});
    } else if (Holds(accepted, stated.id)) {
      right += stated.probability;
    } else {
      outcomes.all.push_back({stated.probability, false});
    }
  }
  if (!accepted.empty()) outcomes.all.push_back({right, material});
  for (const Claim& claim : answer.claims) {
    if (claim.by_values || claim.id == "outliers" || claim.id == "unknown_structure") continue;
    outcomes.named.push_back({claim.probability, Holds(accepted, claim.id)});
    break;
  }
  return outcomes;
}

std::string RowOf(const std::string& kind, int number, double misfit, const Answer& answer,
                  const Outcomes& outcomes) {
  double none = 0;
  for (const Stated& stated : answer.stated) none = stated.id == "none" ? stated.probability : none;
  char text[512];
  std::snprintf(text, sizeof text, "%s,%d,%.3f,%.4f,%.4f,%d,%s\n", kind.c_str(), number, misfit,
                none, outcomes.named.empty() ? 0 : outcomes.named[0].stated,
                outcomes.named.empty() ? -1 : outcomes.named[0].is_true, Text(answer).c_str());
  return text;
}

// Number of a weight that is drawn in proportion.
int Draw(const std::vector<double>& weights, Random* random) {
  double total = 0;
  for (const double weight : weights) total += weight;
  double at = total * random->Unit();
  for (std::size_t k = 0; k + 1 < weights.size(); ++k) {
    if (at < weights[k]) return static_cast<int>(k);
    at -= weights[k];
  }
  return static_cast<int>(weights.size()) - 1;
}

double Odds(double prior) { return prior / (1 - prior); }

// The laboratory world: nothing, or one effect; each is as common as the diagnosis takes it to be.
Outcomes LaboratoryOutcomes(const StudyOptions& options, int number) {
  Random random(SeedOf(options.seed, number, 11));
  const Kind kind =
      KindsCalled(options.kind)[random.Index(static_cast<int>(KindsCalled(options.kind).size()))];
  std::vector<const Injection*> injections;
  std::vector<double> weights;
  for (const Injection* injection : HidesCalled("all", kind)) {
    const std::string name = injection->name;
    if (name == "temperature_or_cells" || name == "quantisation" || name == "outliers") continue;
    injections.push_back(injection);
    weights.push_back(Odds(PriorOf(name, false, ModeOf(options))));
  }
  weights.push_back(1);
  const std::size_t drawn = Draw(weights, &random);
  if (drawn == injections.size()) {
    const Case made = NullFor(options, kind, number);
    const Answer answer = Ask(made.measurement, number, options.probability,
                              SeedOf(options.seed, number), made.second_diode, ModeOf(options));
    Outcomes outcomes = OutcomesOf({}, false, answer);
    outcomes.row = RowOf("none", number, 0, answer, outcomes);
    return outcomes;
  }
  constexpr double kLeast = 1, kMost = 25;  // misfits in noise units
  const auto made = MakeCase(RequestFor(options, kind, *injections[drawn], number, kLeast, kMost));
  if (!made) return {};
  const Answer answer = Ask(made->measurement, number, options.probability,
                            SeedOf(options.seed, number), false, ModeOf(options));
  constexpr double kShown = 4.7;  // misfit in noise units that a test can find
  Outcomes outcomes =
      OutcomesOf(made->causes[0].acceptable, made->causes[0].misfit > kShown, answer);
  outcomes.row = RowOf(injections[drawn]->name, number, made->causes[0].misfit, answer, outcomes);
  return outcomes;
}

// Which effect a kind of the field world is an instance of.
std::string EffectOf(const std::string& kind) {
  static const std::vector<std::pair<std::string, std::string>> kOther = {
      {"snow", "shading"},           {"unlike_groups", "substrings"},
      {"both_halves", "dim_cells"},  {"open_group", "open_substring"},
      {"light_step", "irr_step"},    {"light_edge", "cloud_edge"},
      {"light_dip", "transient"},    {"light_drift", "drift"},
      {"hysteresis", "capacitance"}, {"falling_hysteresis", "capacitance"}};
  for (const auto& [name, effect] : kOther) {
    if (name == kind) return effect;
  }
  return kind;
}

Outcomes FieldOutcomes(const StudyOptions& options, int number) {
  Random random(SeedOf(options.seed, number, 12));
  std::vector<std::string> kinds;
  std::vector<double> weights;
  for (const std::string& kind : field::Kinds()) {
    if (kind.rfind("clean", 0) == 0 || kind == "voltage_bins" || kind == "limits") continue;
    kinds.push_back(kind);
    weights.push_back(Odds(PriorOf(EffectOf(kind), true, ModeOf(options))));
  }
  kinds.emplace_back("clean_module");
  weights.push_back(1);
  const std::string kind = kinds[Draw(weights, &random)];
  const field::Case made = FieldCase(options, kind, number);
  const Answer answer = Ask(made.measurement, number, options.probability,
                            FieldSeed(options, kind, number), false, ModeOf(options));
  constexpr double kFloor = 0.25;  // % of Isc; a shorted group is invisible to it
  const bool material = made.misfit > kFloor || kind == "bypass_short";
  Outcomes outcomes = OutcomesOf(made.truth.accepted, material, answer);
  outcomes.row = RowOf(kind, number, made.misfit, answer, outcomes);
  return outcomes;
}

struct RealSweep {
  std::string name;
  std::vector<std::string> accepted;
};

// Those labelled "clean" and "fault" in labels.csv of a folder.
std::vector<RealSweep> RealSweeps(const std::string& folder) {
  std::ifstream file(folder + "/labels.csv");
  std::vector<RealSweep> sweeps;
  std::string line, label, names, name;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    RealSweep sweep;
    std::getline(fields, sweep.name, ',');
    std::getline(fields, label, ',');
    std::getline(fields, names, ',');
    std::istringstream words(names);
    while (words >> name) sweep.accepted.push_back(name);
    if (label == "clean" || label == "fault") sweeps.push_back(sweep);
  }
  return sweeps;
}

// Shares by tenths of the stated probability.
void Print(const char* world, const char* what, const std::vector<Outcome>& outcomes,
           std::FILE* csv) {
  constexpr int kBins = 10;
  for (int bin = 0; bin < kBins; ++bin) {
    int cases = 0, hits = 0;
    double stated = 0;
    for (const Outcome& outcome : outcomes) {
      const int own = std::min(static_cast<int>(kBins * outcome.stated), kBins - 1);
      if (own != bin) continue;
      ++cases;
      hits += outcome.is_true;
      stated += outcome.stated;
    }
    if (cases == 0) continue;
    const lyrefit::Share share = lyrefit::WilsonInterval(hits, cases);
    std::printf("%-11s %-6s %3d-%-3d %6d %7.1f %7.1f %6.1f to %5.1f\n", world, what, 10 * bin,
                10 * bin + 10, cases, 100 * stated / cases, Percent(hits, cases),
                100 * share.low_95, 100 * share.high_95);
    if (csv == nullptr) continue;
    std::fprintf(csv, "%s,%s,%.1f,%.1f,%d,%.4f,%.4f,%.4f,%.4f\n", world, what, 0.1 * bin,
                 0.1 * bin + 0.1, cases, stated / cases, static_cast<double>(hits) / cases,
                 share.low_95, share.high_95);
  }
}

}  // namespace

int StudyCalibration(const StudyOptions& options) {
  StudyOptions asked = options;
  asked.probability = 0.5;  // the least that can be asked for: names of all probabilities above it
  const bool real = !options.real.empty();
  const std::vector<RealSweep> sweeps = real ? RealSweeps(options.real) : std::vector<RealSweep>();
  const int cases = real                ? static_cast<int>(sweeps.size())
                    : options.cases > 0 ? options.cases
                                        : 2000;
  if (cases == 0) return std::fprintf(stderr, "no labels.csv in %s\n", options.real.c_str()), 1;
  const char* world = real ? "real" : ModeOf(options) == Mode::kField ? "field" : "laboratory";
  std::vector<Outcomes> outcomes(cases);
  ForEach(cases, options.threads, [&](int i) {
    if (real) {
      const Answer answer =
          AskFile(options.real + "/" + sweeps[i].name + ".csv", asked.probability);
      outcomes[i] = OutcomesOf(sweeps[i].accepted, true, answer);
      outcomes[i].row = RowOf(sweeps[i].name, i, 0, answer, outcomes[i]);
    } else {
      outcomes[i] =
          ModeOf(options) == Mode::kField ? FieldOutcomes(asked, i) : LaboratoryOutcomes(asked, i);
    }
  });
  std::vector<Outcome> all, named;
  std::FILE* rows = options.rows.empty() ? nullptr : std::fopen(options.rows.c_str(), "w");
  if (rows != nullptr) std::fputs("kind,number,misfit,none,named,right,answer\n", rows);
  for (const Outcomes& own : outcomes) {
    all.insert(all.end(), own.all.begin(), own.all.end());
    named.insert(named.end(), own.named.begin(), own.named.end());
    if (rows != nullptr) std::fputs(own.row.c_str(), rows);
  }
  if (rows != nullptr) std::fclose(rows);
  std::FILE* csv = options.csv.empty() ? nullptr : std::fopen(options.csv.c_str(), "w");
  if (csv == nullptr && !options.csv.empty()) return std::perror(options.csv.c_str()), 1;
  if (csv != nullptr) std::fputs("world,what,from,to,cases,stated,true,low_95,high_95\n", csv);
  std::printf("%-11s %-6s %-7s %6s %7s %7s %15s\n", "world", "of", "bin %", "cases", "stated%",
              "true%", "95 %");
  Print(world, "all", all, csv);
  Print(world, "named", named, csv);
  if (csv != nullptr) std::fclose(csv);
  return 0;
}

}  // namespace faults
