#include <fmt/format.h>

#include <filesystem>

#include "flags.h"
#include "interrupt.h"
#include "lyrefit/base/file.h"
#include "lyrefit/base/try.h"
#include "lyrefit/report/compare_plot.h"
#include "lyrefit/report/markdown.h"
#include "lyrefit/report/paper_page.h"
#include "lyrefit/report/plot.h"
#include "lyrefit/study/paper_study.h"
#include "pagmo_searcher.h"
#include "study_flags.h"
#include "verbs.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

constexpr char kReproduceFooter[] =
    "Examples:\n"
    "  lyrefit reproduce data/paper\n"
    "  lyrefit reproduce data/paper --out /tmp/page --batches 2 --peers \"\"\n"
    "\n"
    "FOLDER holds published.csv, rows.csv and remarks.csv; the curves lie in the folders beside "
    "it.\n"
    "Takes minutes. Writes README.md and its pictures.";

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
  std::string updated = ReplaceBlock(text, "certified", CertifiedTable(study));
  updated = ReplaceBlock(updated, "ranked", RankedTable(study));
  updated = ReplaceBlock(updated, "budget", BudgetSummary(study));
  return WriteTextFile(page, updated);
}

struct ReproduceRequest {
  PaperStudyOptions options;
  std::string folder;
  std::string output;
  std::string peers = "de1220,sade,cmaes,pso,gwo,bee_colony";
  std::vector<std::string> pages;
};

void DeclareReproduce(VerbLine* verb, ReproduceRequest* request) {
  verb->AddOption("FOLDER", &request->folder, "published.csv, rows.csv, remarks.csv")
      .Required()
      .Reads();
  AddTableFlags(verb, kPaperStudyOptionTable, &request->options);
  AddResumeFlag(verb, "run", &request->options.journal);
  verb->AddOption("--peers", &request->peers,
                  "pagmo2 algorithms to rank as well (default " + request->peers + ")")
      .Type("LIST")
      .Group("Runs");
  verb->AddOption("--out", &request->output, "folder to write into (default FOLDER)")
      .Type("DIR")
      .Group("Output");
  verb->AddOption("--update", &request->pages,
                  "a page whose blocks <!-- certified -->, <!-- ranked --> and <!-- budget --> are "
                  "written anew; once for each")
      .OneEach()
      .Type("FILE")
      .Group("Output");
  verb->AddQuietSwitch();
}

Expected<std::vector<Contender>> Peers(const ReproduceRequest& request) {
  std::vector<Contender> peers;
  if (request.peers.empty() || PagmoNames().empty()) return peers;
  TRY(const auto names, ParseList("--peers", request.peers));
  SearchOptions search;
  search.population = request.options.population;
  search.iterations = request.options.iterations;
  for (const std::string& name : names) {
    TRY(Contender peer, PagmoContender(name, search));
    peers.push_back(std::move(peer));
  }
  return peers;
}

Expected<void> CheckTargets(VerbLine* verb, const fs::path& output) {
  verb->AlsoWrites("--out", (output / "README.md").string());
  for (const Picture& picture : kPictures) {
    const std::string path = (output / picture.file).string();
    TRY(CheckPlot(path));
    verb->AlsoWrites("--out", path);
  }
  return verb->CheckFiles();
}

Expected<void> Write(const ReproduceRequest& request, const fs::path& output,
                     const PaperStudy& study) {
  TRY(const auto remarks, ReadRemarks((fs::path(request.folder) / "remarks.csv").string()));
  for (const Picture& picture : kPictures) {
    TRY(picture.draw(study.*picture.comparison, (output / picture.file).string()));
  }
  for (const std::string& page : request.pages) TRY(Update(study, page));
  return WriteTextFile((output / "README.md").string(), PaperPage(study, remarks));
}

Expected<int> RunReproduce(VerbLine& verb, ReproduceRequest& request) {
  const fs::path output(request.output.empty() ? request.folder : request.output);
  const std::string& journal = request.options.journal;
  TRY(request.options.peers, Peers(request));
  TRY(ReadRemarks((fs::path(request.folder) / "remarks.csv").string()));
  TRY(CheckTargets(&verb, output));
  const InterruptGuard guard;
  const std::string kept = journal.empty() ? "Ctrl-C loses what is done; --resume FILE keeps it"
                                           : "Ctrl-C keeps what is done in " + journal;
  TRY(const PaperStudy study,
      ReproducePaper(request.folder, request.options, TerminalObserver({"", kept})));
  PrintRemarks(study.remarks);
  if (study.interrupted) {
    PrintRemarks({journal.empty()
                      ? "interrupted; nothing is written, and nothing kept without --resume FILE"
                      : "interrupted; nothing is written, the same command goes on where it "
                        "stopped"});
    return kExitInterrupted;
  }
  TRY(Write(request, output, study));
  TRY(WriteText(verb, [&] {
    return fmt::format("written: {} ({:.0f} s)\n", (output / "README.md").string(), study.seconds);
  }));
  return kExitFine;
}

}  // namespace

const Verb kReproduceVerb = {
    "reproduce", "Do the published tables over again and write the page of results",
    kReproduceFooter, "README.md and its pictures into the folder of --out",
    Declare<ReproduceRequest, DeclareReproduce, RunReproduce>};

}  // namespace lyrefit
