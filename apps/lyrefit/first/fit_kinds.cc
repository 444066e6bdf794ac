#include "fit_kinds.h"

#include "lyrefit/settings/error_file.h"

// The verb fit of the program of a first fit: curves one by one, by diodes alone.
namespace lyrefit {
namespace {

Expected<EffectUse> RefuseEffect(const std::string& /*text*/) {
  return Fail("this program was built for a first fit, without effects; build all of lyrefit");
}

}  // namespace

std::vector<std::unique_ptr<FitKind>> FitKinds() { return {}; }

Expected<FitReport> FitOneCurve(const IvCurve& curve, const FitOptions& options, bool auto_model,
                                const Observer& observer) {
  if (options.floor) {
    return Fail(
        "--floor: this program was built for a first fit, without proofs; build all of lyrefit");
  }
  return auto_model ? FitAuto(curve, options, observer) : Fit(curve, options, observer);
}

const TextReaders& ProgramTextReaders() {
  static constexpr TextReaders kReaders{&RefuseEffect, &ErrorsNamed};
  return kReaders;
}

}  // namespace lyrefit
