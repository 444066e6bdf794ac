// The command translate_study: tables of the accuracy of translated curves.
#pragma once

#include <string>

namespace shown {

struct StudyOptions {
  std::string data;  // folder of field measurements
  int every = 3;     // uses every n-th sweep of a measured set
  int pairs = 1500;
  int cases = 0;  // 0: default of the mode
  unsigned seed = 1;
  int threads = 0;
};

// Sandia and NIST: all procedures, with 1, 0.7 and 1.4 times the observed scatter of the
// conditions.
int StudySets(const StudyOptions& options);
// Procedure uncertainties fitted to one half of the Sandia sweeps and tested on the other half.
int StudyHalves(const StudyOptions& options);
// Procedure uncertainties fitted to each measured set and each simulator separately.
int StudySizes(const StudyOptions& options);
// Simulated healthy devices, which follow other laws than the procedures, translated to STC.
int StudySynthetic(const StudyOptions& options);
// Simulated healthy devices whose cells are warmer than the sensor, with and without a correction.
int StudySensors(const StudyOptions& options);
// Simulated healthy devices without a stated beta.
int StudyBeta(const StudyOptions& options);
// Modules simulated cell by cell, with a fault, translated to STC.
int StudyFaults(const StudyOptions& options);
// Real curves with and without faults.
int StudyReal(const StudyOptions& options);

}  // namespace shown
