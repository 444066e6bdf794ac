#pragma once

#include <map>
#include <string>

#include "paper/paper_study.h"

namespace lyrefit {

// Markdown page of results: printed values, values computed here, whether they agree, and the
// reason if not. `remarks` maps the name of a table ("Table 12") to a paragraph, and with ": command"
// behind it to the command that makes one batch of it.
std::string PaperPage(const PaperStudy& study, const std::map<std::string, std::string>& remarks);

}  // namespace lyrefit
