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

// A proved bound, and the lowest RMSE known to be reached within the ranges of the proof.
struct HeldBound {
  double lower_bound_A = 0;
  double best_A = kInfinity;  // lowest of the planted parameters, searches and the certificate
                              // itself
  double gap = 0;             // of the certificate
  bool certified = false;
  bool violated =
      false;  // the bound lies above the best by more than rounding, 1e-14 of the current
  double above() const { return lower_bound_A / best_A - 1; }
};

// The certificate of a curve, checked against all known parameter sets.
struct HeldCertificate {
  std::string name;
  Objective objective = Objective::kMeasuredCurrent;
  int points = 0;
  double n_upper = 0;  // of the range
  HeldBound floor;
  std::vector<HeldBound> models;  // one per number of diodes, from one on
  double seconds = 0;
  // For synthetic problems only.
  double noise = 0;
  Planted planted = Planted::kNothing;
  int diodes = 0;                // of the device
  double planted_A = kInfinity;  // RMSE of the parameters of the device

  int violations() const;
};

// All certificates of a study. Empty if it was interrupted.
struct SoundStudy {
  std::string version;
  SoundOptions options;
  std::vector<HeldCertificate>
      held;          // synthetic: both objectives of the first problem, then of the second ...
  int unusable = 0;  // measured curves without a certificate
  double seconds = 0;
  bool interrupted = false;
};

// Certifies a curve and compares the bounds with searches: refined starts from a grid, at random,
// and from the `known` parameters of `model`. If `known` is empty, also with the result of `fit`,
// with n in [1, 2].
Expected<HeldCertificate> HoldCertificate(const IvCurve& curve, const CertifyOptions& options,
                                          Model model, const std::vector<double>& known,
                                          std::uint64_t seed, const Observer& observer = {});

// Synthetic problems, both objectives of each.
Expected<SoundStudy> StudySynthetic(const SoundOptions& options, const Observer& observer = {});

// Synthetic problems with wide ranges of Rs, measured-current.
Expected<SoundStudy> StudyWide(const SoundOptions& options, const Observer& observer = {});

// Every curve of `folder` listed in its labels.csv, with n in [1, 2], one and two diodes and both
// objectives. The known values include the result of `fit`. Errors: no such table.
Expected<SoundStudy> StudyMeasured(const std::string& folder, const SoundOptions& options,
                                   const Observer& observer = {});

}  // namespace lyrefit
