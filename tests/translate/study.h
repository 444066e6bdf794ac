// The command translate_study: tables of how well curves are carried.
#pragma once

#include <string>

namespace shown {

struct StudyOptions {
  std::string data;  // folder of field measurements
  int every = 3;     // sweeps of a measured set
  int pairs = 1500;
  int cases = 0;  // 0: the mode's own number
  unsigned seed = 1;
  int threads = 0;
};

// Sandia and NIST: all procedures, with temperatures doubted half, once and twice as much.
int StudySets(const StudyOptions& options);
// Sizes fitted to one half of the Sandia sweeps, tried on the other.
int StudyHalves(const StudyOptions& options);
// Sizes fitted to every set and world by itself.
int StudySizes(const StudyOptions& options);
// Healthy devices by other laws than any procedure's, to standard conditions.
int StudyMade(const StudyOptions& options);
// The same where the cells are warmer than their sensor, corrected and not.
int StudySensors(const StudyOptions& options);
// The same where nobody states beta.
int StudyBeta(const StudyOptions& options);
// Modules of cells with a fault, to standard conditions.
int StudyFaults(const StudyOptions& options);
// Real curves with and without faults.
int StudyReal(const StudyOptions& options);

}  // namespace shown
