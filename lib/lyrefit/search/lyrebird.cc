// The lyrebird optimizer (LO) and its modification (MLO), after J. Ind. Manag. Optim. 22(1),
// 642-690, section 3; equation numbers are that paper's. One algorithm, four settings: LO has Pm =
// gamma = 0.
//
// What the paper leaves open and we chose: r and the integers J are drawn per coordinate (only this
// reaches the paper's LO figures); in Eq. 20 the memory is that of a random bird and z is one
// number a move (the bird's own memory, read literally, equals its position and collapses the
// search); Eq. 23 and 24 are lost in print, and the form below is ours.

#include <algorithm>
#include <numeric>
#include <optional>

#include "lyrefit/base/random.h"
#include "lyrefit/search/crowding.h"
#include "lyrefit/search/run.h"

namespace lyrefit {
namespace {

// Birds by rising objective value, so that "a random bird better than i" needs no scan.
class Ranking {
 public:
  explicit Ranking(const SearchRun& run)
      : run_(run), order_(run.population()), rank_(order_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(),
                     [&](int a, int b) { return run.f(a) < run.f(b); });
    for (std::size_t r = 0; r < order_.size(); ++r) rank_[order_[r]] = static_cast<int>(r);
  }

  // How many birds are strictly better: they are order_[0 .. count - 1], the safe set S_i of
  // Eq. 18.
  int Better(int bird) const {
    int count = rank_[bird];
    while (count > 0 && run_.f(order_[count - 1]) == run_.f(bird)) --count;
    return count;
  }
  int At(int rank) const { return order_[rank]; }

  // Bird has become better: let it rise to its place.
  void Improved(int bird) {
    int r = rank_[bird];
    for (; r > 0 && run_.f(order_[r - 1]) > run_.f(bird); --r) {
      order_[r] = order_[r - 1];
      rank_[order_[r]] = r;
    }
    order_[r] = bird;
    rank_[bird] = r;
  }

 private:
  const SearchRun& run_;
  std::vector<int> order_;
  std::vector<int> rank_;
};

class Lyrebird {
 public:
  Lyrebird(SearchRun* run, const SearchOptions& options)
      : run_(run),
        random_(options.seed, options.run),
        d_(run->dimensions()),
        n_(run->population()),
        iterations_(options.iterations),
        memory_rate_(Has(options, Algorithm::kLoMblss) ? options.memory_rate : 0),
        gamma_(Has(options, Algorithm::kLoDmlss) ? options.distance_coefficient : 0),
        candidate_(d_),
        unit_(d_) {}

  void Run() {
    DrawPopulation(run_, &random_, iterations_);
    if (run_->stopped()) return;
    ranking_.emplace(*run_);
    if (gamma_ > 0) crowding_.emplace(n_, d_, UnitPopulation());
    for (std::int64_t t = 1; !run_->stopped(); ++t) {
      for (int i = 0; i < n_ && !run_->stopped(); ++i) {
        if (Propose(i, static_cast<double>(t))) Accept(i);
      }
      run_->EndIteration(t, iterations_);
    }
  }

 private:
  static bool Has(const SearchOptions& options, Algorithm strategy) {
    return options.algorithm == Algorithm::kMlo || options.algorithm == strategy;
  }

  // Fills candidate_; false where the bird stays.
  bool Propose(int i, double t) {
    const bool escape = random_.Uniform() < 0.5;
    if (escape) {
      if (memory_rate_ > 0 && random_.Uniform() < memory_rate_ * t / iterations_) {
        Imitate(i);
      } else if (!Escape(i)) {
        return false;
      }
    } else if (gamma_ > 0 && crowding_->MeanDistance(i) < gamma_ * crowding_->LargestDistance()) {
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

  // Eq. 18, 19: x' = x + r (s - J x), s a random better bird, J in {1, 2}.
  bool Escape(int i) {
    const int better = ranking_->Better(i);
    if (better == 0) return false;
    const double* safe = run_->x(ranking_->At(random_.Index(better)));
    const double* x = run_->x(i);
    std::uint64_t coins = random_.Bits();
    for (int j = 0; j < d_; ++j, coins >>= 1) {
      const double step = safe[j] - static_cast<double>(1 + (coins & 1)) * x[j];
      candidate_[j] = x[j] + random_.Uniform() * step;
    }
    return true;
  }

  // MBLSS, Eq. 20, 21: x' = b + z (m_k - x). Acceptance is greedy and memories follow improvements,
  // so a bird's memory is its position and needs no array of its own.
  void Imitate(int i) {
    const double* memory = run_->x(random_.Index(n_));
    const double* best = run_->x(run_->best());
    const double* x = run_->x(i);
    const double z = random_.Uniform();
    for (int j = 0; j < d_; ++j) candidate_[j] = best[j] + z * (memory[j] - x[j]);
  }

  // Eq. 22: x' = x + (1 - 2 r) (u - l) / t.
  void Hide(int i, double t) {
    const Box& box = run_->box();
    const double* x = run_->x(i);
    for (int j = 0; j < d_; ++j) {
      candidate_[j] = x[j] + (1 - 2 * random_.Uniform()) * ((box.upper[j] - box.lower[j]) / t);
    }
  }

  // DMLSS, Eq. 23: a crowded bird moves towards a random other one.
  void Disperse(int i) {
    int other = static_cast<int>(random_.Index(n_ - 1));
    if (other >= i) ++other;
    const double* target = run_->x(other);
    const double* x = run_->x(i);
    for (int j = 0; j < d_; ++j) candidate_[j] = x[j] + random_.Uniform() * (target[j] - x[j]);
  }

  // Eq. 26, 27: greedy, in place.
  void Accept(int i) {
    const double value = run_->Evaluate(candidate_.data());
    if (!(value < run_->f(i))) return;
    run_->Replace(i, candidate_.data(), value);
    ranking_->Improved(i);
    if (!crowding_) return;
    for (int j = 0; j < d_; ++j) unit_[j] = Unit(candidate_[j], j);
    crowding_->Move(i, unit_.data());
  }

  double Unit(double x, int j) const {
    const Box& box = run_->box();
    const double side = box.upper[j] - box.lower[j];
    return side > 0 ? (x - box.lower[j]) / side : 0;
  }

  std::vector<double> UnitPopulation() {
    std::vector<double> unit(static_cast<std::size_t>(n_) * d_);
    for (int i = 0; i < n_; ++i) {
      for (int j = 0; j < d_; ++j)
        unit[static_cast<std::size_t>(i) * d_ + j] = Unit(run_->x(i)[j], j);
    }
    return unit;
  }

  SearchRun* run_;
  RandomStream random_;
  const int d_;
  const int n_;
  const int iterations_;
  const double memory_rate_;
  const double gamma_;
  std::vector<double> candidate_;
  std::vector<double> unit_;
  std::optional<Ranking> ranking_;
  std::optional<Crowding> crowding_;
};

}  // namespace

void RunLyrebird(SearchRun* run, const SearchOptions& options) { Lyrebird(run, options).Run(); }

}  // namespace lyrefit
