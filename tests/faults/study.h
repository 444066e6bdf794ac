#pragma once

#include <cstdint>
#include <string>

#include <vector>
#include "faults/adapter.h"
#include "faults/for_each.h"
#include "faults/score.h"

namespace faults {

struct StudyOptions {
  std::string mode;
  std::string kind = "all";
  std::string effect = "all";
  std::string csv;         // file of the table; empty: none
  std::string rows;        // file of all cases; empty: none
  int cases = 0;           // 0: default of the mode
  int number = 0;          // index of the case to show
  double probability = 0;  // of a cause that is named; 0: the default of the mode
  std::uint64_t seed = 1;
  std::string asked;  // "laboratory" or "field"; empty: that of the simulator
  std::string real;   // folder of labelled sweeps
  int threads = 0;    // 0: one per processor
  // For the mode `field`:
  double misfit_above = 0;  // minimum misfit of the cases with a fault, % of Isc
  std::string show;         // kind whose case `number` is written as a table
  std::string dump;         // folder for the cases as tables
};

Mode ModeOf(const StudyOptions& options);

// False-alarm rates on cases without an effect, by kind of data and noise, at `probability` and at 0.99.
int StudySilence(const StudyOptions& options);
// Detection and identification rates by kind of data, effect and misfit.
int StudyPower(const StudyOptions& options);
// How often both of two simultaneous effects are named.
int StudyPairs(const StudyOptions& options);
// Field simulator (field_*.h): rates of cases with a claim, of right names and of spurious claims,
// and the errors of lights and shares. Or writes its cases as tables. `effect` is a kind of
// field_case.h.
int StudyField(const StudyOptions& options);
// Stated probabilities beside the share that is true, in tenths: of every finding before one is
// named, and of the first that is named. Causes are as common as the diagnosis takes them to be.
// `asked` is the world; `real` is a folder of labelled sweeps in its place.
int StudyCalibration(const StudyOptions& options);
// Writes one case of `power` or, without an effect, of `silence` as a table of readings. The causes
// and the answer go to standard error.
int ShowCase(const StudyOptions& options);

// A simulated case and its answer. `made` is false if none of the drawn devices could have the
// effect.
struct Run {
  bool made = false;
  Case with_fault;
  Answer answer;
};
Request RequestFor(const StudyOptions& options, Kind kind, const Injection& injection, int number,
                   double lowest, double highest);
Case NullFor(const StudyOptions& options, Kind kind, int number);
std::vector<Run> RunCases(const StudyOptions& options, Kind kind, const Injection& injection,
                          int cases, double lowest, double highest);

std::vector<const Injection*> HidesCalled(const std::string& name, Kind kind);

// All claims with their equivalent names, as in "drift|temp_drift clip".
std::string Text(const Answer& answer);

double Percent(int part, int whole);  // NaN if `whole` is 0

}  // namespace faults
