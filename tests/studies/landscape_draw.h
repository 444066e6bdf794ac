#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/estimate/fit/simulate.h"
#include "studies/landscape.h"

// Random drawing of the devices of landscape.h. Each function draws one device from the stream. An
// error is a draw that no real device has. The caller then takes the next draw from the same
// stream.
namespace lyrefit {

// The quantity in which a tracer takes even steps along a sweep.
enum class Tracer {
  kVoltage,
  // Arc length of the curve, with the voltage relative to Voc and the current to the largest
  // current.
  kArc,
  kCharge,  // time while the device charges a capacitor
};

// A device with its measurement and its fit.
struct DrawnDevice {
  SimulateOptions made;  // the simulation, with noise and its seed
  int bypass_diodes = 0;
  Tracer tracer = Tracer::kVoltage;
  double beyond = 1;  // last voltage relative to Voc
  BoundsSpec bounds;
  std::vector<EffectUse> with;  // of the fit
};

using Values = std::map<std::string, double>;
using Ranges = std::map<std::string, std::pair<double, double>>;
EffectUse Held(const char* effect, const Values& values);  // the effect as a simulation has it
EffectUse Freed(const char* effect, Ranges ranges);        // the effect as a fit has it

// Draws a module with `substrings` bypass diodes and 12 to 24 cells under each. Cells have one
// diode, Isc 4 to 10 A, Voc 0.58 to 0.68 V and n 1 to 1.4. Rs is 1 to 4 % of Voc / Isc and Rsh 20
// to 1000 times Voc / Isc. The curve has 60 to 150 points with noise of 2e-4 to 2e-3 of Isc.
DrawnDevice DrawModule(int substrings, RandomStream* random);

// Draws the measurement of a device: tracer, last voltage, number of points and noise. The noise is
// relative to `isc_A` and lies between `least_noise` and `most_noise`.
void DrawMeasurement(double isc_A, double least_noise, double most_noise, RandomStream* random,
                     DrawnDevice* device);

// Simulates the measurement of the device.
Expected<LandscapeCase> Measure(const DrawnDevice& device);

// `lights` equal substrings, each with an irradiance of its own.
Expected<LandscapeCase> DrawLights(int lights, RandomStream* random);
// 3 to 6 substrings in groups of different size, each group with an irradiance of its own. If
// `covered`, only a part of the cells of a group is shaded.
Expected<LandscapeCase> DrawUnlikeLights(bool covered, RandomStream* random);
Expected<LandscapeCase> DrawWeakCell(ReverseLaw law, RandomStream* random);
Expected<LandscapeCase> DrawShadeAndStep(RandomStream* random);
Expected<LandscapeCase> DrawShadeAndShunt(RandomStream* random);
Expected<LandscapeCase> DrawThreeDiodes(RandomStream* random);
// `effects`: the sensor offsets are effects of the law instead of options of the fit.
Expected<LandscapeCase> DrawFamily(bool effects, RandomStream* random);

}  // namespace lyrefit
