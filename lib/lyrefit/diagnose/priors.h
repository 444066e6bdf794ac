// Experimental: may change in a minor version (data/stable).
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/model/effect.h"

namespace LYREFIT_PUBLIC lyrefit {

// Why a cause cannot be there in these circumstances; null: it can.
const char* WhyNotThere(const Effect& effect, const Circumstances& where);

// Prior probabilities of causes.
struct CausePriors {
  std::map<std::string, double> given;  // by id, replace those of the effects
  bool alike = false;                   // all other causes are equally probable
  std::string name = "table";           // "table", "alike" or the name of the file
  Circumstances where = {};             // of the measurement; Diagnose fills it

  // Of an effect in sweeps of modules or of cells. What cannot be there counts as elsewhere, for one
  // who asks for it by name.
  double Of(const Effect& effect, bool module) const;
};

// Of a cause without a prior, such as an effect of one's own, and of all with `alike`.
inline constexpr double kOtherPrior = 0.03;
// That something acts which no effect of the catalogue describes.
inline constexpr double kUnknownPrior = 0.003;
// That a sweep contains a wrong reading.
inline constexpr double kWrongReadingPrior = 0.05;

// Reads a file like {"shading": 0.1, "second_diode": 0.01}, whose values replace those of the
// effects. Errors, with file, line and column: an id that is no effect, a number outside (0, 1).
Expected<CausePriors> ReadPriors(const std::string& path);

// Priors by name ("table" or "alike"), or from a file of ReadPriors().
Expected<CausePriors> PriorsNamed(const std::string& name);

// Option for priors, by name or file: see base/option.h.
template <auto Member>
constexpr auto PriorsOption() {
  using Options = ClassOf<Member>;
  return OptionText<Options>{
      [](const std::string& text, Options* options, const TextReaders&) -> Expected<void> {
        Expected<CausePriors> priors = PriorsNamed(text);
        if (!priors) return tl::unexpected<Error>(priors.error());
        options->*Member = std::move(*priors);
        return {};
      },
      [](const Options& options) -> std::vector<std::string> { return {(options.*Member).name}; },
      nullptr, false};
}

}  // namespace lyrefit
