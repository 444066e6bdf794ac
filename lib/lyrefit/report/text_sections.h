#pragma once

#include <string>

#include "lyrefit/fit/fit_report.h"

// The sections of the text report; each ends with a newline or is empty where there is nothing to
// say.
namespace lyrefit {

// text_answer.cc: what came out.
std::string ParameterSection(const FitReport& report);
std::string ErrorSection(const FitReport& report);
std::string RmseSection(const FitReport& report);
std::string KeyPointSection(const FitReport& report);

// text_evidence.cc: how far to trust it.
std::string ChoiceSection(const FitReport& report);
std::string FormSection(const FitReport& report);
std::string ResidualSection(const FitReport& report);
std::string SearchSection(const FitReport& report);

}  // namespace lyrefit
