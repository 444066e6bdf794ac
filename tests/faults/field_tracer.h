#pragma once

#include <map>
#include <vector>

#include "faults/field_departure.h"
#include "faults/field_module.h"
#include "faults/field_sky.h"
#include "faults/random.h"

namespace faults::field {

// Curve of a module under any light near 1, interpolated between curves at fixed light levels.
// These are computed on demand.
class Lit {
 public:
  explicit Lit(const Module& module) : module_(module) {}
  double Current(double voltage, double light);
  const Sampled& Whole() { return Rung(0); }  // at light 1

 private:
  const Sampled& Rung(int rung);
  Module module_;
  std::map<int, Sampled> rungs_;
};

// kEven, kBinned: voltage in equal steps of time; kBinned averages many readings into few.
// kCapacitor: the module charges a capacitor, with readings at equal times. kKnee: equal steps of
// arc length along the curve.
enum class Drive { kEven, kBinned, kCapacitor, kKnee };

// Voltages are fractions of the open-circuit voltage, currents fractions of the short-circuit
// current.
struct Tracer {
  Drive drive = Drive::kEven;
  int points = 100;  // per sweep
  bool down = false;
  bool up_and_down = false;
  bool writes_times = false;
  double seconds = 1;
  double first_voltage = 0.01;
  double last_voltage = 1.01;  // a capacitor drive stops earlier,
  double last_current = 0.01;  // at this current
  int averaged = 1;            // readings per mean
  double current_noise = 1e-4;
  double voltage_noise = 1e-4;
  double current_step = 0;  // resolution; 0: none
  double voltage_step = 0;
  double fine_below = 0;  // below this current a ten times finer range applies; 0: none
  double fine_gain = 1;
  double voltage_bin = 0;         // readings are moved to the centre of a bin; 0: none
  double voltage_end = 1e300;     // higher voltages are recorded as this value
  double least_current = -1e300;  // lower limit of the recorded current
};

enum class Bench { kLaboratory, kField };
Tracer DrawTracer(Bench bench, Random* random);

// Current that charges the junction capacitances while the voltage changes.
struct Charge {
  double constant = 0;   // fraction of Isc at the mean speed of the sweep
  double diffusion = 0;  // shift of the curve at that speed, fraction of the open-circuit voltage
  double fall = 0;       // both are less at Isc, by the factor 1 + fall
};

// True voltage and time (0 to 1) of one reading before noise. Readings that are averaged are listed
// one by one.
struct Instant {
  double voltage;
  double time;
  double speed;  // signed rate of the voltage over its mean magnitude
  int sweep;
};
std::vector<Instant> Instants(const Tracer& tracer, const Sampled& curve);

struct Readings {
  std::vector<double> voltage;
  std::vector<double> current;
  std::vector<double> time;  // 0 to 1
  std::vector<int> sweep;
};

struct Rig {
  Module module;
  Sky sky;
  Departure departure;
  Charge charge;
  Tracer tracer;
};

// Exact readings, without the departure, fluctuation, noise and rounding.
Readings Exact(const Rig& rig, Lit* lit);
Readings Measured(const Rig& rig, Lit* lit, Random* random);

double OpenCircuit(const Sampled& curve);
double ShortCircuit(const Sampled& curve);

}  // namespace faults::field
