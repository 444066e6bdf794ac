#include "pagmo_searcher.h"

#include <fmt/format.h>

#ifdef LYREFIT_HAS_PAGMO

#include <algorithm>
#include <exception>
#include <iterator>
#include <limits>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <utility>

#include "lyrefit/base/random.h"
#include "pagmo_peers.h"
#include "recorder.h"

namespace lyrefit {
namespace {

struct UnitBox {
  Recorder* recorder = nullptr;

  pagmo::vector_double fitness(const pagmo::vector_double& x) const {
    // Finite, so that sums over a population stay finite.
    return {std::min(recorder->Evaluate(x.data()), 1e100)};
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    const auto dimensions = static_cast<std::size_t>(recorder->dimensions());
    return {pagmo::vector_double(dimensions, 0.0), pagmo::vector_double(dimensions, 1.0)};
  }
};

// The sentence in the middle of pagmo's error message.
std::string Complaint(const std::exception& error) {
  std::string text = error.what();
  const std::size_t what = text.find("what: ");
  if (what != std::string::npos) text = text.substr(what + 6);
  return text.substr(0, text.find('\n'));
}

// Draws the first candidates as lyrefit's searches do and evolves them until the budget is used up.
void Evolve(const PagmoPeer& peer, const SearchOptions& options, Recorder* recorder) {
  RandomStream random(options.seed, options.run);
  std::vector<pagmo::vector_double> candidates;
  std::vector<double> values;
  for (int i = 0; i < options.population; ++i) {
    candidates.emplace_back();
    for (int j = 0; j < recorder->dimensions(); ++j) candidates.back().push_back(random.Uniform());
    values.push_back(std::min(recorder->Evaluate(candidates.back().data()), 1e100));
  }
  PagmoPlan plan;
  plan.population = static_cast<unsigned>(options.population);
  plan.dimensions = recorder->dimensions();
  plan.level = *std::min_element(values.begin(), values.end());
  pagmo::population population(pagmo::problem(UnitBox{recorder}), 0U,
                               static_cast<unsigned>(random.Bits() >> 32));
  for (std::size_t i = 0; i < candidates.size(); ++i)
    population.push_back(candidates[i], {values[i]});
  const std::int64_t cost =
      static_cast<std::int64_t>(peer.per_candidate) * options.population + peer.fixed;
  // One call suffices for most algorithms; one that ends early continues from its population.
  for (std::int64_t before = -1; recorder->evaluations() > before;) {
    before = recorder->evaluations();
    plan.evaluations = recorder->budget() - before;
    plan.generations = static_cast<unsigned>(std::clamp<std::int64_t>(
        (plan.evaluations + cost - 1) / cost, 1, std::numeric_limits<unsigned>::max()));
    plan.seed = static_cast<unsigned>(random.Bits() >> 32);
    population = peer.make(plan).evolve(population);
  }
}

SearchSummary RunPeer(const PagmoPeer& peer, const ObjectiveFunction& objective, const Box& box,
                      const SearchOptions& options, const Observer& observer) {
  Recorder recorder(objective, box, options, observer);
  std::string message = "the budget is used up";
  try {
    Evolve(peer, options, &recorder);
  } catch (const SearchOver&) {  // normal end
  } catch (const std::exception& error) {
    message = "pagmo2 gave up: " + Complaint(error);
  }
  SearchSummary summary = recorder.Finish();
  summary.message = message;
  return summary;
}

// pagmo's error for this population; empty if it is accepted.
std::string Objection(const PagmoPeer& peer, const SearchOptions& search) {
  const Box box = {{0, 0}, {1, 1}};
  const ObjectiveFunction sphere = [](const double* x) { return x[0] * x[0] + x[1] * x[1]; };
  SearchOptions trial = search;
  trial.iterations = 2;
  Recorder recorder(sphere, box, trial, {});
  try {
    Evolve(peer, trial, &recorder);
  } catch (const SearchOver&) {
  } catch (const std::exception& error) {
    return Complaint(error);
  }
  return "";
}

}  // namespace

std::string PagmoNames() {
  std::string names;
  for (const PagmoPeer& peer : PagmoPeers())
    names += (names.empty() ? "" : ", ") + std::string(peer.name);
  return names;
}

Expected<ComparedAlgorithm> PagmoAlgorithm(const std::string& name, const SearchOptions& search) {
  const std::vector<PagmoPeer>& peers = PagmoPeers();
  const auto peer = std::find_if(peers.begin(), peers.end(),
                                 [&](const PagmoPeer& row) { return name == row.name; });
  if (peer == peers.end()) {
    return Fail(fmt::format("pagmo:{}: expected one of {} behind pagmo:", name, PagmoNames()));
  }
  if (auto valid = ValidateOptions(search, kSearchOptionTable); !valid) {
    return tl::unexpected(valid.error());
  }
  if (const std::string objection = Objection(*peer, search); !objection.empty()) {
    return Fail(
        fmt::format("pagmo:{} with a population of {}: {}", name, search.population, objection));
  }
  ComparedAlgorithm compared{"pagmo:" + name, "pagmo:" + name, search, {}};
  compared.searcher = [&peer = *peer](const ObjectiveFunction& objective, const Box& box,
                                      const SearchOptions& options, const Observer& observer) {
    return RunPeer(peer, objective, box, options, observer);
  };
  return compared;
}

}  // namespace lyrefit

#else  // LYREFIT_HAS_PAGMO

namespace lyrefit {

std::string PagmoNames() { return ""; }

Expected<ComparedAlgorithm> PagmoAlgorithm(const std::string& name,
                                           const SearchOptions& /*search*/) {
  return Fail(fmt::format(
      "pagmo:{}: this build has no pagmo2: install libpagmo-dev and build again", name));
}

}  // namespace lyrefit

#endif  // LYREFIT_HAS_PAGMO
