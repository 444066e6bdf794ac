// Experimental: may change in a minor version (data/stable).
#pragma once

// Public header of lyrefit::batch, a library for many curves. OpenBatch reads the curves one by one
// from a plant's folder or a table. RunBatch fits or diagnoses each curve and writes one row for
// it. MergeShards merges the results of several machines. As in lyrefit.h nothing throws or prints.
//
//   #include <iostream>
//   #include "lyrefit/batch.h"
//
//   int main() {
//     const auto source = lyrefit::OpenBatch({"data/plant/strings.csv"});
//     if (!source) return std::cerr << source.error().ToString() << '\n', 1;
//     lyrefit::BatchOptions options;
//     options.folder = "results";
//     const auto done = lyrefit::RunBatch(source->get(), lyrefit::FitTask({}), options);
//     if (!done) return std::cerr << done.error().ToString() << '\n', 1;
//     std::cout << lyrefit::BatchText(*done);
//   }

#include "lyrefit/batch/batch.h"
#include "lyrefit/batch/batch_task.h"
#include "lyrefit/batch/history.h"
#include "lyrefit/batch/pack.h"
#include "lyrefit/batch/result_row.h"
#include "lyrefit/batch/sparkline.h"
#include "lyrefit/stream/batch_source.h"
