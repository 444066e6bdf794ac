#pragma once

#include <string>
#include <vector>

#include "lyrefit/report/document.h"
#include "paper/paper_study.h"

// Parts of the paper study that other pages include.
namespace lyrefit {

// Certified optima of each curve.
block::Table CertifiedTable(const PaperStudy& study);

// Rankings of the algorithms, one table per problem.
std::vector<block::Any> RankedTables(const PaperStudy& study);

// Replaces the blocks "certified", "ranked" and "budget" in `page` with new tables; the last one
// holds the hits at each budget. Blocks that `page` does not have are skipped.
std::string WithTables(std::string page, const PaperStudy& study);

// Replaces the text between "<!-- NAME -->" and "<!-- end of NAME -->" in `page` with `block`.
// Returns `page` unchanged if it has no such pair.
std::string ReplaceBlock(const std::string& page, const std::string& name,
                         const std::string& block);

}  // namespace lyrefit
