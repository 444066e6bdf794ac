#include "searcher.h"

#include <pybind11/numpy.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "errors.h"
#include "lyrefit/search/search.h"

namespace lyrefit::python {
namespace {

namespace py = pybind11;

using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Thrown to end a search: its observer requests a stop, or its budget is spent.
struct Stopped {};

// Numbers as points; an error that says what was expected for anything else.
Points PointsOf(const py::handle value, const std::string& expected) {
  Points points = Points::ensure(value);
  if (!points) Raise({expected + ", found " + NameOf(py::type::of(value)), {}});
  return points;
}

// One run of a search: counts its evaluations and keeps the best points.
class Run {
 public:
  Run(const ObjectiveFunction& objective, const Box& box, const SearchOptions& options,
      const Observer& observer, std::int64_t limit)
      : objective_(objective),
        options_(options),
        observer_(observer),
        sides_(box.lower.size()),
        limit_(limit) {}

  // Whether an evaluation beyond the limit was asked for; none is done.
  bool spent() const { return spent_; }

  // The objective at one point, shape (n,), or at several, (m, n).
  py::object At(const py::handle given) {
    const Points points = PointsOf(given, "the objective takes an array of numbers");
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

  // The summary of a search that returned `given`.
  SearchSummary Summary(const py::handle given) {
    const std::string expected = "a search has to return its best point, shape (" +
                                 std::to_string(sides_) + ",), or several, best first, (m, " +
                                 std::to_string(sides_) + ")";
    const Points candidates = PointsOf(given, expected);
    const auto last = candidates.ndim() == 0 ? 0 : candidates.shape(candidates.ndim() - 1);
    const py::ssize_t count = candidates.ndim() == 1   ? 1
                              : candidates.ndim() == 2 ? candidates.shape(0)
                                                       : 0;
    if (count == 0 || static_cast<std::size_t>(last) != sides_) Raise({expected, {}});
    std::vector<Candidate> elites;
    for (py::ssize_t k = 0; k < count && k < options_.elites; ++k) {
      Candidate candidate;
      candidate.x.assign(candidates.data() + k * last, candidates.data() + (k + 1) * last);
      candidate.objective = objective_(candidate.x.data());
      elites.push_back(std::move(candidate));
    }
    return SummaryOf(std::move(elites), SearchTermination::kIterations);
  }

  // The summary of a search that its limit ended: the best point it asked for.
  SearchSummary Cut() { return SummaryOf({best_}, SearchTermination::kEvaluations); }

 private:
  SearchSummary SummaryOf(std::vector<Candidate> elites, SearchTermination termination) {
    SearchSummary summary;
    summary.elites = std::move(elites);
    std::stable_sort(
        summary.elites.begin(), summary.elites.end(),
        [](const Candidate& a, const Candidate& b) { return a.objective < b.objective; });
    summary.best = summary.elites.front();
    summary.evaluations = evaluations_;
    summary.iterations = evaluations_ / options_.population;
    summary.termination = termination;
    summary.message = "a search of one's own";
    trace_.push_back(
        {summary.iterations, evaluations_, std::min(best_.objective, summary.best.objective)});
    summary.trace = std::move(trace_);
    return summary;
  }

  double Evaluate(const double* x) {
    if (evaluations_ == limit_) {
      spent_ = true;
      throw Stopped();
    }
    const double at_x = objective_(x);
    const double value = at_x == at_x ? at_x : kInfinity;
    ++evaluations_;
    if (value < best_.objective || best_.x.empty()) best_ = {{x, x + sides_}, value};
    if (evaluations_ % options_.population == 0) {
      const std::int64_t iteration = evaluations_ / options_.population;
      trace_.push_back({iteration, evaluations_, best_.objective});
      Progress progress;
      progress.stage = "search";
      progress.iteration = iteration;
      progress.evaluations = evaluations_;
      progress.best = best_.objective;
      if (StopRequested(observer_, progress)) throw Stopped();
    }
    return value;
  }

  const ObjectiveFunction& objective_;
  const SearchOptions& options_;
  const Observer& observer_;
  const std::size_t sides_;
  const std::int64_t limit_;
  std::int64_t evaluations_ = 0;
  bool spent_ = false;
  Candidate best_;
  std::vector<TracePoint> trace_;
};

py::array_t<double> ArrayOf(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::list ParametersOf(const Box& box) {
  py::list parameters;
  for (std::size_t k = 0; k < box.sides.size(); ++k) {
    const BoxSide& side = box.sides[k];
    const bool log = side.log_base > 0, whole = side.step > 0;
    const auto value = [&](double x) {
      if (whole) return side.first + side.step * x;
      return log ? side.log_base * std::exp(x) : x;
    };
    py::dict parameter;
    parameter["name"] = side.name;
    parameter["unit"] = side.unit;
    parameter["scale"] = log ? "log" : whole ? "whole" : "linear";
    parameter["lower"] = value(box.lower[k]);
    parameter["upper"] = value(whole ? box.upper[k] - 1 : box.upper[k]);
    parameters.append(std::move(parameter));
  }
  return parameters;
}

py::array_t<double> StartOf(const Box& box, const SearchOptions& options) {
  const std::vector<std::vector<double>> points = FirstPopulation(box, options);
  py::array_t<double> start({points.size(), box.lower.size()});
  double* at = start.mutable_data();
  for (const std::vector<double>& point : points) at = std::copy(point.begin(), point.end(), at);
  return start;
}

py::dict OptionsOf(const Box& box, const SearchOptions& options) {
  py::dict said;
  said["seed"] = options.seed;
  said["run"] = options.run;
  said["population"] = options.population;
  said["iterations"] = options.iterations;
  said["max_evaluations"] = options.max_evaluations;
  said["elites"] = options.elites;
  said["parameters"] = ParametersOf(box);
  said["start"] = StartOf(box, options);
  return said;
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
                       const SearchOptions& options, const Observer& observer, std::int64_t limit) {
  auto run = std::make_shared<Run>(objective, box, options, observer, limit);
  bool stopped = false;
  // The search may keep the function after its end, when the run no longer exists.
  const py::cpp_function at([&stopped, weak = std::weak_ptr<Run>(run)](const py::handle& points) {
    const auto alive = weak.lock();
    if (alive == nullptr) throw py::value_error("the search is over");
    try {
      return alive->At(points);
    } catch (const Stopped&) {
      stopped = true;
      PyErr_SetString(PyExc_StopIteration, alive->spent() ? "the budget of evaluations is spent"
                                                          : "the work was told to stop");
      throw py::error_already_set();
    }
  });
  try {
    return run->Summary(
        search(at, ArrayOf(box.lower), ArrayOf(box.upper), OptionsOf(box, options)));
  } catch (py::error_already_set& raised) {
    if (run->spent()) return run->Cut();
    if (stopped) return Ended(objective, box);
    if (py::hasattr(raised.value(), "add_note")) {  // since Python 3.11
      raised.value().attr("add_note")("raised by the search '" + NameOf(search) + "' in run " +
                                      std::to_string(options.run) + " of seed " +
                                      std::to_string(options.seed));
    }
    throw;
  }
}

}  // namespace

std::string NameOf(py::handle function) {
  if (py::hasattr(function, "__name__")) {
    return py::str(function.attr("__name__")).cast<std::string>();
  }
  return py::str(py::type::of(function).attr("__name__")).cast<std::string>();
}

SearchFunction SearcherOf(py::object search, std::shared_ptr<Fault> fault, bool within_budget) {
  // The deleter takes the interpreter's lock, since the last copy may be destroyed without it.
  std::shared_ptr<py::object> held(new py::object(std::move(search)), [](py::object* object) {
    const py::gil_scoped_acquire acquired;
    delete object;
  });
  return [held = std::move(held), fault = std::move(fault), within_budget](
             const ObjectiveFunction& objective, const Box& box, const SearchOptions& options,
             const Observer& observer) -> SearchSummary {
    if (!fault->Happened()) {
      const py::gil_scoped_acquire acquired;
      try {
        const std::int64_t limit =
            within_budget ? PlannedEvaluations(options) : std::numeric_limits<std::int64_t>::max();
        return Searched(*held, objective, box, options, observer, limit);
      } catch (...) {
        fault->Keep();
      }
    }
    return Ended(objective, box);
  };
}

}  // namespace lyrefit::python
