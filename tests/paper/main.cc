// Does the published tables over again and writes the page of results.
//
//   lyrefit_paper data/paper --update README.md
//   lyrefit_paper data/paper --out page --batches 2 --peers ""

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/curve/number_text.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/study/report/compare_plot.h"
#include "pagmo_searcher.h"
#include "paper/page_blocks.h"
#include "paper/paper_page.h"
#include "paper/paper_study.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

constexpr char kUsage[] =
    "Usage: lyrefit_paper FOLDER [flags]\n"
    "\n"
    "FOLDER holds published.csv, rows.csv and remarks.csv; "
    "the curves lie in the folders beside it.\n"
    "Takes minutes. Writes README.md and its pictures.\n"
    "\n"
    "  --out DIR        folder to write into (default FOLDER)\n"
    "  --update FILE    a page whose blocks <!-- certified -->, <!-- ranked --> and "
    "<!-- budget -->\n"
    "                   are written anew; once for each\n"
    "  --resume FILE    a journal: every finished run is added to it, and none "
    "that stands in it is\n"
    "                   done again; begun where there is none\n"
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
    {"--population", "birds of every search; the paper's 100", &PaperStudyOptions::population, 10,
     10000},
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
    {"--threads", "0: all cores; never changes a result but the seconds",
     &PaperStudyOptions::threads, 0, 1024},
};

struct Arguments {
  std::string folder;
  std::string output;  // empty: the folder
  std::vector<std::string> pages;
  std::string peers = "de1220,sade,cmaes,pso,gwo,bee_colony";
  PaperStudyOptions options;
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

Expected<void> TakeFlag(const std::string& flag, const std::string& text, Arguments* arguments) {
  constexpr double kLargestSeed = 9007199254740992;  // beyond it doubles skip whole numbers
  if (flag == "--out") {
    arguments->output = text;
  } else if (flag == "--update") {
    arguments->pages.push_back(text);
  } else if (flag == "--resume") {
    arguments->options.journal = text;
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

Expected<Arguments> ReadArguments(const std::vector<std::string>& words) {
  Arguments arguments;
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

// pagmo2's algorithms of a list; none in a build without them.
Expected<void> AddPeers(const std::string& list, PaperStudyOptions* options) {
  if (list.empty() || PagmoNames().empty()) return {};
  SearchOptions search;
  search.population = options->population;
  search.iterations = options->iterations;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    TRY(Contender peer, PagmoContender(list.substr(begin, end - begin), search));
    options->peers.push_back(std::move(peer));
    begin = end + 1;
  }
  return {};
}

struct Picture {
  const char* file;
  Expected<void> (*draw)(const Comparison&, const std::string&);
  Comparison PaperStudy::*comparison;
};

constexpr Picture kPictures[] = {
    {"msx60.svg", PlotBoxes, &PaperStudy::msx60},
    {"msx60-convergence.svg", PlotConvergence, &PaperStudy::msx60},
    {"rtc_france-convergence.svg", PlotConvergence, &PaperStudy::rtc_france},
    {"ranked.svg", PlotBoxes, &PaperStudy::ranked},
    {"ranked-convergence.svg", PlotConvergence, &PaperStudy::ranked},
    {"budget.svg", PlotBudget, &PaperStudy::budget},
};

// The tables of the study that other pages show between marks.
Expected<void> Update(const PaperStudy& study, const std::string& page) {
  constexpr std::uintmax_t kLargestPage = 1U << 22;
  TRY(const std::string text, ReadTextFile(page, kLargestPage));
  return WriteTextFile(page, WithTables(text, study));
}

Expected<void> Write(const PaperStudy& study, const std::map<std::string, std::string>& remarks,
                     const Arguments& arguments) {
  const fs::path output(arguments.output);
  for (const Picture& picture : kPictures) {
    TRY(picture.draw(study.*picture.comparison, (output / picture.file).string()));
  }
  for (const std::string& page : arguments.pages) TRY(Update(study, page));
  return WriteTextFile((output / "README.md").string(), PaperPage(study, remarks));
}

volatile std::sig_atomic_t interrupted = 0;

// The first one asks to stop, a second one ends the program.
void OnInterrupt(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

// On a terminal one changing line.
ObserverAction Watch(const Progress& progress) {
  if (isatty(STDERR_FILENO) != 0 && progress.iterations > 0) {
    fmt::print(stderr, "\r{:<20}{:>8} of {:<8}", progress.stage, progress.iteration,
               progress.iterations);
  }
  return interrupted != 0 ? ObserverAction::kStop : ObserverAction::kContinue;
}

constexpr int kExitInterrupted = 130;

Expected<int> Run(const std::vector<std::string>& words) {
  TRY(Arguments arguments, ReadArguments(words));
  TRY(AddPeers(arguments.peers, &arguments.options));
  TRY(const auto remarks, ReadRemarks((fs::path(arguments.folder) / "remarks.csv").string()));
  for (const Picture& picture : kPictures) {
    TRY(CheckPlot((fs::path(arguments.output) / picture.file).string()));
  }
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, OnInterrupt);
  TRY(const PaperStudy study, ReproducePaper(arguments.folder, arguments.options, Watch));
  for (const std::string& remark : study.remarks) fmt::print(stderr, "{}\n", remark);
  if (study.interrupted) {
    fmt::print(stderr, "interrupted; nothing is written, {}\n",
               arguments.options.journal.empty() ? "and nothing kept without --resume FILE"
                                                 : "the same command goes on where it stopped");
    return kExitInterrupted;
  }
  TRY(Write(study, remarks, arguments));
  fmt::print("written: {} ({:.0f} s)\n", (fs::path(arguments.output) / "README.md").string(),
             study.seconds);
  return 0;
}

}  // namespace
}  // namespace lyrefit

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty() || words[0] == "--help") {
    fmt::print("{}", lyrefit::kUsage);
    for (const auto& flag : lyrefit::kNumberFlags) {
      fmt::print("  {:<22} {} ({} to {})\n", flag.name, flag.doc, flag.lower, flag.upper);
    }
    return words.empty() ? 1 : 0;
  }
  const auto code = lyrefit::Run(words);
  if (code) return *code;
  fmt::print(stderr, "lyrefit_paper: {}\n", code.error().ToString());
  return 1;
}
