#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <vector>
#include "hidden/adapter.h"

#include "hidden/judge.h"

namespace hidden {

struct StudyOptions {
  std::string mode;
  std::string kind = "all";
  std::string effect = "all";
  std::string csv;   // file for the table; empty: none
  std::string rows;  // file for every case; empty: none
  int cases = 0;     // 0: the mode's own number
  int number = 0;    // of the case to show
  double level = 0.05;
  std::uint64_t seed = 1;
  std::string asked;  // "laboratory" or "field"; empty: as the world is
  int threads = 0;    // 0: as many as there are processors
  // Of `field`:
  double misfit_above = 0;  // % of Isc; of the cases with a fault
  std::string show;         // kind of which case `number` is written as a table
  std::string dump;         // folder for the cases as tables
};

Mode ModeOf(const StudyOptions& options);

// Rates of false alarms on nulls of every kind and noise, at the level and at 0.01.
int StudySilence(const StudyOptions& options);
// Found and named, by kind, effect and how strongly the effect shows.
int StudyPower(const StudyOptions& options);
// Whether two effects at once are both named.
int StudyPairs(const StudyOptions& options);
// Which name comes first for each effect that shows with at least 7 noise units.
int StudyConfusion(const StudyOptions& options);
// How often the 95 % interval of a named effect's size holds the truth.
int StudySize(const StudyOptions& options);
// The second world, modules in the field (field_*.h): named at all, by the right name, spurious
// claims, lights and shares; or its cases as tables. `effect` is a kind of field_case.h.
int StudyField(const StudyOptions& options);
// One case of `power` or, without an effect, of `silence`, as a table of readings; what is in it
// and what is answered go to the error output.
int ShowCase(const StudyOptions& options);

// body(0) .. body(count - 1), each writing only to its own slot.
void ForEach(int count, int threads, const std::function<void(int)>& body);

// A hidden effect, how strongly it shows and what was answered; made is false where no device drawn
// had room for it.
struct Run {
  bool made = false;
  Case hidden;
  Answer answer;
};
Request RequestFor(const StudyOptions& options, Kind kind, const Hide& hide, int number,
                   double lowest, double highest);
Case NullFor(const StudyOptions& options, Kind kind, int number);
std::vector<Run> RunCases(const StudyOptions& options, Kind kind, const Hide& hide, int cases,
                          double lowest, double highest);

std::vector<const Hide*> HidesCalled(const std::string& name, Kind kind);

// "drift|temp_drift clip": every claim with its set.
std::string Text(const Answer& answer);

double Percent(int part, int whole);  // NaN of nothing

}  // namespace hidden
