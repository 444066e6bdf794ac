#pragma once

#include <chrono>
#include <string>

#include "lyrefit/base/observer.h"

namespace lyrefit {

// Where a run stands, from what its observer heard, and how long it will take. Seconds count from
// the beginning of the run.
class ProgressText {
 public:
  // `whole`: the stage that is the whole run; empty: none is.
  explicit ProgressText(std::string whole) : whole_(std::move(whole)) {}

  void Hear(const Progress& progress, double seconds);

  // "compare [#########...........] 405 of 900, about 25 s left", "outlier curves, 12 s"; empty as long
  // as there is nothing to say.
  std::string Line(double seconds) const;

  // Once: how long the run will take, as soon as that is known to exceed a minute, or that it has
  // taken a minute, in words; else empty.
  std::string LongRun(double seconds);

 private:
  double Part() const;                       // of the stage; 0: not known
  double SecondsLeft(double seconds) const;  // of the stage; negative: not known

  std::string whole_;
  std::string stage_;
  Progress last_;
  std::string note_;
  double begin_s_ = 0;     // of the stage
  double begin_part_ = 0;  // of the stage that an earlier process did
  double heard_s_ = 0;     // when the part last changed
  double heard_part_ = 0;
  bool said_ = false;
};

// "about 25 s", "about 4 minutes", "about 2 h 10 min"
std::string AboutText(double seconds);

}  // namespace lyrefit
