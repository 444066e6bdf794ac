#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/fit/simulate.h"
#include "lyrefit/study/landscape.h"

// How the devices of landscape.h are drawn: each function takes one from the stream. An error is a
// draw that no device has: the next one from the same stream stands in for it.
namespace lyrefit {

// Where a tracer reads a sweep, in even steps of what.
enum class Tracer {
  kVoltage,
  kArc,     // length along the curve, of both axes in parts of Voc and of the largest current
  kCharge,  // time while the device charges a capacitor
};

// A device and how it is to be measured and fitted.
struct DrawnDevice {
  SimulateOptions made;  // with noise and its seed
  int bypass_diodes = 0;
  Tracer tracer = Tracer::kVoltage;
  double beyond = 1;  // last voltage in parts of Voc
  BoundsSpec bounds;
  std::vector<EffectUse> with;  // of the fit
};

using Values = std::map<std::string, double>;
using Ranges = std::map<std::string, std::pair<double, double>>;
EffectUse Held(const char* effect, const Values& values);  // as a simulation has it
EffectUse Freed(const char* effect, Ranges ranges);        // as a fit has it

// Cells of one diode: Isc 4 to 10 A, Voc 0.58 to 0.68 V, n 1 to 1.4, Rs 1 to 4 % and Rsh 20 to 1000
// times Voc / Isc. A module of `substrings` bypass diodes and 12 to 24 cells under each, read at 60
// to 150 points with noise of 2e-4 to 2e-3 of Isc.
DrawnDevice DrawModule(int substrings, RandomStream* random);

// How a device is read: tracer, where it stops, number of points, noise in parts of `isc_A` as
// stated.
void DrawMeasurement(double isc_A, double least_noise, double most_noise, RandomStream* random,
                     DrawnDevice* device);

// Reads it.
Expected<LandscapeCase> Measure(const DrawnDevice& device);

// `lights` equal substrings, a light each.
Expected<LandscapeCase> DrawLights(int lights, RandomStream* random);
// 3 to 6 substrings of which groups of different size have a light each; in groups `covered`, part
// of the cells alone.
Expected<LandscapeCase> DrawUnlikeLights(bool covered, RandomStream* random);
Expected<LandscapeCase> DrawWeakCell(ReverseLaw law, RandomStream* random);
Expected<LandscapeCase> DrawShadeAndStep(RandomStream* random);
Expected<LandscapeCase> DrawShadeAndShunt(RandomStream* random);
Expected<LandscapeCase> DrawThreeDiodes(RandomStream* random);
// `effects`: the sensors' offsets are effects of the law instead of options of the fit.
Expected<LandscapeCase> DrawFamily(bool effects, RandomStream* random);

}  // namespace lyrefit
