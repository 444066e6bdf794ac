#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/certify/certify.h"
#include "lyrefit/study/audit_report.h"
#include "lyrefit/study/comparison.h"
#include "paper/published.h"

namespace lyrefit {

// Ranges: see the flags in main.cc.
struct PaperStudyOptions {
  std::uint64_t seed = 0;
  int population = 100;  // as the paper has it, and so the iterations
  int iterations = 1000;
  int batch = 50;    // runs behind each figure of the paper
  int batches = 10;  // batches of ours that say how far chance carries
  int sensitivity_batches = 5;
  int ranked_runs = 30;  // of each algorithm where algorithms are ranked, as in the paper
  int budget_runs = 50;
  // Of the page about PWP201, which is a study of its own (corner_study.h).
  int corner_runs = 30;
  int corner_budgets = 4;  // 1000, 10000, ... evaluations
  // Of what is proved (proof_table.h, sound_study.h).
  int sound_problems = 1000;
  int sound_effort = 1000;
  int wide_problems = 100;
  int proof_effort = 10000;
  std::vector<ComparedAlgorithm> peers;  // further algorithms to rank, of another library
  int threads = 0;
  // A file that every finished run is written to, and that the study is taken up from; empty: none.
  std::string journal;
};

// One search alone on the machine, as Table 9 has it.
struct TimedSearch {
  std::string algorithm;
  std::int64_t evaluations = 0;
  double seconds = 0;    // median of five
  double memory_MB = 0;  // largest resident size of the whole process so far; 0: not known
};

// Everything that the modified-lyrebird paper (J. Ind. Manag. Optim. 22(1), 642-690) reports of
// repeated runs, done again, and what it does not report.
struct PaperStudy {
  std::string version;
  PaperStudyOptions options;
  Comparison msx60;        // Tables 3, 5, 7; Figs. 5, 6, 9, 10, 13, 14: LO and MLO as the paper ran
                           // them, at 75 C
  Comparison rtc_france;   // Tables 10 to 12 and 16, Fig. 24: LO, MLO and the variants between
  Comparison sensitivity;  // Tables 17 and 18
  Comparison ranked;       // Tables 13 to 15, Fig. 21: all algorithms there are
  Comparison budget;       // success against evaluations, with three kinds of polish
  Comparison s75;          // Tables 19 and 20: LO and MLO with one diode, on the constructed family
  std::vector<TimedSearch> timed;       // Table 9
  std::vector<PublishedValue> machine;  // what the paper prints of Table 9
  std::vector<CheckedValue> values;     // printed statistics beside ours
  // Tables 19 and 20 beside ours, which are of other points: agreement would be a coincidence, and
  // `check` means nothing.
  std::vector<CheckedValue> s75_values;
  AuditReport audit;                      // printed parameters
  std::vector<Certificate> certificates;  // every curve, n in [1, 2] and in [0.5, 4]
  double seconds = 0;
  bool interrupted = false;
  std::vector<std::string> remarks;  // on the journal, in plain sentences
};

// Reads `folder` (published.csv and rows.csv, the curves in the folders beside it) and runs all
// studies; takes minutes. Interrupted, it holds nothing but `interrupted` and `remarks`: half the
// tables would replace whole ones. Errors: files missing or malformed, options outside their
// ranges, a journal of another study.
Expected<PaperStudy> ReproducePaper(const std::string& folder,
                                    const PaperStudyOptions& options = {},
                                    const Observer& observer = {});

}  // namespace lyrefit
