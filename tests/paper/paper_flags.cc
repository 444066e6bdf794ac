#include "paper/paper_flags.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/try.h"

namespace lyrefit {
namespace {

constexpr char kUsage[] =
    "Usage: lyrefit_paper FOLDER [flags]\n"
    "\n"
    "FOLDER holds published.csv, rows.csv and remarks.csv; "
    "the curves lie in the folders beside it.\n"
    "Takes minutes. Writes README.md, pwp201.md, sound.md and their pictures.\n"
    "\n"
    "  --out DIR        folder to write into (default FOLDER)\n"
    "  --update FILE    a page whose blocks, between <!-- NAME --> and <!-- end of NAME -->, are\n"
    "                   written anew: certified, ranked, budget, proofs, proofs-short,\n"
    "                   proofs-measured, proofs-wide; once for each\n"
    "  --resume FILE    a journal: every finished run is added to it, and none "
    "that stands in it is\n"
    "                   done again; begun where there is none\n"
    "  --only NAME      readme, pwp201, proofs, sound or wide: that part alone\n"
    "  --measured DIR   a folder of measured curves and their labels.csv, for proofs-measured\n"
    "  --peers LIST     pagmo2 algorithms to rank as well\n"
    "                   (default de1220,sade,cmaes,pso,gwo,bee_colony)\n"
    "  --seed N         seed of every run\n";

struct NumberFlag {
  const char* name;
  const char* doc;
  int PaperStudyOptions::*field;
  int lower;
  int upper;
};

constexpr NumberFlag kNumberFlags[] = {
    {"--population", "candidates of every search; the paper's 100", &PaperStudyOptions::population,
     10, 10000},
    {"--iterations", "iterations of every search; the paper's 1000", &PaperStudyOptions::iterations,
     1, 1000000},
    {"--batch", "runs behind each figure of the paper", &PaperStudyOptions::batch, 2, 1000000},
    {"--batches", "batches that say how far chance carries", &PaperStudyOptions::batches, 2, 10000},
    {"--sensitivity-batches", "the same for the grid of Pm and gamma and for the S75",
     &PaperStudyOptions::sensitivity_batches, 2, 10000},
    {"--ranked-runs", "runs of each algorithm that is ranked", &PaperStudyOptions::ranked_runs, 2,
     1000000},
    {"--budget-runs", "runs of each algorithm at each budget", &PaperStudyOptions::budget_runs, 1,
     1000000},
    {"--pwp201-runs", "runs of each search at each budget on PWP201",
     &PaperStudyOptions::corner_runs, 1, 1000000},
    {"--pwp201-budgets", "budgets there: 1000, 10000, ..., so many",
     &PaperStudyOptions::corner_budgets, 1, 5},
    {"--sound-problems", "made problems whose certificates are held against what is known",
     &PaperStudyOptions::sound_problems, 1, 1000000},
    {"--sound-effort", "convex problems for each of these proofs", &PaperStudyOptions::sound_effort,
     10, 1000000},
    {"--wide-problems", "made problems with wide ranges of Rs, for proofs-wide",
     &PaperStudyOptions::wide_problems, 1, 1000000},
    {"--proof-effort", "convex problems for each proof of a shipped curve",
     &PaperStudyOptions::proof_effort, 10, 1000000},
    {"--threads", "0: all cores; never changes a result but the seconds",
     &PaperStudyOptions::threads, 0, 1024},
};

Expected<double> WholeNumber(const std::string& flag, const std::string& text, double lower,
                             double upper) {
  const auto value = ParseNumber(text);
  if (!value || *value != std::floor(*value) || *value < lower || *value > upper) {
    return Fail(fmt::format("{}: expected a whole number from {:.0f} to {:.0f}, found '{}'", flag,
                            lower, upper, text));
  }
  return *value;
}

Expected<void> TakeFlag(const std::string& flag, const std::string& text,
                        PaperArguments* arguments) {
  constexpr double kLargestSeed = 9007199254740992;  // 2^53; above it doubles skip integers
  if (flag == "--out") {
    arguments->output = text;
  } else if (flag == "--update") {
    arguments->pages.push_back(text);
  } else if (flag == "--resume") {
    arguments->options.journal = text;
  } else if (flag == "--only") {
    constexpr const char* kParts[] = {"readme", "pwp201", "proofs", "sound", "wide"};
    if (std::find(std::begin(kParts), std::end(kParts), text) == std::end(kParts)) {
      return Fail(
          fmt::format("--only: expected readme, pwp201, proofs, sound or wide, found '{}'", text));
    }
    arguments->only = text;
  } else if (flag == "--measured") {
    arguments->measured = text;
  } else if (flag == "--peers") {
    arguments->peers = text;
  } else if (flag == "--seed") {
    TRY(const double seed, WholeNumber(flag, text, 0, kLargestSeed));
    arguments->options.seed = static_cast<std::uint64_t>(seed);
  } else {
    const auto* known = std::find_if(std::begin(kNumberFlags), std::end(kNumberFlags),
                                     [&](const NumberFlag& one) { return flag == one.name; });
    if (known == std::end(kNumberFlags)) return Fail("unknown flag " + flag);
    TRY(const double value, WholeNumber(flag, text, known->lower, known->upper));
    arguments->options.*known->field = static_cast<int>(value);
  }
  return {};
}

}  // namespace

Expected<PaperArguments> ReadArguments(const std::vector<std::string>& words) {
  PaperArguments arguments;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i].rfind("--", 0) == 0) {
      if (i + 1 == words.size()) return Fail(words[i] + ": expected a value behind it");
      TRY(TakeFlag(words[i], words[i + 1], &arguments));
      ++i;
    } else if (arguments.folder.empty()) {
      arguments.folder = words[i];
    } else {
      return Fail("expected one folder, found '" + words[i] + "' as well");
    }
  }
  if (arguments.folder.empty()) return Fail("expected the paper's folder");
  if (arguments.output.empty()) arguments.output = arguments.folder;
  return arguments;
}

std::string PaperUsage() {
  std::string text = kUsage;
  for (const NumberFlag& flag : kNumberFlags) {
    text += fmt::format("  {:<22} {} ({} to {})\n", flag.name, flag.doc, flag.lower, flag.upper);
  }
  return text;
}

}  // namespace lyrefit
