#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
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

// Reads a file like {"current_noise_A": 0.001, "voltage_noise_V": 0.01, "path_of_isc": 0.0012}. All
// three keys are required, none below 0, and the first or the last above 0. "path_length_of_voc",
// above 0, is optional and defaults to 1. Errors carry file, line and column.
Expected<ErrorSpec> ReadErrorFile(const std::string& path);

// Error model by name ("white" or "field"), or from a file of ReadErrorFile(). Errors: those of the
// file.
Expected<ErrorSpec> ErrorsNamed(const std::string& name);

// Option for the error model, by name or file: see base/option.h.
template <auto Member>
constexpr auto NoiseOption() {
  using Options = ClassOf<Member>;
  return OptionText<Options>{
      [](const std::string& text, Options* options) -> Expected<void> {
        Expected<ErrorSpec> errors = ErrorsNamed(text);
        if (!errors) return tl::unexpected<Error>(errors.error());
        options->*Member = std::move(*errors);
        return {};
      },
      [](const Options& options) -> std::vector<std::string> { return {(options.*Member).name}; },
      nullptr, false};
}

}  // namespace lyrefit
