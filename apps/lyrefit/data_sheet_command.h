#pragma once

#include <string>

#include "command_line.h"
#include "lyrefit/family/data_sheet.h"

namespace lyrefit {

// `lyrefit datasheet`: the five parameters of a module from what its data sheet prints.
class DataSheetCommand {
 public:
  explicit DataSheetCommand(CommandLine* line);
  bool Chosen() const { return verb_->Chosen(); }
  int Run();

 private:
  Expected<DataSheet> Sheet() const;
  Expected<void> Write(const DataSheetFit& fit) const;

  Verb* verb_;
  // As printed: the digits say how far each value is rounded.
  std::string isc_;
  std::string voc_;
  std::string imp_;
  std::string vmp_;
  std::string alpha_;
  std::string beta_;
  std::string gamma_;
  std::string name_ = "module";
  std::string technology_;
  int cells_ = 1;
  bool exact_ = false;
  ConstantSet constants_ = ConstantSet::kCodata;
  std::string json_file_;
  std::string pvlib_file_;
};

}  // namespace lyrefit
