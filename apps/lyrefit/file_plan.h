#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"

namespace lyrefit {

// A file that a run is to write; "" is not wanted, "-" is standard output.
struct OutputFile {
  std::string flag;
  std::string path;
  bool is_picture = false;  // "-" is none, and gnuplot has to be there
};

// A file or folder that a run reads; what is not there does not matter.
struct InputFile {
  std::string path;
  bool is_measurement = false;  // read with what lies beside it
};

// All files of one run.
struct FilePlan {
  std::vector<InputFile> inputs;
  std::vector<OutputFile> outputs;
  bool force = false;  // replaces what is read
};

// Whether the plan can be carried out without loss, to be asked before the work: no output is an
// input or something read along with one, no two outputs are one file, standard output belongs to
// one at most, and all can be written. Leaves nothing behind.
Expected<void> CheckFilePlan(const FilePlan& plan);

}  // namespace lyrefit
