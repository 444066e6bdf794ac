#include "fit_kinds.h"

#include "family_flags.h"
#include "family_run.h"
#include "lyrefit/base/try.h"
#include "lyrefit/certify/floor.h"
#include "lyrefit/simulate/text_readers.h"
#include "two_junction_run.h"

namespace lyrefit {
namespace {

// A set of curves of one device.
class FamilyFit : public FitKind {
 public:
  void Declare(VerbLine* verb, ReportFlags* output) override {
    AddFamilyFlags(verb, &flags_, output);
  }
  Expected<bool> IsAsked(const VerbLine& verb) const override {
    TRY(CheckFamilyFlags(verb, flags_));
    return flags_.family.has_value();
  }
  Expected<int> Run(const VerbLine& verb, FitArguments* fit) const override {
    if (fit->auto_model) {
      return Fail("--model auto is for one curve: --family auto chooses among laws and diodes");
    }
    if (fit->files.size() > 1) {
      return Fail("--family takes one set of curves: put the files into a folder");
    }
    fit->curve.file = fit->files.front();
    TRY(SettleFitFlags(verb, fit));
    TRY(const FamilyOptions options, FamilyOptionsFromFlags(verb, flags_, fit->options));
    return RunFamily(verb, fit->curve, flags_, options, fit->output);
  }

 private:
  FamilyFlags flags_;
};

// Two junctions in series.
class JunctionFit : public FitKind {
 public:
  void Declare(VerbLine* verb, ReportFlags* /*output*/) override {
    AddJunctionFlags(verb, &flags_);
  }
  Expected<bool> IsAsked(const VerbLine& verb) const override {
    TRY(CheckJunctionFlags(verb, flags_));
    return flags_.junctions == 2;
  }
  Expected<int> Run(const VerbLine& verb, FitArguments* fit) const override {
    return RunTwoJunctions(verb, fit->files, fit->curve, flags_, fit->options, fit->output);
  }

 private:
  JunctionFlags flags_;
};

}  // namespace

std::vector<std::unique_ptr<FitKind>> FitKinds() {
  std::vector<std::unique_ptr<FitKind>> kinds;
  kinds.push_back(std::make_unique<FamilyFit>());
  kinds.push_back(std::make_unique<JunctionFit>());
  return kinds;
}

Expected<FitReport> FitOneCurve(const IvCurve& curve, const FitOptions& options, bool auto_model,
                                const Observer& observer) {
  return FitWithFloor(curve, options, auto_model, observer);
}

const TextReaders& ProgramTextReaders() { return AllTextReaders(); }

}  // namespace lyrefit
