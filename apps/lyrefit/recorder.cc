#include "recorder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/seconds.h"

namespace lyrefit {
namespace {

constexpr double kDistinct = 0.01;  // in a coordinate of the unit box, as in lyrefit's searches

bool Near(const std::vector<double>& a, const double* b) {
  for (std::size_t j = 0; j < a.size(); ++j) {
    if (std::fabs(a[j] - b[j]) > kDistinct) return false;
  }
  return true;
}

std::int64_t Budget(const SearchOptions& options) {
  const std::int64_t planned =
      static_cast<std::int64_t>(options.population) * (options.iterations + 1LL);
  return std::min(planned, options.max_evaluations);
}

}  // namespace

Recorder::Recorder(ObjectiveFunction objective, Box box, const SearchOptions& options,
                   Observer observer)
    : objective_(std::move(objective)),
      box_(std::move(box)),
      options_(options),
      observer_(std::move(observer)),
      budget_(Budget(options)),
      unit_(box_.lower.size()),
      x_(box_.lower.size()) {}

double Recorder::Evaluate(const double* unit) {
  if (summary_.evaluations >= budget_) throw SearchOver();
  bool sound = true;
  for (std::size_t j = 0; j < x_.size(); ++j) {
    sound = sound && !std::isnan(unit[j]);
    unit_[j] = std::min(std::max(unit[j], 0.0), 1.0);
    x_[j] = box_.lower[j] + unit_[j] * (box_.upper[j] - box_.lower[j]);
  }
  double value = sound ? objective_(x_.data()) : kInfinity;
  if (std::isnan(value)) value = kInfinity;
  ++summary_.evaluations;
  if (sound) Keep(unit_.data(), value);
  if (summary_.evaluations % options_.population == 0) EndIteration();
  return value;
}

void Recorder::Keep(const double* unit, double value) {
  const bool full = static_cast<int>(elites_.size()) >= options_.elites;
  if (full && value >= elites_.back().value) return;
  for (const Elite& elite : elites_) {
    if (elite.value <= value && Near(elite.unit, unit)) return;
  }
  elites_.erase(std::remove_if(elites_.begin(), elites_.end(),
                               [&](const Elite& elite) { return Near(elite.unit, unit); }),
                elites_.end());
  const auto place = std::find_if(elites_.begin(), elites_.end(),
                                  [value](const Elite& elite) { return elite.value > value; });
  elites_.insert(place, {{unit, unit + x_.size()}, value});
  if (static_cast<int>(elites_.size()) > options_.elites) elites_.pop_back();
}

void Recorder::EndIteration() {
  const double seconds = SecondsSince(begin_);
  const std::int64_t t = static_cast<std::int64_t>(summary_.trace.size());
  const double best = elites_.empty() ? kInfinity : elites_.front().value;
  summary_.trace.push_back({t, summary_.evaluations, best});
  const Progress progress{"search", t, options_.iterations, summary_.evaluations, best, seconds};
  if (!StopRequested(observer_, progress)) return;
  summary_.termination = SearchTermination::kInterrupted;
  throw SearchOver();
}

SearchSummary Recorder::Finish() {
  for (const Elite& elite : elites_) {
    Candidate candidate;
    for (std::size_t j = 0; j < x_.size(); ++j) {
      candidate.x.push_back(box_.lower[j] + elite.unit[j] * (box_.upper[j] - box_.lower[j]));
    }
    candidate.objective = elite.value;
    summary_.elites.push_back(std::move(candidate));
  }
  summary_.best = summary_.elites.front();
  if (summary_.trace.empty() || summary_.trace.back().evaluations < summary_.evaluations) {
    const std::int64_t t = static_cast<std::int64_t>(summary_.trace.size());
    summary_.trace.push_back({t, summary_.evaluations, summary_.best.objective});
  }
  summary_.iterations = summary_.trace.back().iteration;
  if (summary_.termination == SearchTermination::kNotRun) {
    summary_.termination = budget_ < options_.max_evaluations ? SearchTermination::kIterations
                                                              : SearchTermination::kEvaluations;
  }
  summary_.seconds = SecondsSince(begin_);
  return std::move(summary_);
}

}  // namespace lyrefit
