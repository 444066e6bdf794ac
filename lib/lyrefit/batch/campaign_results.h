#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/batch/campaign.h"
#include "lyrefit/batch/checkpoint.h"
#include "lyrefit/batch/result_row.h"

namespace lyrefit {

// Name of the digest of the earlier results among the options of a run.
inline constexpr char kBeforeOption[] = "before";
// Name of the column of bypass diodes, which runs with earlier results have.
inline constexpr char kBypassDiodesColumn[] = "bypass_diodes";

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
// digest is that of the text.
std::string EarlierText(const EarlierResults& earlier);
std::string EarlierDigest(const std::string& text);
std::string EarlierCopyPath(const std::string& folder);  // DIR/before.part

Expected<EarlierResults> ReadEarlierCopy(const std::string& path, const std::string& digest);

// Columns of the figures and of their uncertainties, in the order of CampaignFigure.
inline constexpr const char* kFigureColumns[] = {"Isc_stc_A",  "Voc_stc_V", "FF_stc",
                                                 "Pmax_stc_W", "Imp_stc_A", "Vmp_stc_V"};
inline constexpr const char* kExpandedColumns[] = {"Isc_stc_U_A",  "Voc_stc_U_V", "FF_stc_U",
                                                   "Pmax_stc_U_W", "Imp_stc_U_A", "Vmp_stc_U_V"};

// Whether a cause about this (column cause_about) is a light or a condition that changed during the
// sweep.
bool IsOfSweep(const std::string& about);

// The summary as one JSON object, campaign.json, and back. A missing member keeps its default.
BatchJson CampaignJson(const CampaignSummary& summary);
CampaignSummary CampaignOf(const BatchJson& json);

// Takes the strings of the later campaign from the rows, compares, and gives the cells of the rows
// in the same order.
class CampaignResults {
 public:
  // Null if the run has no earlier results. The copy is in the folder of one of the `parts`.
  // Errors: it is in none of them, or it was changed.
  static Expected<std::unique_ptr<CampaignResults>> Open(const CheckpointHead& head,
                                                         const std::vector<std::string>& parts,
                                                         const std::vector<ResultColumn>& columns);

  void Take(const ResultRow& row);
  void Compare();                       // after the last row
  std::vector<ResultCell> NextCells();  // of the first row, the second, ...
  CampaignSummary Summary() const;

 private:
  CampaignResults(EarlierResults earlier, const std::vector<ResultColumn>& columns, double level);

  struct Places {
    std::size_t id, cause, about, diodes;
    std::array<std::size_t, kCampaignKept> values, expanded;
  };
  EarlierResults earlier_;
  Places at_;
  double level_;
  std::vector<CampaignString> later_;
  Campaign campaign_;
  std::size_t next_ = 0;
};

}  // namespace lyrefit
