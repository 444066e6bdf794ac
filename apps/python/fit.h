#pragma once

#include <memory>
#include <string>
#include <vector>

#include "effects.h"
#include "keywords.h"
#include "lyrefit/estimate/fit/fit_options.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "result.h"

namespace lyrefit::python {

// Keywords of fit and fit_many besides the curve: all of kFitOptionTable and kSearchOptionTable,
// bounds, and model='auto'.
struct FitKeywords {
  FitOptions options;
  bool auto_model = false;
  std::string bounds = "physical";  // a name or file; unused if `box`
  bool box = false;                 // options.bounds holds a table of ranges
  OwnEffects own;                   // custom effects of options.with
  Faults faults;                    // of `own` and of a searcher; if not empty, one thread is used
};
FitKeywords ReadFitKeywords(Keywords* keywords, const FitOptions& usual = {});
void AppendFitNotes(const FitOptions& usual, std::vector<KeywordNote>* notes);

// Fit options for a curve read from `file`; published bounds are in a file beside it.
Expected<FitOptions> OptionsFor(const FitKeywords& asked, const std::string& file);

// Result of the verb fit.
class FitResult : public Result {
 public:
  explicit FitResult(std::shared_ptr<const FitReport> report);
  const FitReport& report() const { return *report_; }

 private:
  std::shared_ptr<const FitReport> report_;
};

}  // namespace lyrefit::python
