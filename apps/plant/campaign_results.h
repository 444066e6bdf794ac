#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/batch/addition.h"
#include "lyrefit/batch/count_rows.h"
#include "plant/additions.h"
#include "plant/campaign.h"

namespace lyrefit {

// Name of the digest of the earlier results among the options of a run.
inline constexpr char kBeforeOption[] = "before";
// The results of an earlier run of task field-test, reduced to the figures that are compared.
struct EarlierResults {
  std::string version;                      // of lyrefit; "unknown" without a schema
  BatchJson options = BatchJson::object();  // of the run; empty without a schema
  std::string options_place;                // file that states them
  std::string first_date, last_date;        // of the sweeps, as written
  std::vector<CampaignString> strings;      // one for each row
};

// Reads results.jsonl, else results.csv, of a folder, or one of both files. results.schema.json
// beside it is read if it exists. Errors, with file, line and column: nothing there; an unfinished
// run; results of another task; a missing column; a row or a number that cannot be read.
Expected<EarlierResults> ReadEarlierResults(const std::string& path);

// Checks that both runs carry curves to standard conditions alike: the coefficients are the same.
// `options`: those of the later run.
Expected<void> CheckSameCoefficients(const EarlierResults& earlier, const BatchJson& options);

// The results as text: a copy for the folder of a run, which its results are made with later. The
// digest is TextDigest of it.
std::string EarlierText(const EarlierResults& earlier);

inline constexpr char kEarlierCopy[] = "before.part";  // its name in the folder of a run

Expected<EarlierResults> ReadEarlierCopy(const std::string& path, const std::string& digest);

// Columns of the figures and of their uncertainties, in the order of CampaignFigure.
inline constexpr const char* kFigureColumns[] = {"Isc_stc_A",  "Voc_stc_V", "FF_stc",
                                                 "Pmax_stc_W", "Imp_stc_A", "Vmp_stc_V"};
inline constexpr const char* kMeasuredColumns[] = {"Isc_A",  "Voc_V", "FF",
                                                   "Pmax_W", "Imp_A", "Vmp_V"};
inline constexpr const char* kExpandedColumns[] = {"Isc_stc_U_A",  "Voc_stc_U_V", "FF_stc_U",
                                                   "Pmax_stc_U_W", "Imp_stc_U_A", "Vmp_stc_U_V"};

// Whether a cause about this (column cause_about) is a light or a condition that changed during the
// sweep.
bool IsOfSweep(const std::string& about);

// The summary as one JSON object, campaign.json, and back. A missing member keeps its default.
BatchJson CampaignJson(const CampaignSummary& summary);
CampaignSummary CampaignOf(const BatchJson& json);

// Compares the strings of a run with those of the earlier results that it names. It takes their
// later figures from the rows, compares, and gives the cells of the rows in the same order.
class CampaignAddition final : public BatchAddition {
 public:
  CampaignAddition(PlantOptions options, PlantResults* results)
      : options_(std::move(options)), results_(results) {}

  void AddToTask(BatchTaskType* task) const override;
  // Reads the earlier results, names them in the options, and keeps a copy of their figures.
  Expected<std::vector<ResultFile>> Begin(const BatchTaskType& task, const std::string& folder,
                                          BatchJson* options) const override;
  std::vector<std::string> FileNames() const override;
  // The copy is in the folder of one of the parts. Errors: it is in none of them, or was changed.
  Expected<void> Open(const RowsInput& input) override;
  std::vector<ResultColumn> Columns() const override;
  void Learn(const RowGroup& group) override;
  void EndLearning() override;
  Expected<void> Add(RowGroup* group) override;
  AddedReport Report() const override;
  std::vector<ResultFile> Files() const override;

 private:
  // What is learned of one run.
  struct State {
    EarlierResults earlier;
    double level = 0;
    RowReader reader;
    std::vector<CampaignString> later = {};
    Campaign campaign = {};
    std::size_t next = 0;  // index of the row that gets its cells next
  };
  CampaignSummary Summary() const;

  const PlantOptions options_;
  PlantResults* const results_;
  std::optional<State> state_;  // empty: a run without earlier results
};

}  // namespace lyrefit
