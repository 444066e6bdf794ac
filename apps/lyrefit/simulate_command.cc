#include "simulate_command.h"

#include <fmt/format.h>

#include <filesystem>

#include "interrupt.h"
#include "lyrefit/base/file.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/curve/write_curve.h"
#include "output.h"

namespace lyrefit {
namespace {

constexpr char kSimulateFooter[] =
    "Examples:\n"
    "  lyrefit simulate --set Iph=0.76 --set Is1=3e-7 --set n1=1.48 --set Rs=0.036 --set Rsh=54\n"
    "      --temperature-C 33 --noise-A 0.0005 --seed 1 --out cell.csv\n"
    "  lyrefit simulate --from fit.json --voltages 0:0.6:61\n"
    "  lyrefit simulate --from fit.json --with shading:d=0.3,w=0.3333\n"
    "  lyrefit simulate --from fit.json --string half_cut.json\n"
    "\n"
    "Beside NAME.csv a file NAME.json holds the conditions; lyrefit fit NAME.csv reads both.";

// NAME.json beside NAME.csv; empty for standard output.
std::string SidecarOf(const std::string& table) {
  if (table == "-") return "";
  return std::filesystem::path(table).replace_extension(".json").string();
}

// Whether the table and its sidecar are to the byte what this verb writes of such a curve.
bool IsOwnWork(const std::string& table) {
  const Expected<IvCurve> curve = ReadCurve(table);
  if (!curve) return false;
  const std::uintmax_t largest = ReadOptions().largest_file_bytes;
  const Expected<std::string> csv = ReadTextFile(table, largest);
  const Expected<std::string> json = ReadTextFile(SidecarOf(table), largest);
  return csv && json && *csv == CurveToCsv(*curve) && *json == CurveSidecarJson(*curve);
}

}  // namespace

SimulateCommand::SimulateCommand(CommandLine* line)
    : verb_(line->AddVerb("simulate", "Write the curve of a device, with noise if wanted")) {
  AddEnumFlag(verb_, "--model", "number of diodes", &flags_.model).Group("Device");
  AddListFlag(verb_, "--set", "value of one parameter, Iph=0.76; once for each", &set_list_)
      .Type("P=VALUE")
      .Group("Device");
  verb_->AddOption("--from", &from_file_, "parameters and conditions of a JSON fit report")
      .Group("Device")
      .Type("FILE")
      .Reads();
  verb_->AddOption("--curve", &from_curve_, "which curve of a report of many, by its id")
      .Group("Device")
      .Type("ID");
  AddEnumFlag(verb_, "--constants", "values of k and q", &flags_.constants).Group("Device");
  AddWithFlag(verb_, "Device", &with_list_);
  verb_
      ->AddOption("--string", &layout_file_,
                  "cells that are not alike, their bypass diodes and reverse law, as JSON")
      .Group("Device")
      .Type("FILE")
      .Reads();
  AddConditionFlags(verb_, &conditions_);
  verb_->AddOption("--voltages", &voltages_, "even steps in volt, both ends included")
      .Type("FROM:TO:COUNT")
      .Group("Points");
  verb_
      ->AddOption("--points", &flags_.points,
                  "points from 0 V to a little beyond open circuit (default 100)")
      .Type("N")
      .Excludes("--voltages")
      .Group("Points");
  verb_
      ->AddOption("--noise-A", &flags_.noise_A,
                  "standard deviation of the current in A (default 0)")
      .Type("S")
      .Group("Noise");
  verb_
      ->AddOption("--noise-relative", &flags_.noise_relative,
                  "standard deviation as a part of the current (default 0)")
      .Type("R")
      .Group("Noise");
  verb_->AddOption("--seed", &flags_.seed, "seed of the noise (default 0)")
      .Type("S")
      .Group("Noise");
  verb_->AddOption("--out", &out_file_, "where to write; - for standard output (default -)")
      .Writes();
  verb_->Footer(kSimulateFooter);
}

Expected<void> SimulateCommand::CheckTargets() const {
  if (out_file_ == "-") return verb_->CheckFiles();
  const std::string sidecar = SidecarOf(out_file_);
  if (out_file_ == sidecar) {
    return Fail("--out: expected a table that ends in .csv, found .json", out_file_);
  }
  verb_->AlsoWrites("--out", sidecar);
  if (auto checked = verb_->CheckFiles(); !checked || verb_->Forced()) return checked;
  for (const std::string& file : {out_file_, sidecar}) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error) || IsOwnWork(out_file_)) continue;
    return Fail(
        "--out: the file is there and holds something else than a simulated curve: name "
        "another file, or say --force to replace it",
        file);
  }
  return {};
}

Expected<SimulateOptions> SimulateCommand::Options() const {
  SimulateOptions options = flags_;
  if (from_file_.empty() && !from_curve_.empty()) {
    return Fail("--curve is about a report of many curves: it needs --from");
  }
  if (!from_file_.empty()) {
    Expected<SimulateOptions> fit = ReadFitForSimulation(from_file_, from_curve_);
    if (!fit) return fit;
    options.parameters = fit->parameters;
    options.conditions = fit->conditions;
    options.with = fit->with;
    options.taken = fit->taken;
    options.shared = fit->shared;
    options.force_effects = fit->force_effects;
    if (!verb_->Given("--model")) options.model = fit->model;
    if (!verb_->Given("--constants")) options.constants = fit->constants;
  }
  auto with = ParseWith(with_list_);
  if (!with) return tl::unexpected(with.error());
  options.with.insert(options.with.end(), with->begin(), with->end());
  options.force_effects = options.force_effects || verb_->Forced();
  if (!layout_file_.empty()) {
    auto layout = ReadStringLayout(layout_file_);
    if (!layout) return tl::unexpected(layout.error());
    options.layout = std::make_shared<const StringLayout>(std::move(*layout));
  }
  for (const std::string& text : set_list_) {
    const auto assignment = ParseAssignment("--set", text);
    if (!assignment) return tl::unexpected(assignment.error());
    options.parameters[assignment->first] = assignment->second;
  }
  if (!voltages_.empty()) {
    const auto steps = ParseSteps("--voltages", voltages_);
    if (!steps) return tl::unexpected(steps.error());
    options.voltage_V = *steps;
  }
  IvCurve told;
  told.conditions = options.conditions;
  if (auto applied = ApplyConditionFlags(conditions_, &told); !applied) {
    return tl::unexpected(applied.error());
  }
  options.conditions = told.conditions;
  const bool cells_told = !from_file_.empty() || conditions_.cells.has_value();
  if (options.layout != nullptr && !cells_told) {
    options.conditions.cells_in_series = options.layout->cells_in_series;
  }
  if (out_file_ != "-") options.name = std::filesystem::path(out_file_).stem().string();
  return options;
}

int SimulateCommand::Run() {
  EndOnSignals();
  const Expected<SimulateOptions> options = Options();
  if (!options) return Refuse(options.error());
  if (auto checked = CheckTargets(); !checked) return Refuse(checked.error());
  const Expected<IvCurve> curve = Simulate(*options);
  if (!curve) return Refuse(curve.error());
  if (auto written = WriteOutput(out_file_, CurveToCsv(*curve)); !written) {
    return Refuse(written.error());
  }
  if (out_file_ == "-") return kExitFine;
  if (auto written = WriteTextFile(SidecarOf(out_file_), CurveSidecarJson(*curve)); !written) {
    return Refuse(written.error());
  }
  return kExitFine;
}

}  // namespace lyrefit
