#pragma once

#include <string>
#include <vector>

#include "lyrefit/report/document.h"
#include "paper/paper_study.h"

// What other pages show of the study, besides its own.
namespace lyrefit {

// The certified optima of each curve.
block::Table CertifiedTable(const PaperStudy& study);

// Who ranks first, a table a problem.
std::vector<block::Any> RankedTables(const PaperStudy& study);

// `page` with these tables, and the hits of each budget, drawn anew between the marks "certified",
// "ranked" and "budget", as far as it has them.
std::string WithTables(std::string page, const PaperStudy& study);

// The text between "<!-- NAME -->" and "<!-- end of NAME -->" in `page` replaced by `block`; the
// page as it is where there is no such pair.
std::string ReplaceBlock(const std::string& page, const std::string& name,
                         const std::string& block);

}  // namespace lyrefit
