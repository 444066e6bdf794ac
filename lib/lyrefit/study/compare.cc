#include "lyrefit/study/compare.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>

#include "lyrefit/base/parallel.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/version.h"
#include "lyrefit/study/compare_checks.h"
#include "lyrefit/study/reference.h"
#include "lyrefit/study/summary.h"

namespace lyrefit {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kWatchPeriod(100);  // between calls from inside a run

// One curve with one model, while its runs are under way.
struct Problem {
  Problem(const CompareCurve& subject_, Model model_, int runs)
      : subject(subject_), model(model_), outcomes(runs), left(runs) {}

  const CompareCurve& subject;
  Model model;
  std::vector<RunOutcome> outcomes;  // contender by contender
  std::atomic<int> left;             // runs that are not done
  ProblemResult result;
};

FitOptions OptionsOf(const Problem& problem, const CompareOptions& options) {
  FitOptions fit;
  fit.model = problem.model;
  fit.objective = options.objective;
  fit.constants = options.constants;
  fit.bounds = problem.subject.bounds;
  fit.random_baseline = false;
  fit.polish = options.polish;
  fit.plain_polish = options.plain_polish;
  fit.intervals = Intervals::kNone;
  fit.threads = 1;
  fit.kernel = options.kernel;
  return fit;
}

RunOutcome OutcomeOf(const FitReport& report, Objective objective) {
  RunOutcome outcome;
  outcome.record.searched_A = report.rmse.searched.Of(objective);
  outcome.record.plain_polished_A = report.rmse.plain_polished.Of(objective);
  outcome.record.own_polished_A = report.rmse.best_bird_polished.Of(objective);
  outcome.record.polished_A = report.rmse.refined.Of(objective);
  outcome.record.evaluations = report.search.evaluations;
  outcome.record.search_seconds = report.search.seconds;
  outcome.record.polish_seconds = report.refine.seconds;
  outcome.gains = KeepGains(report.search.trace);
  if (outcome.gains.empty()) {  // a search of the user's own that keeps no trace
    outcome.gains.push_back({0, report.search.evaluations, outcome.record.searched_A});
  }
  outcome.parameters = report.refined;
  return outcome;
}

// The comparison as it goes on: jobs write to their own slot, and the last one of a problem sums it
// up.
class Study {
 public:
  Study(const std::vector<CompareCurve>& curves, const std::vector<Contender>& contenders,
        const CompareOptions& options, const Observer& observer)
      : contenders_(contenders), options_(options), observer_(observer) {
    const int runs = static_cast<int>(contenders.size()) * options.runs;
    for (const CompareCurve& curve : curves) {
      for (const Model model : options.models) {
        problems_.push_back(std::make_unique<Problem>(curve, model, runs));
      }
    }
    jobs_per_problem_ = runs;
  }

  // One cheap search each finds whatever a fit would object to.
  Expected<void> Try() const {
    for (const auto& problem : problems_) {
      FitOptions fit = OptionsOf(*problem, options_);
      fit.polish = fit.plain_polish = false;
      fit.search.population = 4;
      fit.search.max_evaluations = 4;
      if (const auto report = Fit(problem->subject.curve, fit); !report) {
        Error error = report.error();
        error.message = fmt::format("{} cannot be compared on {}: {}", ToText(problem->model),
                                    problem->subject.curve.name, error.message);
        return tl::unexpected(std::move(error));
      }
    }
    return {};
  }

  Comparison Run() {
    ParallelFor(jobs(), options_.threads, [this](int job) { RunJob(job); });
    Comparison comparison;
    comparison.version = Version();
    comparison.options = options_;
    for (const auto& problem : problems_) {
      if (problem->left > 0) continue;
      comparison.problems.push_back(std::move(problem->result));
    }
    comparison.interrupted = comparison.problems.size() < problems_.size();
    comparison.seconds = SecondsSince(begin_);
    return comparison;
  }

 private:
  int jobs() const { return static_cast<int>(problems_.size()) * jobs_per_problem_; }

  void RunJob(int job) {
    if (stopped_) return;
    Problem* problem = problems_[job / jobs_per_problem_].get();
    const int slot = job % jobs_per_problem_;
    const Contender& contender = contenders_[slot / options_.runs];
    FitOptions fit = OptionsOf(*problem, options_);
    fit.search = contender.search;
    fit.search.seed = options_.seed;
    fit.search.run = slot % options_.runs;
    fit.searcher = contender.searcher;
    const Observer watch = [this](const Progress& /*inside*/) { return Watch(); };
    const auto report = Fit(problem->subject.curve, fit, observer_ ? watch : Observer());
    CHECK(report.has_value()) << report.error().ToString();  // Try() would have seen it
    if (report->interrupted) return;
    problem->outcomes[slot] = OutcomeOf(*report, options_.objective);
    if (--problem->left == 0) SumUp(problem);
    const std::lock_guard<std::mutex> lock(observing_);
    ++done_;
    evaluations_ += report->search.evaluations;
    TellObserver();
  }

  // From inside a run: looks now and then whether the observer wants to stop.
  ObserverAction Watch() {
    std::unique_lock<std::mutex> lock(observing_, std::try_to_lock);
    if (lock.owns_lock() && Clock::now() - told_ >= kWatchPeriod) TellObserver();
    return stopped_ ? ObserverAction::kStop : ObserverAction::kContinue;
  }

  // `observing_` must be held.
  void TellObserver() {
    told_ = Clock::now();
    const Progress progress{"compare", done_, jobs(), evaluations_, 0, SecondsSince(begin_)};
    if (!stopped_ && StopRequested(observer_, progress)) stopped_ = true;
  }

  void SumUp(Problem* problem) const {
    ProblemResult& result = problem->result;
    result.curve_name = problem->subject.curve.name;
    result.model = problem->model;
    result.bounds_name = problem->subject.bounds.name;
    result.reference =
        FindReference(problem->subject, problem->model, options_, BestOf(problem->outcomes));
    std::vector<std::vector<double>> searched, polished;
    for (std::size_t c = 0; c < contenders_.size(); ++c) {
      const auto first = problem->outcomes.begin() + static_cast<std::ptrdiff_t>(c) * options_.runs;
      std::vector<RunOutcome> outcomes(std::make_move_iterator(first),
                                       std::make_move_iterator(first + options_.runs));
      result.contenders.push_back(
          Summarise(contenders_[c], &outcomes, result.reference.rmse_A, options_.target_gap));
      searched.emplace_back();
      polished.emplace_back();
      for (const RunRecord& run : result.contenders.back().runs) {
        searched.back().push_back(run.searched_A);
        polished.back().push_back(run.polished_A);
      }
    }
    problem->outcomes.clear();
    if (!options_.rankings) return;
    result.searched = RankAll(std::move(searched));
    if (options_.polish) result.polished = RankJoined(polished);
  }

  const std::vector<Contender>& contenders_;
  const CompareOptions& options_;
  const Observer& observer_;
  const Clock::time_point begin_ = Clock::now();
  std::vector<std::unique_ptr<Problem>> problems_;
  int jobs_per_problem_ = 0;
  std::atomic<bool> stopped_{false};
  std::mutex observing_;  // guards what follows
  Clock::time_point told_ = begin_;
  std::int64_t done_ = 0;
  std::int64_t evaluations_ = 0;
};

}  // namespace

Expected<Comparison> Compare(const std::vector<CompareCurve>& curves,
                             const std::vector<Contender>& contenders,
                             const CompareOptions& options, const Observer& observer) {
  if (auto checked = CheckComparison(curves, contenders, options); !checked) {
    return tl::unexpected(checked.error());
  }
  if (auto valid = ValidateThreads(options.threads); !valid) return tl::unexpected(valid.error());
  Study study(curves, contenders, options, observer);
  if (auto tried = study.Try(); !tried) return tl::unexpected(tried.error());
  return study.Run();
}

}  // namespace lyrefit
