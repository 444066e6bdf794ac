#pragma once

#include <string>
#include <vector>

#include "command_line.h"
#include "lyrefit/study/paper_study.h"

namespace lyrefit {

// `lyrefit reproduce`: does the published tables over again and writes the page of results.
class ReproduceCommand {
 public:
  explicit ReproduceCommand(CommandLine* line);
  bool Chosen() const { return verb_->Chosen(); }
  int Run();

 private:
  Expected<void> AddPeers();
  Expected<void> Write(const PaperStudy& study) const;

  Verb* verb_;
  PaperStudyOptions options_;
  std::string folder_;
  std::string output_;
  std::string peers_ = "de1220,sade,cmaes,pso,gwo,bee_colony";
  std::vector<std::string> pages_;
  bool quiet_ = false;
};

}  // namespace lyrefit
