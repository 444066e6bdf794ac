#pragma once

#include <map>
#include <string>

#include "paper/paper_study.h"

namespace lyrefit {

// The page of results as Markdown: what the paper prints, what came out here, whether that is the
// same, and why not. `remarks` holds a paragraph for each table, by its name ("Table 12").
std::string PaperPage(const PaperStudy& study, const std::map<std::string, std::string>& remarks);

}  // namespace lyrefit
