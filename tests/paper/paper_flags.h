#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "paper/paper_study.h"

namespace lyrefit {

// Command-line arguments of lyrefit_paper.
struct PaperArguments {
  std::string folder;
  std::string output;  // empty: `folder`
  std::vector<std::string> pages;
  std::string only;      // empty: all pages
  std::string measured;  // folder of measured curves; empty: none
  std::string peers = "de1220,sade,cmaes,pso,gwo,bee_colony";
  PaperStudyOptions options;
};

Expected<PaperArguments> ReadArguments(const std::vector<std::string>& words);

std::string PaperUsage();

}  // namespace lyrefit
