#pragma once

// The public header for many curves: lyrefit::batch. OpenBatch reads them one by one from a plant's folder or
// a table, RunBatch fits or diagnoses each and writes a row of it, MergeShards puts together what
// several machines did. As in lyrefit.h nothing throws or prints.
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
#include "lyrefit/batch/batch_source.h"
#include "lyrefit/batch/batch_task.h"
#include "lyrefit/batch/pack.h"
#include "lyrefit/batch/history.h"
#include "lyrefit/batch/plant_page.h"
#include "lyrefit/batch/result_row.h"
#include "lyrefit/batch/sparkline.h"
