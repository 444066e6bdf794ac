#pragma once

#include <vector>

#include "faults/field_departure.h"
#include "faults/field_sky.h"
#include "faults/random.h"
#include "trend/years_module.h"
#include "trend/years_weather.h"

namespace years {

// Errors of the instruments of one module, constant unless said otherwise. Relative unless K or %.
struct Instruments {
  double light_gain = 1;
  double light_drift = 0;  // per year
  double light_noise = 0.003;
  double light_offset_Wm2 = 0;
  double light_cosine = 0;  // error at grazing light
  double kelvin_offset = 0;
  double kelvin_gap = 2;  // cells above the back at 1000 W/m2
  double kelvin_noise = 0.2;
  double current_gain = 1, voltage_gain = 1;  // of the tracer
  double noise = 5e-4;                        // of short circuit and open circuit
  double current_step_A = 12.0 / 16384, voltage_step_V = 50.0 / 16384;
  int points = 60;
  bool steady = false;                 // the light does not wander during a sweep
  faults::field::Departure departure;  // of the module from the law of its cells
};
Instruments DrawInstruments(const Design& design, int points, faults::Random* random);

struct Shown {
  double irradiance_Wm2, temperature_C;
};
Shown Sensed(const Instruments& instruments, const Instant& now, double years,
             faults::Random* random);

struct Sweep {
  std::vector<double> voltage, current;
};
Sweep Trace(const Instruments& instruments, const Instant& now, LitModule* module,
            faults::Random* random);
// A bad sweep: a cloud half way, spikes, a loose contact or nothing at all.
void Spoil(Sweep* sweep, faults::Random* random);

// The inverter at the maximum power point.
struct Inverter {
  double tracking = 0.004;   // rms error of the voltage
  double failing = 0.01;     // share of the readings far from the maximum
  double limit_W = 1e9;      // clips
  double curtailed = 0.02;   // share of the days, from 11 to 14 h,
  double curtailed_W = 1e9;  // at this power
  double noise = 0.002;
  double voltage_step_V = 0.1, current_step_A = 0.01;
};
Inverter DrawInverter(double rated_W, faults::Random* random);

enum class Mode { kTracking, kFailing, kClipped, kCurtailed };
struct Held {
  Operating at;
  Mode mode;
};
Held Hold(const Inverter& inverter, const Operating& maximum, bool curtailed, LitModule* module,
          faults::Random* random);

}  // namespace years
