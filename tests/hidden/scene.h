#pragma once

#include <vector>

#include "hidden/effects.h"
#include "hidden/noise.h"
#include "hidden/plan.h"

namespace hidden {

struct Outlier {
  int point;
  double sigmas;
};

// Everything that decides what the readings will be, but for the draw of the noise.
struct Scene {
  Device device;
  Effects effects;
  Plan plan;
  Noise noise;
  std::vector<Outlier> outliers;
  double resolution_A = 0;   // a step that is to be found; 0: only the noise's own
  int stated_cells = 0;      // of the person at the bench; 0: as they are
  double stated_kelvin = 0;  // 0: as it is

  std::vector<double> Exact() const;   // with outliers, without noise and rounding
  std::vector<double> Sigmas() const;  // about the exact currents
};

// Norm of what is left of the exact currents after the best base model, in noise units; where the
// currents are rounded on purpose, of the rounding.
double Misfit(const Scene& scene);

// What a laboratory hands over.
struct Measurement {
  std::vector<double> voltage;
  std::vector<double> current;
  std::vector<double> time;  // empty where nobody wrote it down
  std::vector<int> sweep;
  std::vector<int> curve;
  std::vector<double> irradiance;   // W/m2
  std::vector<double> temperature;  // deg C
  int cells = 1;
  int bypass_diodes = 0;        // 0: not stated
  double bandgap_eV = 1.121;    // 0: not stated
  double isc_tempco_per_K = 0;  // 0: not stated
  bool thin_film = false;
  double noise_constant_A = 0;  // 0: not stated
  double noise_relative = 0;
};

Measurement Take(const Scene& scene, Random* random);

}  // namespace hidden
