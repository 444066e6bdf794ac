#pragma once

#include <map>
#include <string>

#include "paper/paper_study.h"

namespace lyrefit {

// The page of results as Markdown: what the paper prints, what came out here, whether that is the
// same, and why not. `remarks` holds a paragraph for each table, by its name ("Table 12").
std::string PaperPage(const PaperStudy& study, const std::map<std::string, std::string>& remarks);

// Another page with the tables that it shows of the study drawn anew: between the marks "certified",
// "ranked" and "budget", as far as it has them.
std::string WithTables(std::string page, const PaperStudy& study);

// The text between "<!-- NAME -->" and "<!-- end of NAME -->" in `page` replaced by `block`; the
// page as it is where there is no such pair.
std::string ReplaceBlock(const std::string& page, const std::string& name,
                         const std::string& block);

}  // namespace lyrefit
