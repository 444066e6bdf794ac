#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/certify/certify.h"
#include "lyrefit/study/audit.h"
#include "lyrefit/study/comparison.h"
#include "paper/published.h"

namespace lyrefit {

// Allowed ranges: see the flags in paper_flags.cc.
struct PaperStudyOptions {
  std::uint64_t seed = 0;
  int population = 100;  // population and iterations are those of the paper
  int iterations = 1000;
  int batch = 50;    // runs per printed value, as in the paper
  int batches = 10;  // number of batches, which show the random variation between batches
  int sensitivity_batches = 5;
  int ranked_runs = 30;  // of each ranked algorithm, as in the paper
  int budget_runs = 50;
  // For the page about PWP201, a separate study (corner_study.h).
  int corner_runs = 30;
  int corner_budgets = 4;  // 1000, 10000, ... evaluations
  // For the proofs (proof_table.h, sound_study.h).
  int sound_problems = 1000;
  int sound_effort = 1000;
  int wide_problems = 100;
  int proof_effort = 10000;
  std::vector<ComparedAlgorithm> peers;  // further algorithms to rank, of another library
  int threads = 0;
  // Every finished run is written to this file, and the study resumes from it; empty: none.
  std::string journal;
};

// A single search with no other work on the machine, as in Table 9.
struct TimedSearch {
  std::string algorithm;
  std::int64_t evaluations = 0;
  double seconds = 0;    // median of five searches
  double memory_MB = 0;  // peak resident memory of the process so far; 0: unknown
};

// Repetition of all results from repeated runs in the modified-lyrebird paper (J. Ind. Manag.
// Optim. 22(1), 642-690), and further results that the paper does not report.
struct PaperStudy {
  std::string version;
  PaperStudyOptions options;
  Comparison msx60;        // Tables 3, 5, 7; Figs. 5, 6, 9, 10, 13, 14: LO and MLO at 75 C, as in
                           // the paper
  Comparison rtc_france;   // Tables 10 to 12 and 16, Fig. 24: LO, MLO and the intermediate variants
  Comparison sensitivity;  // Tables 17 and 18
  Comparison ranked;       // Tables 13 to 15, Fig. 21: all algorithms
  Comparison budget;       // success rate over evaluations, with three variants of the polish
  Comparison s75;          // Tables 19 and 20: LO and MLO, single-diode model, constructed family
  std::vector<TimedSearch> timed;       // Table 9
  std::vector<PublishedValue> machine;  // printed values of Table 9
  std::vector<CheckedValue> values;     // printed statistics with the computed ones
  // Tables 19 and 20. The computed values belong to other measurement points than the printed ones,
  // so any agreement is a coincidence and `check` has no meaning.
  std::vector<CheckedValue> s75_values;
  AuditReport audit;                      // printed parameters
  std::vector<Certificate> certificates;  // every curve, n in [1, 2] and in [0.5, 4]
  double seconds = 0;
  bool interrupted = false;
  std::vector<std::string> remarks;  // remarks on the journal, as sentences
};

// Runs all studies; takes minutes. Reads `folder` (published.csv and rows.csv) and the curves in
// the folders beside it. An interrupted study returns only `interrupted` and `remarks`, as
// incomplete tables must not replace complete ones. Errors: files missing or malformed, options
// outside their ranges, a journal of another study.
Expected<PaperStudy> ReproducePaper(const std::string& folder,
                                    const PaperStudyOptions& options = {},
                                    const Observer& observer = {});

}  // namespace lyrefit
