#pragma once

#include <memory>
#include <string>
#include <vector>

#include "command_line.h"
#include "flags.h"
#include "lyrefit/estimate/fit/fit.h"

namespace lyrefit {

// Arguments of the verb fit.
struct FitArguments {
  std::vector<std::string> files;
  CurveFlags curve;  // of one file, or of each file
  bool auto_model = false;
  std::string bounds = "physical";  // value of --bounds
  FitOptions options;
  ReportFlags output;
};

// A kind of fit besides curves fitted one by one: a set of curves, two junctions.
class FitKind {
 public:
  virtual ~FitKind() = default;
  // Declares its own flags, some for outputs.
  virtual void Declare(VerbLine* verb, ReportFlags* output) = 0;
  // Whether the flags ask for it. Errors: flags that contradict each other.
  virtual Expected<bool> IsAsked(const VerbLine& verb) const = 0;
  // Fits and writes the results; returns the exit code.
  virtual Expected<int> Run(const VerbLine& verb, FitArguments* fit) const = 0;
};

// The kinds of fit of this program, in the order of --help. The program of a first fit has none.
std::vector<std::unique_ptr<FitKind>> FitKinds();

// Sets options that depend on other flags, and rejects contradictions.
Expected<void> SettleFitFlags(const VerbLine& verb, FitArguments* fit);

// Fit() or, with `auto_model`, FitAuto(), with the floor if the options ask for it and this program
// can prove it.
Expected<FitReport> FitOneCurve(const IvCurve& curve, const FitOptions& options, bool auto_model,
                                const Observer& observer);

}  // namespace lyrefit
