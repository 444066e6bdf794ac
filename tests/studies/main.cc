// Studies of the library that measure, with its own code, what it promises.
//
//   lyrefit_studies coverage --sets 500
//   lyrefit_studies junctions --spectra three
//   lyrefit_studies truth case1.json case1.csv --family free

#include "lyrefit/base/try.h"
#include "studies/programs.h"
#include "studies/watch.h"

namespace lyrefit {
namespace {

constexpr char kUsage[] =
    "Usage: lyrefit_studies coverage|junctions|truth [words]; the flags are listed in\n"
    "tests/studies/README.md\n";

Expected<int> Run(const std::string& study, const std::vector<std::string>& words) {
  WatchSignals();
  if (study == "coverage") return RunCoverage(ReadProgramFlags(words));
  if (study == "junctions") return RunJunctions(ReadProgramFlags(words));
  if (study == "truth") return RunTruth(ReadProgramFlags(words));
  return Fail("no study '" + study + "': expected coverage, junctions or truth");
}

}  // namespace
}  // namespace lyrefit

int main(int argc, char** argv) {
  if (argc < 2 || std::string(argv[1]) == "--help") {
    fmt::print("{}", lyrefit::kUsage);
    return argc < 2 ? 1 : 0;
  }
  const auto code = lyrefit::Run(argv[1], {argv + 2, argv + argc});
  if (code) return *code;
  fmt::print(stderr, "lyrefit_studies: {}\n", code.error().ToString());
  return 1;
}
