// Repeats the published tables and writes the pages of results.
//
//   lyrefit_paper data/paper --update README.md
//   lyrefit_paper data/paper --out page --batches 2 --peers ""
//   lyrefit_paper data/paper --only pwp201

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/file.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/study/algorithms.h"
#include "lyrefit/study/report/documents.h"
#include "pagmo_searcher.h"
#include "paper/budget_figure.h"
#include "paper/corner_page.h"
#include "paper/corner_study.h"
#include "paper/held_tables.h"
#include "paper/page_blocks.h"
#include "paper/paper_flags.h"
#include "paper/paper_page.h"
#include "paper/paper_study.h"
#include "paper/proof_blocks.h"
#include "paper/sound_page.h"
#include "studies/watch.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

// Adds the algorithms of pagmo2 in `list`; adds none in a build without pagmo2.
Expected<void> AddPeers(const std::string& list, PaperStudyOptions* options) {
  if (list.empty() || PagmoNames().empty()) return {};
  SearchOptions search;
  search.population = options->population;
  search.iterations = options->iterations;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    TRY(ComparedAlgorithm peer, PagmoAlgorithm(list.substr(begin, end - begin), search));
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

// Updates the marked blocks of other pages; `with` inserts the blocks of a study into a page.
template <class Study>
Expected<void> Update(const Study& study, std::string (*with)(std::string, const Study&),
                      const std::vector<std::string>& pages) {
  constexpr std::uintmax_t kLargestPage = 1U << 22;
  for (const std::string& page : pages) {
    TRY(const std::string text, ReadTextFile(page, kLargestPage));
    TRY(WriteTextFile(page, with(text, study)));
  }
  return {};
}

Expected<void> Write(const PaperStudy& study, const std::map<std::string, std::string>& remarks,
                     const PaperArguments& arguments) {
  const fs::path output(arguments.output);
  for (const Picture& picture : kPictures) {
    TRY(picture.draw(study.*picture.comparison, (output / picture.file).string()));
  }
  TRY(Update(study, WithTables, arguments.pages));
  return WriteTextFile((output / "README.md").string(), PaperPage(study, remarks));
}

// Options with CMA-ES of pagmo2 at every budget; without it in a build without pagmo2.
Expected<CornerOptions> CornerOptionsOf(const PaperStudyOptions& options) {
  CornerOptions corner;
  corner.seed = options.seed;
  corner.runs = options.corner_runs;
  corner.threads = options.threads;
  corner.journal = options.journal;
  corner.budgets.clear();
  std::int64_t budget = 100;
  for (int i = 0; i < options.corner_budgets; ++i) corner.budgets.push_back(budget *= 10);
  if (PagmoNames().empty()) return corner;
  for (const std::int64_t evaluations : corner.budgets) {
    TRY(ComparedAlgorithm peer, PagmoAlgorithm("cmaes", BudgetSearch(evaluations)));
    peer.algorithm = peer.name;
    peer.name += fmt::format("@{}", evaluations);
    corner.peers.push_back(std::move(peer));
  }
  return corner;
}

constexpr int kExitViolated = 2;  // a bound lies above a reached RMSE

int SayInterrupted(const PaperArguments& arguments) {
  fmt::print(stderr, "interrupted; nothing is written, {}\n",
             arguments.options.journal.empty() ? "and nothing kept without --resume FILE"
                                               : "the same command goes on where it stopped");
  return kExitInterrupted;
}

Expected<int> RunPaper(const PaperArguments& arguments) {
  TRY(const auto remarks, ReadRemarks((fs::path(arguments.folder) / "remarks.csv").string()));
  for (const Picture& picture : kPictures) {
    TRY(CheckPlot((fs::path(arguments.output) / picture.file).string()));
  }
  TRY(const PaperStudy study, ReproducePaper(arguments.folder, arguments.options, Watch));
  for (const std::string& remark : study.remarks) fmt::print(stderr, "{}\n", remark);
  if (study.interrupted) return SayInterrupted(arguments);
  TRY(Write(study, remarks, arguments));
  fmt::print("written: {} ({:.0f} s)\n", (fs::path(arguments.output) / "README.md").string(),
             study.seconds);
  return 0;
}

Expected<int> RunCorner(const PaperArguments& arguments) {
  const fs::path output(arguments.output);
  const std::string picture = (output / "pwp201.svg").string();
  const std::string page = (output / "pwp201.md").string();
  TRY(CheckPlot(picture));
  const fs::path curve = (fs::path(arguments.folder) / ".." / "pwp201").lexically_normal();
  TRY(const CornerOptions options, CornerOptionsOf(arguments.options));
  TRY(const CornerStudy study, StudyCorner(curve.string(), "literature", options, Watch));
  for (const std::string& remark : study.comparison.remarks) fmt::print(stderr, "{}\n", remark);
  if (study.interrupted) return SayInterrupted(arguments);
  TRY(DrawFigure(CornerFigure(study), picture));
  TRY(WriteTextFile(page, CornerPage(study)));
  fmt::print("written: {} ({:.0f} s)\n", page, study.comparison.seconds);
  return 0;
}

Expected<int> RunProofs(const PaperArguments& arguments) {
  const Instant begin = Now();
  const std::string curves = (fs::path(arguments.folder) / "..").lexically_normal().string();
  const PaperStudyOptions& asked = arguments.options;
  TRY(const ProofTable proofs, ProveShipped(curves, asked.proof_effort, asked.threads, Watch));
  if (proofs.interrupted) return SayInterrupted(arguments);
  TRY(Update(proofs, WithProofs, arguments.pages));
  fmt::print("proved: {} bounds ({:.0f} s)\n", proofs.rows.size(), SecondsSince(begin));
  return 0;
}

Expected<int> RunSound(const PaperArguments& arguments) {
  SoundOptions options;
  options.problems = arguments.options.sound_problems;
  options.seed = arguments.options.seed;
  options.effort = arguments.options.sound_effort;
  options.threads = arguments.options.threads;
  TRY(const SoundStudy made, StudySynthetic(options, Watch));
  if (made.interrupted) return SayInterrupted(arguments);
  if (!arguments.measured.empty()) {
    TRY(const SoundStudy measured, StudyMeasured(arguments.measured, options, Watch));
    if (measured.interrupted) return SayInterrupted(arguments);
    TRY(Update(measured, WithMeasured, arguments.pages));
  }
  const std::string page = (fs::path(arguments.output) / "sound.md").string();
  TRY(WriteTextFile(page, SoundPage(made)));
  fmt::print("written: {} ({:.0f} s)\n", page, made.seconds);
  return Violations(made) == 0 ? 0 : kExitViolated;
}

// Runs only if a page to update or this part is given, as the result is a block of another page.
Expected<int> RunWide(const PaperArguments& arguments) {
  if (arguments.only.empty() && arguments.pages.empty()) return 0;
  SoundOptions options;
  options.problems = arguments.options.wide_problems;
  options.seed = arguments.options.seed;
  options.threads = arguments.options.threads;
  TRY(const SoundStudy wide, StudyWide(options, Watch));
  if (wide.interrupted) return SayInterrupted(arguments);
  TRY(Update(wide, WithWide, arguments.pages));
  fmt::print("wide ranges of Rs: {} bounds, {} violated ({:.0f} s)\n", BoundsHeld(wide),
             Violations(wide), wide.seconds);
  return Violations(wide) == 0 ? 0 : kExitViolated;
}

Expected<int> Run(const std::vector<std::string>& words) {
  TRY(PaperArguments arguments, ReadArguments(words));
  TRY(AddPeers(arguments.peers, &arguments.options));
  WatchSignals();
  const struct {
    const char* name;
    Expected<int> (*run)(const PaperArguments&);
  } pages[] = {{"readme", RunPaper},
               {"pwp201", RunCorner},
               {"proofs", RunProofs},
               {"sound", RunSound},
               {"wide", RunWide}};
  for (const auto& page : pages) {
    if (!arguments.only.empty() && arguments.only != page.name) continue;
    TRY(const int code, page.run(arguments));
    if (code != 0) return code;
  }
  return 0;
}

}  // namespace
}  // namespace lyrefit

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty() || words[0] == "--help") {
    fmt::print("{}", lyrefit::PaperUsage());
    return words.empty() ? 1 : 0;
  }
  const auto code = lyrefit::Run(words);
  if (code) return *code;
  fmt::print(stderr, "lyrefit_paper: {}\n", code.error().ToString());
  return 1;
}
