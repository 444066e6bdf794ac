#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/estimate/fit/text_readers.h"
#include "lyrefit/estimate/refine/error_terms.h"

namespace LYREFIT_PUBLIC lyrefit {

// Error model that a fit assumes for the readings.
enum class ErrorKind {
  kWhite,   // independent, of one size or as stated in sigma_A
  kField,   // the error model with sizes estimated from the residuals
  kStated,  // the error model with stated sizes
};

// Error model of a fit and its sizes.
struct ErrorSpec {
  ErrorKind kind = ErrorKind::kWhite;
  ErrorSizes sizes;            // used with kStated
  std::string name = "white";  // "white", "field" or the name of the file
};

// Option for the error model, by name or file: see base/option.h.
template <auto Member>
constexpr auto NoiseOption() {
  using Options = ClassOf<Member>;
  return OptionText<Options>{
      [](const std::string& text, Options* options, const TextReaders& readers) -> Expected<void> {
        Expected<ErrorSpec> errors = readers.errors(text);
        if (!errors) return tl::unexpected<Error>(errors.error());
        options->*Member = std::move(*errors);
        return {};
      },
      [](const Options& options) -> std::vector<std::string> { return {(options.*Member).name}; },
      nullptr, false};
}

}  // namespace lyrefit
