#include "lyrefit/study/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include "lyrefit/base/parallel.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/version.h"
#include "lyrefit/curve/beyond_voc.h"
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/study/compare_journal.h"
#include "lyrefit/study/compare_run.h"
#include "lyrefit/study/reference.h"
#include "lyrefit/study/summary.h"

namespace lyrefit {
namespace {

// One curve or set with one model, while its runs are in progress.
struct Problem {
  Problem(const CompareCurve& subject_, ProblemResult described, int runs)
      : subject(subject_), outcomes(runs), left(runs), result(std::move(described)) {}

  const CompareCurve& subject;
  // Runs of the first algorithm, then of the second, ...
  std::vector<std::optional<RunOutcome>> outcomes;
  std::atomic<int> left;           // number of unfinished runs
  std::optional<BestKnown> known;  // set if the journal has it
  ProblemResult result;
};

using Problems = std::vector<std::unique_ptr<Problem>>;

Problems MakeProblems(const std::vector<CompareCurve>& curves, const CompareOptions& options,
                      int runs) {
  Problems problems;
  std::set<std::string> names;  // problem names that are taken from curves
  for (const CompareCurve& curve : curves) {
    const bool own = curve.model || curve.set;
    for (const Model model : own ? std::vector<Model>{Model::kSingleDiode} : options.models) {
      ProblemResult described = DescribeProblem(curve, model, options);
      std::string& name = described.problem;
      while (!name.empty() && curve.problem.empty() && !names.insert(name).second) name += "'";
      problems.push_back(std::make_unique<Problem>(curve, std::move(described), runs));
    }
  }
  return problems;
}

// Estimated cost of a run in evaluations of a single-diode model. The polish costs some thousands.
double WorkOf(const Problem& problem, const ComparedAlgorithm& compared) {
  constexpr double kPolish = 3000;
  const double evaluations = static_cast<double>(PlannedEvaluations(compared.search));
  return (evaluations + kPolish) * static_cast<double>(problem.result.model);
}

double WorkOfAll(const Problems& problems, const std::vector<ComparedAlgorithm>& algorithms,
                 int runs) {
  double work = 0;
  for (const auto& problem : problems) {
    for (const ComparedAlgorithm& compared : algorithms) work += runs * WorkOf(*problem, compared);
  }
  return work;
}

// A sentence for each algorithm that spent more than its budget.
std::vector<std::string> OverBudget(const std::vector<ProblemResult>& problems) {
  std::map<std::string, std::pair<std::int64_t, std::int64_t>> most;  // spent and budget, by name
  for (const ProblemResult& problem : problems) {
    for (const AlgorithmResult& compared : problem.algorithms) {
      if (compared.kind != AlgorithmKind::kSearch) continue;
      for (const RunRecord& run : compared.runs) {
        auto& [spent, budget] = most[compared.name];
        budget = PlannedEvaluations(compared.search);
        spent = std::max(spent, run.evaluations);
      }
    }
  }
  std::vector<std::string> sentences;
  for (const auto& [name, figures] : most) {
    const auto& [spent, budget] = figures;
    if (spent <= budget) continue;
    sentences.push_back(fmt::format("{} spent up to {} evaluations in a run, its budget is {}",
                                    name, spent, budget));
  }
  return sentences;
}

// A comparison in progress. Jobs write to separate slots, and the last job of a problem summarises
// it.
class Study {
 public:
  Study(const std::vector<CompareCurve>& curves, const std::vector<ComparedAlgorithm>& algorithms,
        const CompareOptions& options, const Observer& observer)
      : algorithms_(algorithms),
        options_(options),
        runs_per_problem_(static_cast<int>(algorithms.size()) * options.runs),
        problems_(MakeProblems(curves, options, runs_per_problem_)),
        progress_(observer) {
    progress_.BeginSilently("compare", jobs(), WorkOfAll(problems_, algorithms, options.runs));
  }

  // Runs one cheap search for each problem, which returns every error that a fit would return.
  Expected<void> Try() const {
    for (const auto& problem : problems_) {
      const auto tried = TryProblem(problem->subject, problem->result, options_);
      if (!tried) {
        Error error = tried.error();
        error.message =
            fmt::format("{} cannot be compared on {}: {}", ToText(problem->result.model),
                        problem->result.curve_name, error.message);
        return tl::unexpected(std::move(error));
      }
    }
    return {};
  }

  // Resumes from the runs in the journal.
  Expected<void> TakeUp(std::unique_ptr<Journal> journal) {
    journal_ = std::move(journal);
    for (const Journal::Record& record : journal_->records()) {
      if (IsBestKnown(record)) {
        auto known = ReadBestKnown(*journal_, record);
        if (!known) return tl::unexpected(known.error());
        if (known->problem < 0 || known->problem >= static_cast<int>(problems_.size())) {
          return Fail("this record is of no problem of the study", journal_->path(), record.line);
        }
        problems_[known->problem]->known = std::move(known->known);
        continue;
      }
      auto run = ReadRun(*journal_, record);
      if (!run) return tl::unexpected(run.error());
      const RunPlace& at = run->place;
      if (at.run >= options_.runs) continue;  // the journal has more runs than requested
      if (at.problem < 0 || at.problem >= static_cast<int>(problems_.size()) || at.run < 0 ||
          at.algorithm < 0 || at.algorithm >= static_cast<int>(algorithms_.size())) {
        return Fail("this record is of no run of the study", journal_->path(), record.line);
      }
      std::optional<RunOutcome>& slot = SlotOf(at);
      if (slot) continue;
      slot = std::move(run->outcome);
      ++taken_up_;
      progress_.Count(WorkOf(*problems_[at.problem], algorithms_[at.algorithm]));
    }
    return {};
  }

  Expected<Comparison> Run() {
    progress_.Report();
    ParallelFor(jobs(), options_.threads, [this](int job) { RunJob(job); });
    if (failure_) return tl::unexpected(std::move(*failure_));
    Comparison comparison;
    comparison.version = Version();
    comparison.options = options_;
    for (int p = 0; p < static_cast<int>(problems_.size()); ++p) {
      const auto& problem = problems_[p];
      if (problem->left > 0) SumUp(p);
      comparison.interrupted = comparison.interrupted || !problem->result.complete;
      if (problem->result.algorithms.empty()) continue;
      comparison.problems.push_back(std::move(problem->result));
    }
    comparison.over_budget = OverBudget(comparison.problems);
    if (journal_) {
      const bool any = taken_up_ > 0;
      comparison.remarks = JournalRemarks(
          *journal_, any ? fmt::format("{} of {} runs were done before", taken_up_, jobs()) : "");
      comparison.journal_lacks_runs = !journal_->failure().empty();
    }
    comparison.seconds = SecondsSince(begin_);
    return comparison;
  }

 private:
  int jobs() const { return static_cast<int>(problems_.size()) * runs_per_problem_; }

  std::optional<RunOutcome>& SlotOf(const RunPlace& at) {
    return problems_[at.problem]->outcomes[at.algorithm * options_.runs + at.run];
  }

  // The order of jobs is run by run. All algorithms of an interrupted study then have about the
  // same number of runs.
  RunPlace PlaceOf(int job) const {
    const int algorithms = static_cast<int>(algorithms_.size());
    const int in_problem = job % runs_per_problem_;
    return {job / runs_per_problem_, in_problem % algorithms, in_problem / algorithms};
  }

  void RunJob(int job) {
    if (progress_.Stopped() || job > first_failed_) return;
    const RunPlace at = PlaceOf(job);
    Problem* problem = problems_[at.problem].get();
    std::optional<RunOutcome>& slot = SlotOf(at);
    const bool taken_up = slot.has_value();
    if (!taken_up) slot = FitOnce(*problem, at, job);
    if (!slot) return;
    const std::int64_t evaluations = slot->record.evaluations;
    if (--problem->left == 0) SumUp(at.problem);
    if (!taken_up) progress_.Step(WorkOf(*problem, algorithms_[at.algorithm]), evaluations);
  }

  // Empty if the observer stopped the run, or if it failed: a search of the user's may return what is no point of
  // the bounds, which Try() cannot foresee.
  std::optional<RunOutcome> FitOnce(const Problem& problem, const RunPlace& at, int job) {
    const ComparedAlgorithm& compared = algorithms_[at.algorithm];
    auto done = RunOnce(problem.subject, problem.result, options_, compared, at.run,
                        progress_.stop().AsObserver());
    if (!done) {
      KeepFailure(job, problem, compared, done.error());
      return {};
    }
    if (!*done) return {};
    RunOutcome outcome = std::move(**done);
    if (journal_) journal_->Append(WriteRun(at, problem.result, compared, options_, outcome));
    return outcome;
  }

  // Keeps the error of the first failed job in the order of jobs. Only later ones are left out after a failure, so it
  // is the same on any number of threads.
  void KeepFailure(int job, const Problem& problem, const ComparedAlgorithm& compared,
                   Error error) {
    const std::lock_guard lock(failure_mutex_);
    if (job > first_failed_) return;
    first_failed_ = job;
    error.message = fmt::format("{} cannot be compared on {}: {}", compared.name,
                                problem.result.curve_name, error.message);
    failure_ = std::move(error);
  }

  // Summarises the finished runs of a problem.
  void SumUp(int which) {
    Problem* problem = problems_[which].get();
    std::vector<std::vector<RunOutcome>> outcomes(algorithms_.size());
    bool any = false;
    for (std::size_t i = 0; i < problem->outcomes.size(); ++i) {
      std::optional<RunOutcome>& slot = problem->outcomes[i];
      any = any || slot;
      if (slot) outcomes[i / options_.runs].push_back(std::move(*slot));
    }
    problem->outcomes.clear();
    ProblemResult& result = problem->result;
    result.complete = problem->left == 0;
    if (!any) return;
    result.reference = ReferenceOf(which, BestOf(outcomes));
    result.complete = result.complete && !result.reference.interrupted;
    result = WithAlgorithms(std::move(result), algorithms_, options_, std::move(outcomes));
  }

  // The certified optimum if a proof is possible, else the best known optimum.
  Reference ReferenceOf(int which, const BestFound& best) {
    Problem* problem = problems_[which].get();
    const ProblemResult& result = problem->result;
    const bool plain = result.with.empty() && !result.family;
    Reference reference;
    if (plain) {
      CompareOptions options = options_;
      options.objective = result.objective;
      reference = FindReference(problem->subject, result.model, options, best,
                                progress_.stop().AsObserver());
      const bool enough = reference.certified || reference.interrupted;
      if (enough || options.multistart == 0) return reference;
    }
    if (!problem->known) {
      problem->known =
          FindBestKnown(problem->subject, result, options_, progress_.stop().AsObserver());
      const bool whole = !problem->known->interrupted && options_.multistart > 0;
      if (journal_ && whole) journal_->Append(WriteBestKnown(which, *problem->known));
    }
    Reference known = BestKnownReference(best, *problem->known);
    if (!plain) return known;
    if (reference.rmse_A < known.rmse_A) return reference;
    known.lower_bound_A = reference.lower_bound_A;
    known.floor_A = reference.floor_A;
    known.steepest_n = reference.steepest_n;
    return known;
  }

  const std::vector<ComparedAlgorithm>& algorithms_;
  const CompareOptions& options_;
  const Instant begin_ = Now();
  const int runs_per_problem_;
  const Problems problems_;
  const ProgressReporter progress_;
  std::unique_ptr<Journal> journal_;  // null: none
  int taken_up_ = 0;
  std::atomic<int> first_failed_ = std::numeric_limits<int>::max();
  std::mutex failure_mutex_;
  std::optional<Error> failure_;  // of that job
};

}  // namespace

CompareCurve MakeSubject(IvCurve curve, BoundsSpec bounds) {
  CompareCurve subject;
  subject.curve = WithoutBeyondVoc(std::move(curve));
  subject.bounds = std::move(bounds);
  return subject;
}

Expected<Comparison> Compare(const std::vector<CompareCurve>& curves,
                             const std::vector<ComparedAlgorithm>& algorithms,
                             const CompareOptions& options, const Observer& observer) {
  if (auto checked = CheckComparison(curves, algorithms, options); !checked) {
    return tl::unexpected(checked.error());
  }
  std::vector<IvCurve> readings;
  readings.reserve(curves.size());
  for (const CompareCurve& curve : curves) {
    if (!curve.set) readings.push_back(curve.curve);
  }
  auto doubts = JudgeReadings(readings);
  if (!doubts) return tl::unexpected(doubts.error());
  Study study(curves, algorithms, options, observer);
  if (auto tried = study.Try(); !tried) return tl::unexpected(tried.error());
  if (!options.journal.empty()) {
    auto journal = Journal::Open(options.journal, options.journal_section,
                                 CompareHead(curves, algorithms, options));
    if (!journal) return tl::unexpected(journal.error());
    if (auto taken = study.TakeUp(std::move(*journal)); !taken) {
      return tl::unexpected(taken.error());
    }
  }
  auto comparison = study.Run();
  if (!comparison) return comparison;
  comparison->doubts = std::move(*doubts);
  return comparison;
}

}  // namespace lyrefit
