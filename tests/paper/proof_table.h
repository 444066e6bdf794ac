#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/certify/certify.h"

namespace lyrefit {

// What another program proves of one curve and model, by its own log.
struct ForeignProof {
  std::string curve;
  Model model = Model::kSingleDiode;
  double best_A2 = 0;         // sum of squares, measured-current
  double lower_bound_A2 = 0;  // 0: nothing is proved
  double seconds = 0;
};

// proofs.csv of ../published: of each curve and model the last run that looked at anything.
Expected<std::vector<ForeignProof>> ReadForeignProofs(const std::string& path);

// One proof: a model within a box, and how long it takes alone, its floor included.
struct ProofRow {
  std::string curve;
  int points = 0;
  std::string box;  // "literature"
  CertifyOptions options;
  ModelCertificate proof;
  double seconds = 0;
  double rigorous_lower_A = 0;  // in intervals; 0: not asked for
  double rigorous_seconds = 0;
};

// Every shipped curve in every box there is for it, each model, both objectives.
struct ProofTable {
  std::vector<ProofRow> rows;
  std::vector<ForeignProof> foreign;
  bool interrupted = false;
};

// The curves lie in folders below `folder`. `effort`: see CertifyOptions; 0 threads: all cores.
Expected<ProofTable> ProveShipped(const std::string& folder, std::int64_t effort, int threads,
                                  const Observer& observer = {});

}  // namespace lyrefit
