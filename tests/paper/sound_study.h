#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/certify/certify.h"
#include "paper/planted.h"

namespace lyrefit {

struct SoundOptions {
  int problems = 1000;
  std::uint64_t seed = 0;
  std::int64_t effort = 5000;  // see CertifyOptions
  int threads = 0;
};

// One proved bound beside the lowest RMSE that is known to be attained within the same ranges.
struct HeldBound {
  double lower_bound_A = 0;
  double best_A = kInfinity;  // of the planted parameters, of searches, of the certificate itself
  double gap = 0;             // of the certificate
  bool certified = false;
  bool violated =
      false;  // the bound lies above the best by more than rounding, 1e-14 of the current
  double above() const { return lower_bound_A / best_A - 1; }
};

// The certificate of a curve held against all that is known of it.
struct HeldCertificate {
  std::string name;
  Objective objective = Objective::kMeasuredCurrent;
  int points = 0;
  double n_upper = 0;  // of the range
  HeldBound floor;
  std::vector<HeldBound> models;  // of one, two and three diodes, as many as were asked for
  double seconds = 0;
  // Of made problems alone.
  double noise = 0;
  Planted planted = Planted::kNothing;
  int diodes = 0;                // of the device
  double planted_A = kInfinity;  // RMSE of its parameters

  int violations() const;
};

// Every certificate of a study, or what was done of it when it was interrupted.
struct SoundStudy {
  std::string version;
  SoundOptions options;
  std::vector<HeldCertificate>
      held;          // made: both objectives of the first problem, of the second ...
  int unusable = 0;  // measured curves of which no certificate is to be had
  double seconds = 0;
  bool interrupted = false;
};

// Certifies and holds against searches of its own: refined starts of a grid and at random, and of
// `known` parameters of one model; where there are none, against what `fit` reaches with n in [1, 2].
Expected<HeldCertificate> HoldCertificate(const IvCurve& curve, const CertifyOptions& options,
                                          Model model, const std::vector<double>& known,
                                          std::uint64_t seed, const Observer& observer = {});

// Made problems, both objectives of each.
Expected<SoundStudy> StudyMade(const SoundOptions& options, const Observer& observer = {});

// Made problems with wide ranges of Rs, measured-current.
Expected<SoundStudy> StudyWide(const SoundOptions& options, const Observer& observer = {});

// Every curve of `folder` that its labels.csv names, n in [1, 2], one and two diodes, both objectives;
// what `fit` reaches is among what is known. Errors: no such table.
Expected<SoundStudy> StudyMeasured(const std::string& folder, const SoundOptions& options,
                                   const Observer& observer = {});

}  // namespace lyrefit
