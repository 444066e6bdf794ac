#include "lyrefit/batch.h"

#include <cstdio>
#include <string>

// Arguments: a batch of strings and a folder. Fits every curve into the folder. Succeeds if every
// curve has its row and none is broken.
int main(int argc, char** argv) {
  if (argc != 3) return std::puts("batch STRINGS FOLDER"), 1;
  const auto source = lyrefit::OpenBatch({argv[1]});
  if (!source) return std::puts(source.error().ToString().c_str()), 1;
  lyrefit::BatchOptions options;
  options.folder = argv[2];
  const auto task = lyrefit::FitTask(lyrefit::BatchFitOptions());
  const auto done = lyrefit::RunBatch(source->get(), task, options);
  if (!done) return std::puts(done.error().ToString().c_str()), 1;
  std::fputs(lyrefit::BatchText(*done).c_str(), stdout);
  return done->rows > 0 && done->statuses.count("broken") == 0 ? 0 : 1;
}
