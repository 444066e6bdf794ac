#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"

namespace lyrefit {

// An output file of a run; "" means none, "-" standard output.
struct OutputFile {
  std::string flag;
  std::string path;
  bool is_picture = false;  // needs gnuplot, and a path other than "-"
};

// An input file or folder of a run; it may be missing.
struct InputFile {
  std::string path;
  bool is_measurement = false;  // read together with the files beside it
};

// All files of one run.
struct FilePlan {
  std::vector<InputFile> inputs;
  std::vector<OutputFile> outputs;
  bool force = false;  // allows replacing inputs
};

// Whether the run can write its files without loss; call it before the work. No output may be an
// input or a file read along with one, and no two outputs may be one file. At most one output may
// be standard output, and all must be writable. Leaves no files behind.
Expected<void> CheckFilePlan(const FilePlan& plan);

}  // namespace lyrefit
