#pragma once

#include <optional>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/search/bird_order.h"
#include "lyrefit/search/crowding.h"
#include "lyrefit/search/learned_setting.h"
#include "lyrefit/search/run.h"

namespace lyrefit {

// The moves of a flock of lyrebirds, which are the birds of a run (equations: lyrebird.cc).
class Lyrebird {
 public:
  Lyrebird(SearchRun* run, const SearchOptions& options, RandomStream* random);

  // The birds have been drawn: takes in where they are.
  void Settle();

  // Iteration `t` of `planned` since then: every bird moves, until the run stops.
  void Move(double t, double planned);

 private:
  struct Learned {
    LearnedSetting rate;
    LearnedSetting gamma;
  };

  bool Propose(int i, double t, double planned);
  double MemoryRate();
  double Gamma();
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
  const bool keeps_distances_;
  std::vector<double> candidate_;
  std::vector<double> unit_;
  std::optional<BirdOrder> order_;
  std::optional<Crowding> crowding_;
  std::optional<Learned> learned_;
  bool escaped_ = false;  // the move at hand
  double drawn_ = 0;      // and the learned setting's value for it
};

}  // namespace lyrefit
