#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/refine/error_terms.h"

namespace LYREFIT_PUBLIC lyrefit {

// What a fit takes the errors of the readings for.
enum class ErrorKind {
  kWhite,   // of one size (or as stated in sigma_A), and knowing nothing of each other
  kField,   // the error model, its three sizes found from the residuals
  kStated,  // the error model with sizes that somebody knows
};

// The errors that a fit is to reckon with.
struct ErrorSpec {
  ErrorKind kind = ErrorKind::kWhite;
  ErrorSizes sizes;            // where they are stated
  std::string name = "white";  // "white", "field" or the name of the file
};

// {"current_noise_A": 0.001, "voltage_noise_V": 0.01, "path_of_isc": 0.0012}: all three, none below
// 0, the first or the last above; "path_length_of_voc", above 0, is 1 where it is not there. Errors
// carry file, line and column.
Expected<ErrorSpec> ReadErrorFile(const std::string& path);

// "white", "field", or such a file. Errors: those of the file.
Expected<ErrorSpec> ErrorsNamed(const std::string& name);

// What the readings' errors are, by name or file: see base/option.h.
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
