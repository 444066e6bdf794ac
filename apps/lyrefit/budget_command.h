#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "study_flags.h"

namespace lyrefit {

// `lyrefit budget`: how many evaluations each algorithm needs until every run hits, by how far it
// is polished.
class BudgetCommand {
 public:
  explicit BudgetCommand(CLI::App* app);
  bool Chosen() const { return command_->parsed(); }
  int Run();

 private:
  Expected<std::vector<Contender>> Contenders() const;

  CLI::App* command_;
  StudyFlags flags_;
  std::string budgets_ = "10,30,100,300,1000,3000,10000,30000,100000";
  std::string plot_file_;
};

}  // namespace lyrefit
