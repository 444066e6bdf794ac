#pragma once

#include <vector>

#include "faults/effects.h"
#include "faults/noise.h"
#include "faults/plan.h"

namespace faults {

struct Outlier {
  int point;
  double sigmas;
};

// Complete description of a simulated measurement except for the random noise.
struct Scene {
  Device device;
  Effects effects;
  Plan plan;
  Noise noise;
  std::vector<Outlier> outliers;
  double resolution_A = 0;   // rounding step to be identified; 0: that of `noise`
  int stated_cells = 0;      // cells stated to the diagnosis; 0: the true number
  int stated_groups = 0;     // bypass diodes stated to the diagnosis; 0: the true number
  double stated_kelvin = 0;  // temperature stated to the diagnosis; 0: the true one

  std::vector<double> Exact() const;   // A; with outliers, without noise and rounding
  std::vector<double> Sigmas() const;  // A; about the exact currents
};

// Norm of the residuals of the best base model to the exact currents, in noise standard deviations.
// If `resolution_A` is set, the norm of the rounding errors instead.
double Misfit(const Scene& scene);

// Readings and metadata that the diagnosis gets.
struct Measurement {
  std::vector<double> voltage;
  std::vector<double> current;
  std::vector<double> time;  // empty: not recorded
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

}  // namespace faults
