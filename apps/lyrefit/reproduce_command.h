#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "lyrefit/study/paper_study.h"

namespace lyrefit {

// `lyrefit reproduce`: does the published tables over again and writes the page of results.
class ReproduceCommand {
 public:
  explicit ReproduceCommand(CLI::App* app);
  bool Chosen() const { return command_->parsed(); }
  int Run();

 private:
  Expected<void> AddPeers();
  Expected<void> Write(const PaperStudy& study) const;

  CLI::App* command_;
  PaperStudyOptions options_;
  std::string folder_;
  std::string output_;
  std::string peers_ = "de1220,sade,cmaes,pso,gwo,bee_colony";
  std::vector<std::string> pages_;
};

}  // namespace lyrefit
