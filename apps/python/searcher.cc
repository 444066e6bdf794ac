#include "searcher.h"

#include <pybind11/numpy.h>

#include <algorithm>
#include <string>
#include <utility>

#include "errors.h"

namespace lyrefit::python {
namespace {

namespace py = pybind11;

using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Thrown to end a search when its observer requests a stop.
struct Stopped {};

// One run of a search: counts its evaluations and keeps the best points.
class Run {
 public:
  Run(const ObjectiveFunction& objective, const Box& box, const SearchOptions& options,
      const Observer& observer)
      : objective_(objective), options_(options), observer_(observer), sides_(box.lower.size()) {}

  // The objective at one point, shape (n,), or at several, (m, n).
  py::object At(const Points& points) {
    const bool one = points.ndim() == 1;
    const auto last = points.ndim() == 0 ? 0 : points.shape(points.ndim() - 1);
    if (points.ndim() > 2 || static_cast<std::size_t>(last) != sides_) {
      Raise({"the objective takes arrays of shape (" + std::to_string(sides_) + ",) or (m, " +
                 std::to_string(sides_) + ")",
             {}});
    }
    const py::ssize_t count = one ? 1 : points.shape(0);
    py::array_t<double> values(count);
    for (py::ssize_t k = 0; k < count; ++k) {
      values.mutable_data()[k] = Evaluate(points.data() + k * last);
    }
    return one ? py::object(py::float_(values.data()[0])) : py::object(values);
  }

  SearchSummary Summary(const Points& candidates) {
    SearchSummary summary;
    const auto last = candidates.ndim() == 0 ? 0 : candidates.shape(candidates.ndim() - 1);
    const py::ssize_t count = candidates.ndim() == 1   ? 1
                              : candidates.ndim() == 2 ? candidates.shape(0)
                                                       : 0;
    if (count == 0 || static_cast<std::size_t>(last) != sides_) {
      Raise({"a search has to return its best point, shape (" + std::to_string(sides_) +
                 ",), or several, best first, (m, " + std::to_string(sides_) + ")",
             {}});
    }
    for (py::ssize_t k = 0; k < count && k < options_.elites; ++k) {
      Candidate candidate;
      candidate.x.assign(candidates.data() + k * last, candidates.data() + (k + 1) * last);
      candidate.objective = objective_(candidate.x.data());
      summary.elites.push_back(std::move(candidate));
    }
    std::stable_sort(
        summary.elites.begin(), summary.elites.end(),
        [](const Candidate& a, const Candidate& b) { return a.objective < b.objective; });
    summary.best = summary.elites.front();
    summary.evaluations = evaluations_;
    summary.iterations = evaluations_ / options_.population;
    summary.termination = SearchTermination::kIterations;
    summary.message = "a search of one's own";
    trace_.push_back({summary.iterations, evaluations_, std::min(best_, summary.best.objective)});
    summary.trace = std::move(trace_);
    return summary;
  }

 private:
  double Evaluate(const double* x) {
    const double value = objective_(x);
    best_ = std::min(best_, value == value ? value : kInfinity);
    ++evaluations_;
    if (evaluations_ % options_.population == 0) {
      const std::int64_t iteration = evaluations_ / options_.population;
      trace_.push_back({iteration, evaluations_, best_});
      Progress progress;
      progress.stage = "search";
      progress.iteration = iteration;
      progress.evaluations = evaluations_;
      progress.best = best_;
      if (StopRequested(observer_, progress)) throw Stopped();
    }
    return value;
  }

  const ObjectiveFunction& objective_;
  const SearchOptions& options_;
  const Observer& observer_;
  const std::size_t sides_;
  std::int64_t evaluations_ = 0;
  double best_ = kInfinity;
  std::vector<TracePoint> trace_;
};

py::dict OptionsOf(const SearchOptions& options) {
  py::dict said;
  said["seed"] = options.seed;
  said["run"] = options.run;
  said["population"] = options.population;
  said["iterations"] = options.iterations;
  said["max_evaluations"] = options.max_evaluations;
  said["elites"] = options.elites;
  return said;
}

py::array_t<double> SideOf(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

// Summary of a search that returned no result: the middle of the box.
SearchSummary Ended(const ObjectiveFunction& objective, const Box& box) {
  SearchSummary summary;
  for (std::size_t k = 0; k < box.lower.size(); ++k) {
    summary.best.x.push_back(0.5 * (box.lower[k] + box.upper[k]));
  }
  summary.best.objective = objective(summary.best.x.data());
  summary.elites = {summary.best};
  summary.termination = SearchTermination::kInterrupted;
  summary.evaluations = 1;
  summary.trace = {{0, 1, summary.best.objective}};
  return summary;
}

SearchSummary Searched(const py::object& search, const ObjectiveFunction& objective, const Box& box,
                       const SearchOptions& options, const Observer& observer) {
  auto run = std::make_shared<Run>(objective, box, options, observer);
  bool stopped = false;
  // The search may keep the function after its end, when the run no longer exists.
  const py::cpp_function at([&stopped, weak = std::weak_ptr<Run>(run)](const Points& points) {
    const auto alive = weak.lock();
    if (alive == nullptr) throw py::value_error("the search is over");
    try {
      return alive->At(points);
    } catch (const Stopped&) {
      stopped = true;
      PyErr_SetString(PyExc_StopIteration, "the work was told to stop");
      throw py::error_already_set();
    }
  });
  try {
    const py::object candidates =
        search(at, SideOf(box.lower), SideOf(box.upper), OptionsOf(options));
    return run->Summary(Points::ensure(candidates));
  } catch (const py::error_already_set&) {
    if (!stopped) throw;
    return Ended(objective, box);
  }
}

}  // namespace

SearchFunction SearcherOf(py::object search, std::shared_ptr<Fault> fault) {
  // The deleter takes the interpreter's lock, since the last copy may be destroyed without it.
  std::shared_ptr<py::object> held(new py::object(std::move(search)), [](py::object* object) {
    const py::gil_scoped_acquire acquired;
    delete object;
  });
  return [held = std::move(held), fault = std::move(fault)](
             const ObjectiveFunction& objective, const Box& box, const SearchOptions& options,
             const Observer& observer) -> SearchSummary {
    if (!fault->Happened()) {
      const py::gil_scoped_acquire acquired;
      try {
        return Searched(*held, objective, box, options, observer);
      } catch (...) {
        fault->Keep();
      }
    }
    return Ended(objective, box);
  };
}

}  // namespace lyrefit::python
