#include "translate/study.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

struct Mode {
  const char* name;
  int (*run)(const shown::StudyOptions&);
  const char* what;
};

constexpr Mode kModes[] = {
    {"sets", shown::StudySets, "sweeps of healthy modules carried to each other's conditions"},
    {"halves", shown::StudyHalves, "sizes fitted to half of the sweeps, tried on the other half"},
    {"sizes", shown::StudySizes, "sizes fitted to every set and world by itself"},
    {"made", shown::StudySynthetic, "healthy devices by other laws, to standard conditions"},
    {"sensors", shown::StudySensors, "the same, the cells warmer than the sensor on the back"},
    {"beta", shown::StudyBeta, "the same where nobody states beta"},
    {"faults", shown::StudyFaults, "modules of cells with a fault, to standard conditions"},
    {"real", shown::StudyReal, "single real curves to standard conditions"},
};

int Usage() {
  std::fprintf(
      stderr,
      "translate_study MODE [--data FOLDER] [--every N] [--pairs N] [--cases N] [--seed N] "
      "[--threads N]\n");
  for (const Mode& mode : kModes) std::fprintf(stderr, "  %-8s %s\n", mode.name, mode.what);
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return Usage();
  shown::StudyOptions options;
  options.data = LYREFIT_FIELD_DATA_DIR;
  for (int i = 2; i + 1 < argc; i += 2) {
    const auto is = [&](const char* flag) { return std::strcmp(argv[i], flag) == 0; };
    const int number = std::atoi(argv[i + 1]);
    if (is("--data")) {
      options.data = argv[i + 1];
    } else if (is("--every")) {
      options.every = number;
    } else if (is("--pairs")) {
      options.pairs = number;
    } else if (is("--cases")) {
      options.cases = number;
    } else if (is("--seed")) {
      options.seed = static_cast<unsigned>(number);
    } else if (is("--threads")) {
      options.threads = number;
    } else {
      return Usage();
    }
  }
  for (const Mode& mode : kModes) {
    if (std::strcmp(argv[1], mode.name) == 0) return mode.run(options);
  }
  return Usage();
}
