#include "lyrefit/report/data_block.h"

#include <fmt/format.h>

#include <cmath>

namespace lyrefit {

void DataBlock::Add(std::initializer_list<double> row) {
  std::string line;
  for (const double value : row) {
    if (!std::isfinite(value)) return;
    line += fmt::format("{:.9g} ", value);
  }
  text_ += line + "\n";
  ++rows_;
}

std::string DataBlock::Text() const {
  return "$" + name_ + " << END_OF_DATA\n" + text_ + "END_OF_DATA\n";
}

void JoinPlot(const DataBlock& block, const std::string& how, std::string* command) {
  if (block.empty()) return;
  *command += (command->empty() ? "plot $" : ", $") + block.name() + " " + how;
}

std::string PlotLine(std::string command) {
  return command.empty() ? "plot [0:1] [0:1] NaN notitle\n" : std::move(command) + "\n";
}

}  // namespace lyrefit
