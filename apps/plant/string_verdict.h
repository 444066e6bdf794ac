#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/enum_text.h"
#include "lyrefit/batch/addition.h"
#include "lyrefit/batch/count_rows.h"
#include "lyrefit/batch/result_row.h"
#include "lyrefit/model/cause.h"

namespace lyrefit {

// The one verdict of a string, made of all that its row holds: the rating (zone), the cause that its
// curve shows, the fault by which it differs from plan and neighbours, what changed since the earlier
// campaign, and its combiner. The row, the
// string's page, the plant's page and the summary print it, and nothing else as a verdict.

// What is to be done about a string, the most urgent first.
enum class ToDo {
  kWork,          // it fails, or a fault of the device shows and it does not pass
  kCorrectPlan,   // the plan is wrong, not the string
  kInspect,       // it passes and shows a fault, or differs from its neighbours and does not fail
  kMeasureAgain,  // the light, a sensor or the instrument disturbed the measurement
  kNothing,       // it passes, or nobody asks of it, and no cause is seen
};

template <>
struct EnumTable<ToDo> {
  static constexpr EnumText<ToDo> kRows[] = {{ToDo::kNothing, "nothing"},
                                             {ToDo::kInspect, "inspect"},
                                             {ToDo::kWork, "work"},
                                             {ToDo::kCorrectPlan, "correct the plan"},
                                             {ToDo::kMeasureAgain, "measure again"}};
};

struct StringVerdict {
  ToDo to_do = ToDo::kNothing;
  std::string zone;  // against the rating; empty: no field test
  std::string
      from;  // "curve", "plan", "neighbours" or "campaign": what shows the cause; empty: none
  std::string outlier;  // how it differs from the strings of its combiner
  // What the table says of it. Its id is empty where none has a name; a difference from the plan
  // without a name has a sentence.
  Cause cause;

  bool NeedsWork() const { return to_do == ToDo::kWork || to_do == ToDo::kCorrectPlan; }
  bool NeedsAVisit() const { return NeedsWork() || to_do == ToDo::kInspect; }
};

// Judges the rows of a table of results.
class StringJudge {
 public:
  explicit StringJudge(const std::vector<ResultColumn>& columns) : reader_(columns) {}
  // Whether the rows are of strings of a plant: they have a zone or a plan.
  bool judges() const { return reader_.Has("zone") || reader_.Has("plan_cause"); }
  // False for a row whose status is not fine.
  bool IsFine(const ResultRow& row) const;
  // Nothing of a row that is not fine.
  StringVerdict Judge(const ResultRow& row) const;

 private:
  Cause OfCurve(const ResultRow& row) const;
  Cause OfPlan(const ResultRow& row) const;
  // Of a loss since the earlier campaign, or of a temperature that was read otherwise.
  Cause OfChange(const ResultRow& row) const;

  RowReader reader_;
};

// What the string gives less by its cause, else than its rating; NaN: unknown.
double LostBy(const StringVerdict& verdict, double below_rating_W);

// Whether `cause` means that none was found, in any of its notations.
bool IsNoCause(const std::string& cause);

// Whether a fault outside the modules may look like this cause of a curve: a parameter of the device
// that cables change.
bool MayBeOfScale(const std::string& cause);

// The columns string_to_do, string_cause, ..., and their cells.
std::vector<ResultColumn> StringColumns();
std::vector<ResultCell> StringCells(const StringVerdict& verdict);

// The verdict as sentences: what it is and what shows it, what to do, what would tell more.
std::vector<std::string> SentencesOf(const StringVerdict& verdict);
// What is seen and what to do, for a table: the cause, what it may be as well, its sentence, the action.
std::string SeenAndToDo(const StringVerdict& verdict);

// Adds the verdict of each string to its row and to its page, if it has one, and lists in the report
// the strings to visit first. It stands after all other additions, whose cells it reads.
class StringAddition final : public BatchAddition {
 public:
  Expected<void> Open(const RowsInput& input) override;
  std::vector<ResultColumn> Columns() const override;
  Expected<void> Add(RowGroup* group) override;
  AddedReport Report() const override;

 private:
  struct Visit {
    std::string id;
    StringVerdict verdict;
    double lost_W = kUnknown;  // by its cause, else below the rating
  };
  void List(const ResultRow& row, const StringVerdict& verdict);

  std::optional<StringJudge> judge_;
  std::string folder_;
  RowReader reader_;
  std::map<ToDo, std::int64_t> counts_;
  std::int64_t rows_ = 0;
  std::vector<Visit> visits_;  // the first kVisits, in the order of a tour
};

}  // namespace lyrefit
