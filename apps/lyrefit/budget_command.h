#pragma once

#include <string>

#include "command_line.h"
#include "study_flags.h"

namespace lyrefit {

// `lyrefit budget`: how many evaluations each algorithm needs until every run hits, by how far it
// is polished.
class BudgetCommand {
 public:
  explicit BudgetCommand(CommandLine* line);
  bool Chosen() const { return verb_->Chosen(); }
  int Run();

 private:
  Expected<std::vector<Contender>> Contenders() const;

  Verb* verb_;
  StudyFlags flags_;
  std::string budgets_ = "10,30,100,300,1000,3000,10000,30000,100000";
  std::string plot_file_;
};

}  // namespace lyrefit
