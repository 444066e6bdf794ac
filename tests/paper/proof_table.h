#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/certify/certify.h"

namespace lyrefit {

// Bound that another program proves for a curve and model, from its own log.
struct ForeignProof {
  std::string curve;
  Model model = Model::kSingleDiode;
  double best_A2 = 0;         // sum of squares, measured-current
  double lower_bound_A2 = 0;  // 0: no bound
  double seconds = 0;
};

// Reads published/proofs.csv. A later run of a curve and model replaces an earlier one only if it
// examined more cells.
Expected<std::vector<ForeignProof>> ReadForeignProofs(const std::string& path);

// One proof of a model within a box. `seconds` is its time on one core, including the floor.
struct ProofRow {
  std::string curve;
  int points = 0;
  std::string box;  // name of the bounds, "literature"
  CertifyOptions options;
  ModelCertificate proof;
  double seconds = 0;
  double rigorous_lower_A = 0;  // by interval arithmetic; 0: not computed
  double rigorous_seconds = 0;
};

// All shipped curves in all their boxes, each model, both objectives.
struct ProofTable {
  std::vector<ProofRow> rows;
  std::vector<ForeignProof> foreign;
  bool interrupted = false;
};

// Proves the bounds of the curves in the folders below `folder`. `effort`: see CertifyOptions.
// `threads` 0: all cores.
Expected<ProofTable> ProveShipped(const std::string& folder, std::int64_t effort, int threads,
                                  const Observer& observer = {});

}  // namespace lyrefit
