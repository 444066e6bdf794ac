#include "model_flag.h"

#include <optional>
#include <string>

#include "lyrefit/base/enum_text.h"

namespace lyrefit {

void AddModelFlag(VerbLine* verb, Model* model, bool* automatic) {
  const auto read = [model, automatic](const std::string& text) -> Expected<void> {
    const std::optional<Model> named = FromText<Model>(text);
    *automatic = text == "auto";
    if (!named && !*automatic) {
      return Fail("expected one of " + AllTexts<Model>() + ", auto, found '" + text + "'");
    }
    *model = named.value_or(Model::kSingleDiode);
    return {};
  };
  verb->AddReader("--model", read,
                  "number of diodes: sd, dd, td, or auto, which lets the data decide (default sd)")
      .Type("NAME")
      .OneOf(AllTexts<Model>() + ", auto")
      .Group("Model");
}

}  // namespace lyrefit
