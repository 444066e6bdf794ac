#pragma once

#include <string>
#include <vector>

#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// A curve that could be taken besides. Its currents are not known yet.
struct PlannedCurve {
  Readings readings;
  // Follows the sweep that was taken at once, under its sky: what happens in time goes on. Else
  // nothing that happened in time comes again.
  bool at_once = false;
  bool open_circuit = false;  // readings beyond 0 V are of Voc: the law says where
  int covered = -1;           // of `groups` bypass groups; -1: none
  int groups = 1;
  // Which of the measurement's unknowns its light, temperature and bypass drop have; -1: known.
  int light = -1;
  int temperature = -1;
  int drop = -1;
};

struct FollowUp {
  std::string id;
  std::string title;
  std::string taken;
  std::vector<PlannedCurve> curves;
  // Standard deviations of what is not known of it beforehand: of a light in parts, of a
  // temperature in K, of a bypass drop in V per cell.
  std::vector<double> unknown;
};

// Every further measurement that the readings' kind admits.
std::vector<FollowUp> FollowUpMeasurements(const Readings& measured);

// What a law becomes on a further curve.
struct CurveLaw {
  Law law;
  std::vector<int> from;  // the parameter of the whole law that each of its own is
  std::vector<double> p;  // its own, at those of the whole law
};
CurveLaw LawOn(const PlannedCurve& curve, const Law& law, const std::vector<double>& p);

// The readings under what turned out to be unknown, of this curve.
Readings Under(const PlannedCurve& curve, const std::vector<double>& unknown);

}  // namespace lyrefit
