#pragma once

#include <string>

#include "paper/proof_table.h"

namespace lyrefit {

// Replaces the blocks "proofs" (all rows) and "proofs-short" (the bounds of publications) in
// `page`. Blocks that `page` does not have are skipped.
std::string WithProofs(std::string page, const ProofTable& proofs);

}  // namespace lyrefit
