#pragma once

#include <chrono>
#include <string>

#include "lyrefit/base/observer.h"

namespace lyrefit {

// Progress of a run and its remaining time, from the calls of its observer. Seconds count from the
// start of the run.
class ProgressText {
 public:
  // `whole`: name of the stage that is the whole run; empty: none.
  explicit ProgressText(std::string whole) : whole_(std::move(whole)) {}

  void Hear(const Progress& progress, double seconds);

  // "compare [#########...........] 405 of 900, about 25 s left", "outlier curves, 12 s"; empty
  // before the first progress.
  std::string Line(double seconds) const;

  // Returned once: the expected duration as soon as it is known to exceed a minute, or that the run
  // has taken a minute. Otherwise empty.
  std::string LongRun(double seconds);

 private:
  double Part() const;                       // finished part of the stage; 0: not known
  double SecondsLeft(double seconds) const;  // for the stage; negative: not known

  std::string whole_;
  std::string stage_;
  Progress last_;
  std::string note_;
  double begin_s_ = 0;     // start of the stage
  double begin_part_ = 0;  // part of the stage finished by an earlier process
  double heard_s_ = 0;     // time of the last change of the part
  double heard_part_ = 0;
  bool said_ = false;
};

// "about 25 s", "about 4 minutes", "about 2 h 10 min"
std::string AboutText(double seconds);

}  // namespace lyrefit
