#pragma once

// The public header for many curves: lyrefit::fleet. OpenFleet reads them one by one from a plant's folder or
// a table, RunBatch fits or diagnoses each and writes a row of it, MergeShards puts together what
// several machines did. As in lyrefit.h nothing throws or prints.
//
//   #include <iostream>
//   #include "lyrefit/fleet.h"
//
//   int main() {
//     const auto source = lyrefit::OpenFleet({"data/plant/strings.csv"});
//     if (!source) return std::cerr << source.error().ToString() << '\n', 1;
//     lyrefit::BatchOptions options;
//     options.folder = "results";
//     const auto done = lyrefit::RunBatch(source->get(), lyrefit::FitTask({}), options);
//     if (!done) return std::cerr << done.error().ToString() << '\n', 1;
//     std::cout << lyrefit::BatchText(*done);
//   }

#include "lyrefit/fleet/batch.h"
#include "lyrefit/fleet/fleet_source.h"
#include "lyrefit/fleet/fleet_task.h"
#include "lyrefit/fleet/pack.h"
#include "lyrefit/fleet/history.h"
#include "lyrefit/fleet/plant_page.h"
#include "lyrefit/fleet/result_row.h"
#include "lyrefit/fleet/sketch.h"
