#include "reproduce_command.h"

#include <fmt/format.h>

#include <filesystem>

#include "flags.h"
#include "interrupt.h"
#include "lyrefit/base/file.h"
#include "lyrefit/report/compare_plot.h"
#include "lyrefit/report/markdown.h"
#include "lyrefit/report/paper_page.h"
#include "lyrefit/report/plot.h"
#include "output.h"
#include "pagmo_searcher.h"
#include "study_flags.h"

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
  const auto text = ReadTextFile(page, kLargestPage);
  if (!text) return tl::unexpected(text.error());
  std::string updated = ReplaceBlock(*text, "certified", CertifiedTable(study));
  updated = ReplaceBlock(updated, "ranked", RankedTable(study));
  updated = ReplaceBlock(updated, "budget", BudgetSummary(study));
  return WriteTextFile(page, updated);
}

}  // namespace

ReproduceCommand::ReproduceCommand(CommandLine* line)
    : verb_(line->AddVerb("reproduce",
                          "Do the published tables over again and write the page of results")) {
  verb_->AddOption("FOLDER", &folder_, "published.csv, rows.csv, remarks.csv").Required().Reads();
  AddTableFlags(verb_, kPaperStudyOptionTable, "Runs", &options_);
  verb_
      ->AddOption("--threads", &options_.threads,
                  "0: all cores; never changes a result but the seconds (default 0)")
      .Between(0, 1024)
      .Type("N")
      .Group("Runs");
  AddResumeFlag(verb_, "run", &options_.journal);
  verb_->AddOption("--peers", &peers_, "pagmo2 algorithms to rank as well (default " + peers_ + ")")
      .Type("LIST")
      .Group("Runs");
  verb_->AddOption("--out", &output_, "folder to write into (default FOLDER)")
      .Type("DIR")
      .Group("Output");
  AddListFlag(verb_, "--update",
              "a page whose blocks <!-- certified -->, <!-- ranked --> and <!-- budget --> are "
              "written anew; once for each",
              &pages_)
      .Type("FILE")
      .Group("Output");
  verb_->AddQuietSwitch();
  verb_->Footer(kReproduceFooter);
}

Expected<void> ReproduceCommand::AddPeers() {
  if (peers_.empty() || PagmoNames().empty()) return {};
  const auto names = ParseList("--peers", peers_);
  if (!names) return tl::unexpected(names.error());
  SearchOptions search;
  search.population = options_.population;
  search.iterations = options_.iterations;
  for (const std::string& name : *names) {
    auto peer = PagmoContender(name, search);
    if (!peer) return tl::unexpected(peer.error());
    options_.peers.push_back(std::move(*peer));
  }
  return {};
}

Expected<void> ReproduceCommand::Write(const PaperStudy& study) const {
  const auto remarks = ReadRemarks((fs::path(folder_) / "remarks.csv").string());
  if (!remarks) return tl::unexpected(remarks.error());
  const fs::path output(output_);
  for (const Picture& picture : kPictures) {
    auto drawn = picture.draw(study.*picture.comparison, (output / picture.file).string());
    if (!drawn) return drawn;
  }
  for (const std::string& page : pages_) {
    if (auto updated = Update(study, page); !updated) return updated;
  }
  return WriteTextFile((output / "README.md").string(), PaperPage(study, *remarks));
}

int ReproduceCommand::Run() {
  if (output_.empty()) output_ = folder_;
  if (auto peers = AddPeers(); !peers) return Refuse(peers.error());
  const auto remarks = ReadRemarks((fs::path(folder_) / "remarks.csv").string());
  if (!remarks) return Refuse(remarks.error());
  verb_->AlsoWrites("--out", (fs::path(output_) / "README.md").string());
  for (const Picture& picture : kPictures) {
    const std::string path = (fs::path(output_) / picture.file).string();
    if (auto drawable = CheckPlot(path); !drawable) return Refuse(drawable.error());
    verb_->AlsoWrites("--out", path);
  }
  if (auto checked = verb_->CheckFiles(); !checked) return Refuse(checked.error());
  const InterruptGuard guard;
  const std::string kept = options_.journal.empty()
                               ? "Ctrl-C loses what is done; --resume FILE keeps it"
                               : "Ctrl-C keeps what is done in " + options_.journal;
  const auto study = ReproducePaper(folder_, options_, TerminalObserver({"", kept}));
  if (!study) return Refuse(study.error());
  PrintRemarks(study->remarks);
  if (study->interrupted) {
    PrintRemarks(
        {options_.journal.empty()
             ? "interrupted; nothing is written, and nothing kept without --resume FILE"
             : "interrupted; nothing is written, the same command goes on where it stopped"});
    return kExitInterrupted;
  }
  if (auto written = Write(*study); !written) return Refuse(written.error());
  if (!verb_->TextWanted()) return kExitFine;
  const std::string done = fmt::format("written: {} ({:.0f} s)\n",
                                       (fs::path(output_) / "README.md").string(), study->seconds);
  if (auto written = WriteOutput("-", done); !written) return Refuse(written.error());
  return kExitFine;
}

}  // namespace lyrefit
