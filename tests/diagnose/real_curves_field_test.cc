// Real sweeps of known condition, and whole days of sweeps. Built only if LYREFIT_FIELD_DATA is set
// to their folder. The tables go to standard output; LYREFIT_EVERY_SWEEP=1 diagnoses every sweep of
// the days.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "../repeats.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/diagnose/decision_constants.h"
#include "lyrefit/diagnose/diagnose.h"
#include "lyrefit/diagnose/known_effects.h"
#include "lyrefit/diagnose/select.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/refine/error_sizes.h"
#include "lyrefit/read/read_curve_set.h"

namespace lyrefit {
namespace {

const std::string kField = std::string(LYREFIT_FIELD_DATA_DIR) + "/field/";

DiagnoseOptions Quick() {
  DiagnoseOptions options;
  options.held_out = false;
  options.threads = 1;
  return options;
}

// Ids of causes of the module; outliers and quantisation are causes of the measurement and are left
// out.
std::vector<std::string> Named(const Diagnosis& diagnosis) {
  std::vector<std::string> ids;
  for (const Cause& cause : diagnosis.verdict.causes) {
    if (cause.id != "outliers" && cause.id != "quantisation") ids.push_back(cause.id);
  }
  return ids;
}

struct Labelled {
  std::string name;
  std::string label;  // "clean", "fault" or "unknown"
  std::vector<std::string> accepted;
};

std::vector<Labelled> ReadLabels() {
  std::ifstream file(kField + "single/labels.csv");
  std::vector<Labelled> all;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    Labelled one;
    std::string accepted;
    std::getline(cells, one.name, ',');
    std::getline(cells, one.label, ',');
    std::getline(cells, accepted, ',');
    std::istringstream ids(accepted);
    for (std::string id; ids >> id;) one.accepted.push_back(FindEffect(id)->Finding());
    all.push_back(one);
  }
  return all;
}

TEST(RealCurvesTest, CleanSweepsAreLeftAloneAndFaultsAreNamed) {
  SKIP_IF_SANITIZED();
  const std::vector<Labelled> labels = ReadLabels();
  ASSERT_EQ(labels.size(), 68U);
  std::vector<std::vector<std::string>> named(labels.size());
  ParallelFor(static_cast<int>(labels.size()), 0, [&](int k) {
    const auto measured = ReadMeasurement(kField + "single/" + labels[k].name + ".csv");
    ASSERT_TRUE(measured) << labels[k].name;
    const auto diagnosis = Diagnose(*measured, Quick());
    ASSERT_TRUE(diagnosis) << labels[k].name;
    named[k] = Named(*diagnosis);
  });
  int clean = 0, alarms = 0, faults = 0, right = 0;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    std::string text;
    for (const std::string& id : named[k]) text += " " + id;
    std::printf("%-26s %-8s%s\n", labels[k].name.c_str(), labels[k].label.c_str(),
                text.empty() ? " -" : text.c_str());
    const std::vector<std::string>& accepted = labels[k].accepted;
    if (labels[k].label == "clean") {
      ++clean;
      alarms += named[k].empty() ? 0 : 1;
    } else if (labels[k].label == "fault") {
      ++faults;
      right += !named[k].empty() &&
               std::find(accepted.begin(), accepted.end(), named[k].front()) != accepted.end();
    }
  }
  std::printf("clean, named all the same: %d of %d; faults, first name right: %d of %d\n", alarms,
              clean, right, faults);
  EXPECT_EQ(clean, 39);
  EXPECT_EQ(faults, 20);
  EXPECT_LE(alarms, 2);
  EXPECT_GE(right, 16);
}

Selection SelectionOf(const CurveSet& measured, bool thorough) {
  Measurement measurement = *MakeMeasurement(measured);
  const DiagnoseOptions usual;
  measurement.errors = usual.noise;
  SelectOptions options;
  options.thorough = thorough;
  options.judge.departure = UsualErrors(1, 1).center.path;
  options.judge.departure_width = kDepartureWidth;
  options.judge.module = measurement.readings.traits.module;
  options.floors = {usual.floor_current, usual.floor_power};
  options.candidates = Candidates(Catalogue(), measurement.readings.traits, usual);
  options.judge.candidates = options.candidates;
  const std::vector<char> used(measurement.readings.points.size(), 1);
  Selection selection = SelectCauses(measurement, used, 0, options);
  if (selection.base.usable) FindAlternatives(measurement, options, &selection);
  return selection;
}

// After a wrong reading is left out candidates are fitted from where the earlier fits ended. From all
// starts the same causes are found.
TEST(RealCurvesTest, WhatEarlierFitsSaveChangesNoVerdict) {
  constexpr double kAlike = 0.02;
  const std::vector<Labelled> labels = ReadLabels();
  std::vector<std::string> differs(labels.size());
  ParallelFor(static_cast<int>(labels.size()), 0, [&](int k) {
    if (labels[k].label != "fault" && k % 4 != 0) return;
    const auto measured = ReadMeasurement(kField + "single/" + labels[k].name + ".csv");
    ASSERT_TRUE(measured) << labels[k].name;
    const Selection quick = SelectionOf(*measured, false), thorough = SelectionOf(*measured, true);
    bool same = quick.causes.size() == thorough.causes.size();
    for (std::size_t c = 0; same && c < quick.causes.size(); ++c) {
      const ChosenCause &a = quick.causes[c], &b = thorough.causes[c];
      same = a.effect == b.effect && std::fabs(a.probability - b.probability) < kAlike;
    }
    if (!same || quick.outliers != thorough.outliers) differs[k] = labels[k].name;
  });
  for (const std::string& name : differs) EXPECT_EQ(name, "");
}

// Counts the first cause named for each sweep of a folder. Sweeps with a largest current below 0.5
// A are left out.
std::map<std::string, int> FirstNames(const std::string& folder, int bypass_diodes) {
  constexpr double kLeastIsc_A = 0.5;
  constexpr int kFew = 20;
  auto set = ReadCurveSet(kField + folder);
  EXPECT_TRUE(set) << folder;
  if (!set) return {};
  std::vector<IvCurve> curves;
  for (IvCurve& curve : set->curves) {
    const auto most = std::max_element(curve.current_A.begin(), curve.current_A.end());
    if (*most < kLeastIsc_A) continue;
    curve.notes.bypass_diodes = bypass_diodes;
    curves.push_back(std::move(curve));
  }
  const int step =
      std::getenv("LYREFIT_EVERY_SWEEP") != nullptr ? 1 : static_cast<int>(curves.size()) / kFew;
  std::vector<std::string> first((curves.size() + step - 1) / step);
  ParallelFor(static_cast<int>(first.size()), 0, [&](int k) {
    const auto diagnosis = Diagnose(curves[k * step], Quick());
    const auto ids = diagnosis ? Named(*diagnosis) : std::vector<std::string>{"failed"};
    first[k] = ids.empty() ? "-" : ids.front();
  });
  std::map<std::string, int> count;
  for (const std::string& id : first) ++count[id];
  std::printf("%s, %zu sweeps:", folder.c_str(), first.size());
  for (const auto& [id, times] : count) std::printf(" %s %d", id.c_str(), times);
  std::printf("\n");
  return count;
}

double ShareNamed(const std::map<std::string, int>& count) {
  int all = 0;
  for (const auto& [id, times] : count) all += times;
  const auto silent = count.find("-");
  return 1 - (silent != count.end() ? static_cast<double>(silent->second) : 0) / all;
}

TEST(RealCurvesTest, WholeDaysOfReferenceModulesAreSilent) {
  SKIP_IF_SANITIZED();
  EXPECT_LE(ShareNamed(FirstNames("sandia_pvue125", 2)), 0.05);
  EXPECT_LE(ShareNamed(FirstNames("nist_ground_2015-07-20", 3)), 0.05);
  // On this day there was shade in the morning and in the evening, and clouds about noon.
  const auto shaded = FirstNames("nist_ground_2015-07-01", 3);
  EXPECT_LE(ShareNamed(shaded), 0.4);
  EXPECT_GT(shaded.count("shading") + shaded.count("substrings"), 0U);
}

}  // namespace
}  // namespace lyrefit
