#pragma once

#include <string>
#include <vector>

#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// A curve that could be measured in addition. Its currents are not known yet.
struct PlannedCurve {
  Readings readings;
  // Measured immediately after the sweep, under the same conditions: effects of the sweep continue.
  // Otherwise effects of the sweep do not act on it.
  bool at_once = false;
  bool open_circuit = false;  // readings above 0 V are at the law's Voc
  int covered = -1;           // covered bypass group, 0 .. `groups` - 1; -1: none
  int groups = 1;
  // Positions in FollowUp::unknown of its light, temperature and bypass drop; -1: known.
  int light = -1;
  int temperature = -1;
  int drop = -1;
};

struct FollowUp {
  std::string id;
  std::string title;
  std::string taken;
  std::vector<PlannedCurve> curves;
  // Prior standard deviations of the unknowns: irradiance as a fraction, temperature in K, bypass
  // drop in V per cell.
  std::vector<double> unknown;
};

// All further measurements that are possible for readings of this type.
std::vector<FollowUp> FollowUpMeasurements(const Readings& measured);

// A law restricted to a further curve. Its coordinates (law_coordinates.h) are of the cells that
// this curve measures, unlike its parameters.
struct CurveLaw {
  Law law;
  std::vector<int> from;      // position in the whole law of each of its coordinates
  std::vector<double> theta;  // its coordinates
};
CurveLaw LawOn(const PlannedCurve& curve, const Law& law, const std::vector<double>& theta);

// The readings of a curve under given values of the unknowns, in the units of FollowUp::unknown.
Readings Under(const PlannedCurve& curve, const std::vector<double>& unknown);

}  // namespace lyrefit
