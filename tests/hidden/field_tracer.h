#pragma once

#include <map>
#include <vector>

#include "hidden/field_departure.h"
#include "hidden/field_module.h"
#include "hidden/field_sky.h"
#include "hidden/random.h"

namespace hidden::field {

// The curve of a module under any light near 1, out of curves at a ladder of lights that are made
// when they are needed.
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

// kEven, kBinned: voltage in equal steps of time; kBinned takes many readings and hands over the
// means of few. kCapacitor: the module charges one, readings in equal times. kKnee: equal steps
// along the curve.
enum class Drive { kEven, kBinned, kCapacitor, kKnee };

// All as parts: voltages of the open circuit, currents of the short-circuit current.
struct Tracer {
  Drive drive = Drive::kEven;
  int points = 100;  // of a sweep
  bool down = false;
  bool up_and_down = false;
  bool writes_times = false;
  double seconds = 1;
  double first_voltage = 0.01;
  double last_voltage = 1.01;  // a capacitor stops sooner:
  double last_current = 0.01;  // here
  int averaged = 1;            // readings
  double current_noise = 1e-4;
  double voltage_noise = 1e-4;
  double current_step = 0;  // resolution; 0: none
  double voltage_step = 0;
  double fine_below = 0;  // a ten times finer range begins; 0: there is none
  double fine_gain = 1;
  double voltage_bin = 0;         // readings are taken to the middle of a bin; 0: none
  double voltage_end = 1e300;     // what is above is recorded as this
  double least_current = -1e300;  // below which the load does not go: it stays there
};

enum class Bench { kLaboratory, kField };
Tracer DrawTracer(Bench bench, Random* random);

// Charge in the junctions: the current it takes where the voltage moves, as parts.
struct Charge {
  double constant = 0;   // of Isc at the mean speed of the sweep
  double diffusion = 0;  // the curve's shift, of the open circuit, at that speed
};

// The readings' true voltages and times (0 to 1), before noise; with every averaged one.
struct Instant {
  double voltage;
  double time;
  double speed;  // of the voltage over its mean size, with its sign
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

// Without anything the tracer or the air adds: no departure, no wandering, no noise.
Readings Exact(const Rig& rig, Lit* lit);
Readings Measured(const Rig& rig, Lit* lit, Random* random);

double OpenCircuit(const Sampled& curve);
double ShortCircuit(const Sampled& curve);

}  // namespace hidden::field
