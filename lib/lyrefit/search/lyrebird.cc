// The lyrebird optimizer (LO, doi:10.3390/biomimetics8060507) and its modification (MLO, J. Ind.
// Manag. Optim. 22(1), 642-690, section 3). Equation numbers are those of the MLO paper. One
// algorithm has four settings; LO has Pm = gamma = 0. README.md beside this file lists the source
// of each step and the evidence for the choices.
//
// In short, the choices are: in Eq. 20 the memory is that of a random candidate, and z is one
// number a move. The paper prints the candidate's own memory and a vector z (kMloVector uses the
// vector). Eq. 23 and 24 are missing in print, and the code is a reconstruction.
#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/search/run.h"

namespace lyrefit {
namespace {

// Candidates sorted by rising objective value, so that drawing a candidate better than i needs no
// scan.
class CandidateOrder {
 public:
  explicit CandidateOrder(const SearchRun& run)
      : run_(run), order_(run.population()), rank_(order_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(),
                     [&](int a, int b) { return run.f(a) < run.f(b); });
    for (std::size_t r = 0; r < order_.size(); ++r) rank_[order_[r]] = static_cast<int>(r);
  }

  // Number of strictly better candidates. They have the ranks 0 .. count - 1 and form the safe set
  // S_i of Eq. 18.
  int Better(int candidate) const {
    int count = rank_[candidate];
    while (count > 0 && run_.f(order_[count - 1]) == run_.f(candidate)) --count;
    return count;
  }
  int At(int rank) const { return order_[rank]; }

  // Restores the order after the objective value of `candidate` has fallen.
  void Improved(int candidate) {
    int r = rank_[candidate];
    for (; r > 0 && run_.f(order_[r - 1]) > run_.f(candidate); --r) {
      order_[r] = order_[r - 1];
      rank_[order_[r]] = r;
    }
    order_[r] = candidate;
    rank_[candidate] = r;
  }

 private:
  const SearchRun& run_;
  std::vector<int> order_;
  std::vector<int> rank_;
};

// LO and its ablations are MLO with strategies switched off.
double MemoryRateOf(const SearchOptions& options) {
  const Algorithm a = options.algorithm;
  return a == Algorithm::kLo || a == Algorithm::kLoDmlss ? 0 : options.memory_rate;
}

double GammaOf(const SearchOptions& options) {
  const Algorithm a = options.algorithm;
  return a == Algorithm::kLo || a == Algorithm::kLoMblss ? 0 : options.distance_coefficient;
}

// Moves the population of a run; each candidate is a lyrebird.
class Lyrebird {
 public:
  // The first population must have been drawn.
  Lyrebird(SearchRun* run, const SearchOptions& options, RandomStream* random);

  // Iteration `t` of `planned`: moves every candidate, unless the run stops.
  void Move(double t, double planned);

 private:
  bool Propose(int i, double t, double planned);
  bool Escape(int i);
  void Imitate(int i);
  void Hide(int i, double t);
  void Disperse(int i);
  void Accept(int i);
  double Unit(double x, int j) const;
  std::vector<double> UnitPopulation();

  SearchRun* run_;
  RandomStream* random_;
  const int d_;
  const int n_;
  const double memory_rate_;
  const double gamma_;
  const bool vector_;  // draw z of Eq. 20 for each coordinate
  std::vector<double> candidate_;
  std::vector<double> unit_;
  CandidateOrder order_;
  std::optional<Crowding> crowding_;
};

Lyrebird::Lyrebird(SearchRun* run, const SearchOptions& options, RandomStream* random)
    : run_(run),
      random_(random),
      d_(run->dimensions()),
      n_(run->population()),
      memory_rate_(MemoryRateOf(options)),
      gamma_(GammaOf(options)),
      vector_(options.algorithm == Algorithm::kMloVector),
      candidate_(d_),
      unit_(d_),
      order_(*run) {
  if (gamma_ > 0) crowding_.emplace(n_, d_, UnitPopulation());
}

void Lyrebird::Move(double t, double planned) {
  for (int i = 0; i < n_ && !run_->stopped(); ++i) {
    if (Propose(i, t, planned)) Accept(i);
  }
}

// Computes the new position in candidate_; false if the candidate does not move.
bool Lyrebird::Propose(int i, double t, double planned) {
  const bool escapes = random_->Uniform() < 0.5;
  if (!escapes) run_->CountHide();
  if (escapes) {
    const double rate = memory_rate_ * t / planned;  // Eq. 21
    if (rate > 0 && random_->Uniform() < rate) {
      Imitate(i);
    } else if (!Escape(i)) {
      return false;
    }
  } else if (crowding_ && crowding_->MeanDistance(i) < gamma_ * crowding_->LargestDistance()) {
    run_->CountDispersal();
    Disperse(i);
  } else {
    Hide(i, t);
  }
  const Box& box = run_->box();
  for (int j = 0; j < d_; ++j) {
    candidate_[j] = std::min(std::max(candidate_[j], box.lower[j]), box.upper[j]);
  }
  return true;
}

// Eq. 18, 19: x' = x + r (s - J x), s a random better candidate, J in {1, 2}.
bool Lyrebird::Escape(int i) {
  const int better = order_.Better(i);
  if (better == 0) return false;
  const double* safe = run_->x(order_.At(random_->Index(better)));
  const double* x = run_->x(i);
  std::uint64_t coins = random_->Bits();
  for (int j = 0; j < d_; ++j, coins >>= 1) {
    const double step = safe[j] - static_cast<double>(1 + (coins & 1)) * x[j];
    candidate_[j] = x[j] + random_->Uniform() * step;
  }
  return true;
}

// MBLSS, Eq. 20, 21: x' = b + z (m_k - x). With greedy acceptance a candidate's memory is its
// position, so no separate array is needed.
void Lyrebird::Imitate(int i) {
  const double* memory = run_->x(random_->Index(n_));
  const double* best = run_->x(run_->best());
  const double* x = run_->x(i);
  double z = random_->Uniform();
  for (int j = 0; j < d_; ++j) {
    if (vector_ && j > 0) z = random_->Uniform();
    candidate_[j] = best[j] + z * (memory[j] - x[j]);
  }
}

// Eq. 22: x' = x + (1 - 2 r) (u - l) / t.
void Lyrebird::Hide(int i, double t) {
  const Box& box = run_->box();
  const double* x = run_->x(i);
  for (int j = 0; j < d_; ++j) {
    candidate_[j] = x[j] + (1 - 2 * random_->Uniform()) * ((box.upper[j] - box.lower[j]) / t);
  }
}

// DMLSS. Eq. 23 is missing in print; here a crowded candidate moves towards a random other one.
void Lyrebird::Disperse(int i) {
  int other = static_cast<int>(random_->Index(n_ - 1));
  if (other >= i) ++other;
  const double* target = run_->x(other);
  const double* x = run_->x(i);
  for (int j = 0; j < d_; ++j) candidate_[j] = x[j] + random_->Uniform() * (target[j] - x[j]);
}

// Eq. 26, 27: greedy acceptance, in place.
void Lyrebird::Accept(int i) {
  const double value = run_->Evaluate(candidate_.data());
  if (!(value < run_->f(i))) return;
  run_->Replace(i, candidate_.data(), value);
  order_.Improved(i);
  if (!crowding_) return;
  for (int j = 0; j < d_; ++j) unit_[j] = Unit(candidate_[j], j);
  crowding_->Move(i, unit_.data());
}

double Lyrebird::Unit(double x, int j) const {
  const Box& box = run_->box();
  const double side = box.upper[j] - box.lower[j];
  return side > 0 ? (x - box.lower[j]) / side : 0;
}

std::vector<double> Lyrebird::UnitPopulation() {
  std::vector<double> unit(static_cast<std::size_t>(n_) * d_);
  for (int i = 0; i < n_; ++i) {
    for (int j = 0; j < d_; ++j)
      unit[static_cast<std::size_t>(i) * d_ + j] = Unit(run_->x(i)[j], j);
  }
  return unit;
}

}  // namespace

void RunLyrebird(SearchRun* run, const SearchOptions& options) {
  RandomStream random(options.seed, options.run);
  DrawPopulation(run, &random, options.iterations, options.algorithm == Algorithm::kMloShape);
  if (run->stopped()) return;
  Lyrebird population(run, options, &random);
  for (std::int64_t t = 1; !run->stopped(); ++t) {
    population.Move(static_cast<double>(t), options.iterations);
    run->EndIteration(t, options.iterations);
  }
}

}  // namespace lyrefit
