#pragma once

#include <memory>
#include <string>
#include <vector>

#include "effects.h"
#include "keywords.h"
#include "lyrefit/fit/fit_options.h"
#include "lyrefit/fit/fit_report.h"
#include "result.h"

namespace lyrefit::python {

// What fit and fit_many are asked beside the curve: everything in kFitOptionTable and
// kSearchOptionTable, bounds, and model='auto'.
struct FitKeywords {
  FitOptions options;
  bool auto_model = false;
  std::string bounds = "physical";  // a name or file, where `box` has none
  bool box = false;                 // options.bounds holds a table of ranges
  OwnEffects own;                   // of options.with
  Faults faults;                    // of these and a searcher; with any, one thread is used
};
FitKeywords ReadFitKeywords(Keywords* keywords, const FitOptions& usual = {});
void AppendFitNotes(const FitOptions& usual, std::vector<KeywordNote>* notes);

// The same for a curve read from `file`, beside which published bounds lie.
Expected<FitOptions> OptionsFor(const FitKeywords& asked, const std::string& file);

// A fit, as the verb gives it.
class FitResult : public Result {
 public:
  explicit FitResult(std::shared_ptr<const FitReport> report);
  const FitReport& report() const { return *report_; }

 private:
  std::shared_ptr<const FitReport> report_;
};

}  // namespace lyrefit::python
