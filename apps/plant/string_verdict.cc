#include "plant/string_verdict.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "lyrefit/base/append.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/batch/column.h"
#include "lyrefit/batch/string_pages.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr std::size_t kVisits = 10;

bool IsOf(const std::string& about, std::initializer_list<const char*> kinds) {
  for (const char* kind : kinds) {
    if (about == kind) return true;
  }
  return false;
}

bool IsPassed(const std::string& zone) { return zone.rfind("pass", 0) == 0; }
bool IsFailed(const std::string& zone) { return zone.rfind("fail", 0) == 0; }

// Single wrong readings are left out and disturb nothing else.
bool IsLeftOut(const Cause& cause) { return cause.id == "outliers"; }

ToDo ToDoOf(const StringVerdict& verdict) {
  const std::string& zone = verdict.zone;
  const Cause& cause = verdict.cause;
  const bool named = !cause.id.empty() && !IsLeftOut(cause);
  if (named && IsOf(cause.group, {"sweep", "instrument", "conditions"})) return ToDo::kMeasureAgain;
  if (named && cause.group == "plan") return ToDo::kCorrectPlan;
  if (IsFailed(zone)) return ToDo::kWork;
  if (named) return IsPassed(zone) ? ToDo::kInspect : ToDo::kWork;
  const bool differs = !verdict.outlier.empty() || (!cause.sentence.empty() && !IsLeftOut(cause));
  return differs && !IsPassed(zone) ? ToDo::kInspect : ToDo::kNothing;
}

// Whether the fault by the plan takes the place of the cause of the curve.
bool PlanGoesFirst(const Cause& curve, const Cause& plan) {
  if (plan.sentence.empty()) return false;
  if (curve.id.empty()) return true;
  if (plan.id.empty()) return false;
  if (curve.group != "device") return true;
  return MayBeOfScale(curve.id) &&
         !(curve.recoverable_power_W.value > plan.recoverable_power_W.value);
}

std::string InWords(const std::vector<std::string>& ids) {
  std::string text = fmt::format("{}", fmt::join(ids, ", or "));
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

// With a capital letter and a full stop.
std::string Sentence(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 32);
  return FullSentence(std::move(text));
}

std::string SeenIn(const StringVerdict& verdict) {
  const Cause& cause = verdict.cause;
  if (cause.sentence.empty()) {
    return verdict.outlier.empty() ? "No cause is named."
                                   : Sentence("it differs from its neighbours: " + verdict.outlier);
  }
  if (cause.id.empty()) return Sentence(cause.sentence);
  const std::string others = cause.equivalents.empty() ? "" : "; or " + InWords(cause.equivalents);
  return Sentence(cause.title + others) + " " + Sentence(cause.sentence);
}

std::string ToDoIn(const StringVerdict& verdict) {
  const std::string what = "to do: " + std::string(ToText(verdict.to_do));
  const bool only = verdict.to_do == ToDo::kNothing || verdict.cause.action.empty();
  return Sentence(only ? what : what + ": " + verdict.cause.action);
}

std::string Shown(const std::string& from) {
  return from == "curve"      ? "shown by its curve"
         : from == "plan"     ? "by its plan and its neighbours"
         : from == "campaign" ? "by its change since the last campaign"
                              : "by its neighbours";
}

const ColumnList<StringVerdict>& VerdictColumns() {
  using Of = const StringVerdict&;
  static const ColumnList<StringVerdict> columns = [] {
    ColumnList<StringVerdict> all = {
        {"string_to_do", "",
         "the verdict of the string, of its curve, its plan, its neighbours and its rating "
         "together: nothing, inspect (it passes and shows a fault), work, correct the plan, or "
         "measure again",
         [](Of of) { return ToText(of.to_do); }}};
    Append(
        CauseColumns<StringVerdict>(
            "string_",
            {"its cause: the id of cause or of plan_cause, or the first of change_candidates; "
             "empty: "
             "none is named",
             "what it belongs to: device; sweep, instrument or conditions, to be measured again; "
             "plan; or unknown",
             "of the cause, against all others"},
            &StringVerdict::cause),
        &all);
    Append({{"string_cause_from", "", "what shows it: curve, plan, neighbours or campaign",
             &StringVerdict::from},
            {"string_lost_W", "W",
             "what the string gives less than without the cause, in the light of the sweep",
             [](Of of) { return of.cause.recoverable_power_W.value; }}},
           &all);
    return all;
  }();
  return columns;
}

}  // namespace

double LostBy(const StringVerdict& verdict, double below_rating_W) {
  const double lost_W = verdict.cause.recoverable_power_W.value;
  return std::isfinite(lost_W) ? lost_W : below_rating_W;
}

bool IsNoCause(const std::string& cause) {
  return cause.empty() || cause == "none" || cause == "clean" || cause == "reference";
}

bool MayBeOfScale(const std::string& cause) {
  return IsOf(cause, {"series_resistance", "fill_factor"});
}

Cause StringJudge::OfCurve(const ResultRow& row) const {
  Cause cause = CauseIn(reader_, row, "", "recoverable_power_W");
  return IsNoCause(cause.id) ? Cause() : cause;
}

// Without deviation the sentence says why the string was not compared.
Cause StringJudge::OfPlan(const ResultRow& row) const {
  Cause cause = CauseIn(reader_, row, "plan_", "plan_lost_W");
  return cause.id.empty() && cause.sentence.rfind("not judged", 0) == 0 ? Cause() : cause;
}

Cause StringJudge::OfChange(const ResultRow& row) const {
  Cause cause;
  const std::string kind = reader_.Text(row, "change_kind");
  std::istringstream ids(reader_.Text(row, "change_candidates"));
  const double lost_W = reader_.Number(row, "change_lost_W");
  const bool of_device = !IsOf(kind, {"exchanged", "renamed", "measurement"});
  if (!of_device || !(ids >> cause.id)) return cause;
  const bool temperature = kind == "temperature";
  if (!temperature && !(lost_W > 0)) return Cause();
  for (std::string other; ids >> other;) cause.equivalents.push_back(other);
  cause.title = InWords({cause.id});
  cause.group = temperature ? "conditions" : "device";
  cause.sentence = "since the last campaign: " + reader_.Text(row, "change_sentence");
  cause.action = reader_.Text(row, "change_action");
  cause.probability = reader_.Number(row, "change_probability");
  cause.recoverable_power_W.value = lost_W;
  return cause;
}

bool StringJudge::IsFine(const ResultRow& row) const {
  const std::string status = reader_.Text(row, "status");
  return status.empty() || status == "fine";
}

StringVerdict StringJudge::Judge(const ResultRow& row) const {
  if (!IsFine(row)) return StringVerdict();
  StringVerdict verdict;
  verdict.cause = OfCurve(row);
  if (!verdict.cause.id.empty()) verdict.from = "curve";
  const Cause plan = OfPlan(row);
  if (PlanGoesFirst(verdict.cause, plan)) {
    verdict.cause = plan;
    const bool planned = std::isfinite(reader_.Number(row, "plan_modules_in_series"));
    verdict.from = planned ? "plan" : "neighbours";
  }
  if (verdict.cause.id.empty() || IsLeftOut(verdict.cause)) {
    const Cause change = OfChange(row);
    if (!change.id.empty()) {
      verdict.cause = change;
      verdict.from = "campaign";
    }
  }
  verdict.zone = reader_.Text(row, "zone");
  verdict.outlier = reader_.Text(row, "group_outlier");
  verdict.to_do = ToDoOf(verdict);
  const bool nameless = verdict.cause.id.empty() || IsLeftOut(verdict.cause);
  if (nameless && (verdict.to_do == ToDo::kWork || verdict.to_do == ToDo::kInspect)) {
    verdict.cause.action =
        "compare Isc and Voc with those of the neighbours, clean the light sensor and check its "
        "tilt, count the modules, clean one of them and measure again";
  }
  return verdict;
}

std::vector<ResultColumn> StringColumns() { return HeadsOf(VerdictColumns()); }

std::vector<ResultCell> StringCells(const StringVerdict& verdict) {
  return CellsOf(VerdictColumns(), verdict);
}

std::vector<std::string> SentencesOf(const StringVerdict& verdict) {
  const std::string rating =
      verdict.zone.empty() ? "" : Sentence(verdict.zone + " against the rating") + " ";
  const Cause& cause = verdict.cause;
  std::vector<std::string> sentences;
  if (cause.sentence.empty()) {
    sentences.push_back(rating + "No cause is named, by the curve or by its neighbours.");
  } else if (cause.id.empty()) {
    sentences.push_back(rating + Sentence(cause.sentence));
  } else {
    const std::string how_sure =
        std::isfinite(cause.probability)
            ? fmt::format("{:.0f} %, {}", 100 * cause.probability, Shown(verdict.from))
            : Shown(verdict.from);
    sentences.push_back(
        rating + Sentence(fmt::format("{} ({}): {}", cause.title, how_sure, cause.sentence)));
  }
  if (!verdict.outlier.empty()) {
    sentences.push_back(Sentence("against the others of its combiner: " + verdict.outlier));
  }
  sentences.push_back(ToDoIn(verdict));
  if (!cause.equivalents.empty() && !cause.separate_by.empty()) {
    sentences.push_back(
        Sentence(fmt::format("it may also be {}; to tell: {}", InWords(cause.equivalents),
                             fmt::join(cause.separate_by, "; "))));
  }
  return sentences;
}

std::string SeenAndToDo(const StringVerdict& verdict) {
  return SeenIn(verdict) + " " + ToDoIn(verdict);
}

Expected<void> StringAddition::Open(const RowsInput& input) {
  judge_.emplace(input.so_far);
  if (!judge_->judges()) judge_.reset();
  folder_ = input.folder;
  reader_ = RowReader(input.so_far);
  counts_.clear();
  visits_.clear();
  rows_ = 0;
  return {};
}

std::vector<ResultColumn> StringAddition::Columns() const {
  return judge_ ? StringColumns() : std::vector<ResultColumn>();
}

Expected<void> StringAddition::Add(RowGroup* group) {
  if (!judge_) return {};
  for (ResultRow& row : group->rows) {
    ++rows_;
    if (!judge_->IsFine(row)) {
      row.cells.resize(row.cells.size() + StringColumns().size());
      continue;
    }
    const StringVerdict verdict = judge_->Judge(row);
    const std::string page = reader_.Text(row, "page");
    if (!page.empty()) {
      TRY(AddToStringPage(folder_, page, SentencesOf(verdict), "From the curve alone:"));
    }
    List(row, verdict);
    Append(StringCells(verdict), &row.cells);
  }
  return {};
}

void StringAddition::List(const ResultRow& row, const StringVerdict& verdict) {
  ++counts_[verdict.to_do];
  if (!verdict.NeedsAVisit()) return;
  Visit visit = {reader_.Text(row, "id"), verdict,
                 LostBy(verdict, reader_.Number(row, "below_rating_W"))};
  // What needs work goes first, then what loses most.
  const auto before = [](const Visit& one, const Visit& other) {
    if (one.verdict.to_do != other.verdict.to_do) return one.verdict.to_do < other.verdict.to_do;
    return std::fmax(one.lost_W, 0) > std::fmax(other.lost_W, 0);
  };
  visits_.insert(std::upper_bound(visits_.begin(), visits_.end(), visit, before), visit);
  if (visits_.size() > kVisits) visits_.pop_back();
}

AddedReport StringAddition::Report() const {
  AddedReport report;
  if (!judge_) return report;
  std::map<std::string, std::int64_t> to_do;
  for (const auto& [what, rows] : counts_) to_do[std::string(ToText(what))] = rows;
  Section section = {"Which strings to visit first"};
  block::Table table = {"lrw", {{"string", "lost (W)", "what is seen, and what to do"}}};
  for (const Visit& visit : visits_) {
    table.rows.push_back({visit.id,
                          std::isfinite(visit.lost_W) ? fmt::format("{:.0f}", visit.lost_W) : "",
                          SeenAndToDo(visit.verdict)});
  }
  if (!table.rows.empty()) AddTable(std::move(table), &section);
  report.sections = {CountsSection("What to do", "to do", to_do, rows_), std::move(section)};
  return report;
}

}  // namespace lyrefit
