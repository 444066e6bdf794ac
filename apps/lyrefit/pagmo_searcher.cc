#include "pagmo_searcher.h"

#include <fmt/format.h>

#ifdef LYREFIT_HAS_PAGMO

#include <algorithm>
#include <exception>
#include <limits>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/bee_colony.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/de.hpp>
#include <pagmo/algorithms/de1220.hpp>
#include <pagmo/algorithms/gaco.hpp>
#include <pagmo/algorithms/gwo.hpp>
#include <pagmo/algorithms/ihs.hpp>
#include <pagmo/algorithms/pso.hpp>
#include <pagmo/algorithms/pso_gen.hpp>
#include <pagmo/algorithms/sade.hpp>
#include <pagmo/algorithms/sea.hpp>
#include <pagmo/algorithms/sga.hpp>
#include <pagmo/algorithms/simulated_annealing.hpp>
#include <pagmo/algorithms/xnes.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <utility>

#include "lyrefit/base/random.h"
#include "recorder.h"

namespace lyrefit {
namespace {

// What an algorithm has to be made for.
struct Plan {
  unsigned generations = 1;
  unsigned seed = 0;
  unsigned population = 0;
  std::int64_t evaluations = 0;  // after the first birds
  int dimensions = 0;
  double level = 1;  // objective of the best first bird
};

struct Peer {
  const char* name;
  int per_bird;  // evaluations of a generation: so many a bird ...
  int fixed;     // ... and so many on top
  pagmo::algorithm (*make)(const Plan&);
};

constexpr unsigned kNever = std::numeric_limits<unsigned>::max();

// The temperature falls from the level of the first birds by four decades in ten steps; ten changes
// of range in each; the rest of the budget goes into the length of a step.
pagmo::algorithm MakeAnnealing(const Plan& plan) {
  constexpr std::int64_t kSteps = 10, kRanges = 10;
  const std::int64_t bin = plan.evaluations / (kSteps * kRanges * plan.dimensions);
  const auto bin_size = static_cast<unsigned>(std::clamp<std::int64_t>(bin, 1, 1000000000));
  return pagmo::algorithm(pagmo::simulated_annealing(plan.level, 1e-4 * plan.level, kSteps, kRanges,
                                                     bin_size, 1.0, plan.seed));
}

pagmo::algorithm MakeAntColony(const Plan& plan) {
  return pagmo::algorithm(pagmo::gaco(plan.generations, std::min(63U, plan.population), 1.0, 0.0,
                                      0.01, 1, 7, kNever, kNever, 0.0, false, plan.seed));
}

using pagmo::algorithm;
const Peer kPeers[] = {
    {"de", 1, 0,
     [](const Plan& p) { return algorithm(pagmo::de(p.generations, 0.8, 0.9, 2, 0, 0, p.seed)); }},
    {"sade", 1, 0,
     [](const Plan& p) {
       return algorithm(pagmo::sade(p.generations, 2, 1, 0, 0, false, p.seed));
     }},
    {"de1220", 1, 0,
     [](const Plan& p) {
       const auto& variants = pagmo::de1220_statics<void>::allowed_variants;
       return algorithm(pagmo::de1220(p.generations, variants, 1, 0, 0, false, p.seed));
     }},
    {"cmaes", 1, 0,
     [](const Plan& p) {
       return algorithm(
           pagmo::cmaes(p.generations, -1, -1, -1, -1, 0.5, 0, 0, false, true, p.seed));
     }},
    {"xnes", 1, 0,
     [](const Plan& p) {
       return algorithm(pagmo::xnes(p.generations, -1, -1, -1, -1, 0, 0, false, true, p.seed));
     }},
    {"pso", 1, 0,
     [](const Plan& p) {
       return algorithm(pagmo::pso(p.generations, 0.7298, 2.05, 2.05, 0.5, 5, 2, 4, false, p.seed));
     }},
    {"pso_gen", 1, 0,
     [](const Plan& p) {
       return algorithm(
           pagmo::pso_gen(p.generations, 0.7298, 2.05, 2.05, 0.5, 5, 2, 4, false, p.seed));
     }},
    {"gwo", 1, 0, [](const Plan& p) { return algorithm(pagmo::gwo(p.generations, p.seed)); }},
    {"bee_colony", 2, 0,
     [](const Plan& p) { return algorithm(pagmo::bee_colony(p.generations, 20, p.seed)); }},
    {"gaco", 1, 0, MakeAntColony},
    {"sga", 1, 0,
     [](const Plan& p) {
       return algorithm(pagmo::sga(p.generations, 0.9, 1, 0.02, 1, 2, "exponential", "polynomial",
                                   "tournament", p.seed));
     }},
    {"ihs", 0, 1,
     [](const Plan& p) {
       return algorithm(pagmo::ihs(p.generations, 0.85, 0.35, 0.99, 1e-5, 1, p.seed));
     }},
    {"sea", 0, 1, [](const Plan& p) { return algorithm(pagmo::sea(p.generations, p.seed)); }},
    {"simulated_annealing", 0, 1, MakeAnnealing},
};

struct UnitBox {
  Recorder* recorder = nullptr;

  pagmo::vector_double fitness(const pagmo::vector_double& x) const {
    // Finite, so that sums over a population stay sound.
    return {std::min(recorder->Evaluate(x.data()), 1e100)};
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    const auto dimensions = static_cast<std::size_t>(recorder->dimensions());
    return {pagmo::vector_double(dimensions, 0.0), pagmo::vector_double(dimensions, 1.0)};
  }
};

// The sentence in the middle of pagmo's message.
std::string Complaint(const std::exception& error) {
  std::string text = error.what();
  const std::size_t what = text.find("what: ");
  if (what != std::string::npos) text = text.substr(what + 6);
  return text.substr(0, text.find('\n'));
}

// Draws the first birds as our own searches do and lets them evolve until the budget is used up.
void Evolve(const Peer& peer, const SearchOptions& options, Recorder* recorder) {
  RandomStream random(options.seed, options.run);
  std::vector<pagmo::vector_double> birds;
  std::vector<double> values;
  for (int i = 0; i < options.population; ++i) {
    birds.emplace_back();
    for (int j = 0; j < recorder->dimensions(); ++j) birds.back().push_back(random.Uniform());
    values.push_back(std::min(recorder->Evaluate(birds.back().data()), 1e100));
  }
  Plan plan;
  plan.population = static_cast<unsigned>(options.population);
  plan.dimensions = recorder->dimensions();
  plan.level = *std::min_element(values.begin(), values.end());
  pagmo::population population(pagmo::problem(UnitBox{recorder}), 0U,
                               static_cast<unsigned>(random.Bits() >> 32));
  for (std::size_t i = 0; i < birds.size(); ++i) population.push_back(birds[i], {values[i]});
  const std::int64_t cost =
      static_cast<std::int64_t>(peer.per_bird) * options.population + peer.fixed;
  // Once is enough for most; an algorithm that ends early goes on with what it has.
  for (std::int64_t before = -1; recorder->evaluations() > before;) {
    before = recorder->evaluations();
    plan.evaluations = recorder->budget() - before;
    plan.generations = static_cast<unsigned>(
        std::clamp<std::int64_t>((plan.evaluations + cost - 1) / cost, 1, kNever));
    plan.seed = static_cast<unsigned>(random.Bits() >> 32);
    population = peer.make(plan).evolve(population);
  }
}

SearchSummary RunPeer(const Peer& peer, const ObjectiveFunction& objective, const Box& box,
                      const SearchOptions& options, const Observer& observer) {
  Recorder recorder(objective, box, options, observer);
  std::string message = "the budget is used up";
  try {
    Evolve(peer, options, &recorder);
  } catch (const SearchOver&) {  // as it should be
  } catch (const std::exception& error) {
    message = "pagmo2 gave up: " + Complaint(error);
  }
  SearchSummary summary = recorder.Finish();
  summary.message = message;
  return summary;
}

// What pagmo has against such a population; empty if nothing.
std::string Objection(const Peer& peer, const SearchOptions& search) {
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
  for (const Peer& peer : kPeers) names += (names.empty() ? "" : ", ") + std::string(peer.name);
  return names;
}

Expected<Contender> PagmoContender(const std::string& name, const SearchOptions& search) {
  const auto* const peer = std::find_if(std::begin(kPeers), std::end(kPeers),
                                        [&](const Peer& row) { return name == row.name; });
  if (peer == std::end(kPeers)) {
    return Fail(fmt::format("pagmo:{}: expected one of {} behind pagmo:", name, PagmoNames()));
  }
  if (auto valid = ValidateOptions(search, kSearchOptionTable); !valid) {
    return tl::unexpected(valid.error());
  }
  if (const std::string objection = Objection(*peer, search); !objection.empty()) {
    return Fail(
        fmt::format("pagmo:{} with a population of {}: {}", name, search.population, objection));
  }
  Contender contender{"pagmo:" + name, "pagmo:" + name, search, {}};
  contender.searcher = [peer](const ObjectiveFunction& objective, const Box& box,
                              const SearchOptions& options, const Observer& observer) {
    return RunPeer(*peer, objective, box, options, observer);
  };
  return contender;
}

}  // namespace lyrefit

#else  // LYREFIT_HAS_PAGMO

namespace lyrefit {

std::string PagmoNames() { return ""; }

Expected<Contender> PagmoContender(const std::string& name, const SearchOptions& /*search*/) {
  return Fail(fmt::format(
      "pagmo:{}: this build has no pagmo2: install libpagmo-dev and build again", name));
}

}  // namespace lyrefit

#endif  // LYREFIT_HAS_PAGMO
