#pragma once

#include <string>

#include "paper/proof_table.h"

namespace lyrefit {

// `page` with the blocks "proofs" (every row) and "proofs-short" (the boxes of publications) drawn
// anew, as far as it has them.
std::string WithProofs(std::string page, const ProofTable& proofs);

}  // namespace lyrefit
