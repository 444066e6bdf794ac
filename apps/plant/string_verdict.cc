#include "plant/string_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <variant>

#include "lyrefit/base/append.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/try.h"
#include "lyrefit/batch/batch_task.h"
#include "lyrefit/batch/count_rows.h"
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
bool IsLeftOut(const StringVerdict& verdict) { return verdict.cause == "outliers"; }

ToDo ToDoOf(const StringVerdict& verdict) {
  const std::string& zone = verdict.zone;
  const bool named = !verdict.cause.empty() && !IsLeftOut(verdict);
  if (named && IsOf(verdict.about, {"sweep", "instrument", "conditions"})) {
    return ToDo::kMeasureAgain;
  }
  if (named && verdict.about == "plan") return ToDo::kCorrectPlan;
  if (IsFailed(zone)) return ToDo::kWork;
  if (named) return IsPassed(zone) ? ToDo::kInspect : ToDo::kWork;
  const bool differs =
      !verdict.outlier.empty() || (!verdict.sentence.empty() && !IsLeftOut(verdict));
  return differs && !IsPassed(zone) ? ToDo::kInspect : ToDo::kNothing;
}

// Whether the fault by the plan takes the place of the cause of the curve.
bool PlanGoesFirst(const StringVerdict& curve, const StringVerdict& plan) {
  if (plan.sentence.empty()) return false;
  if (curve.cause.empty()) return true;
  if (plan.cause.empty()) return false;
  if (curve.about != "device") return true;
  return MayBeOfScale(curve.cause) && !(curve.lost_W > plan.lost_W);
}

std::string InWords(const std::string& ids) {
  std::string text;
  for (const char c : ids) {
    if (c == ' ') {
      text += ", or ";
    } else {
      text += c == '_' ? ' ' : c;
    }
  }
  return text;
}

// With a capital letter and a full stop.
std::string Sentence(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 32);
  return FullSentence(std::move(text));
}

std::string ToDoIn(const StringVerdict& verdict) {
  const std::string what = "to do: " + std::string(ToText(verdict.to_do));
  const bool only = verdict.to_do == ToDo::kNothing || verdict.action.empty();
  return Sentence(only ? what : what + ": " + verdict.action);
}

std::string Shown(const std::string& from) {
  return from == "curve"  ? "shown by its curve"
         : from == "plan" ? "by its plan and its neighbours"
                          : "by its neighbours";
}

}  // namespace

double LostBy(const StringVerdict& verdict, double below_rating_W) {
  return std::isfinite(verdict.lost_W) ? verdict.lost_W : below_rating_W;
}

bool IsNoCause(const std::string& cause) {
  return cause.empty() || cause == "none" || cause == "clean" || cause == "reference";
}

bool MayBeOfScale(const std::string& cause) {
  return IsOf(cause, {"series_resistance", "fill_factor"});
}

StringJudge::StringJudge(const std::vector<ResultColumn>& columns) {
  constexpr const char* kNames[] = {"status",
                                    "zone",
                                    "cause",
                                    "cause_title",
                                    "cause_about",
                                    "cause_sentence",
                                    "action",
                                    "probability",
                                    "recoverable_power_W",
                                    "equivalents",
                                    "separate_by",
                                    "plan_cause",
                                    "plan_cause_title",
                                    "plan_cause_about",
                                    "plan_sentence",
                                    "plan_action",
                                    "plan_probability",
                                    "plan_lost_W",
                                    "plan_equivalents",
                                    "plan_separate_by",
                                    "plan_modules_in_series",
                                    "group_outlier"};
  static_assert(std::size(kNames) == kKnown);
  const auto has = [&](Known known) { return places_[known] < columns.size(); };
  for (int known = 0; known < kKnown; ++known) {
    places_[known] = ColumnPlace(columns, kNames[known]);
  }
  judges_ = has(kZone) || has(kPlanCause);
}

std::string StringJudge::Text(const ResultRow& row, Known column) const {
  if (places_[column] >= row.cells.size()) return "";
  const auto* const text = std::get_if<std::string>(&row.cells[places_[column]]);
  return text == nullptr ? "" : *text;
}

double StringJudge::Number(const ResultRow& row, Known column) const {
  if (places_[column] >= row.cells.size()) return kUnknown;
  const auto* const number = std::get_if<double>(&row.cells[places_[column]]);
  return number == nullptr ? kUnknown : *number;
}

StringVerdict StringJudge::OfCurve(const ResultRow& row) const {
  StringVerdict verdict;
  verdict.cause = Text(row, kCause);
  if (IsNoCause(verdict.cause)) verdict.cause.clear();
  if (verdict.cause.empty()) return verdict;
  verdict.from = "curve";
  verdict.title = Text(row, kTitle);
  verdict.about = Text(row, kAbout);
  verdict.sentence = Text(row, kSentence);
  verdict.action = Text(row, kAction);
  verdict.equivalents = Text(row, kEquivalents);
  verdict.separate_by = Text(row, kSeparate);
  verdict.probability = Number(row, kProbability);
  verdict.lost_W = Number(row, kRecoverable);
  return verdict;
}

StringVerdict StringJudge::OfPlan(const ResultRow& row) const {
  StringVerdict verdict;
  const std::string sentence = Text(row, kPlanSentence);
  // Without deviation the sentence says why the string was not compared.
  if (Text(row, kPlanCause).empty() && sentence.rfind("not judged", 0) == 0) return verdict;
  verdict.sentence = sentence;
  if (sentence.empty()) return verdict;
  const bool planned = places_[kPlanModules] < row.cells.size() &&
                       !std::holds_alternative<std::monostate>(row.cells[places_[kPlanModules]]);
  verdict.from = planned ? "plan" : "neighbours";
  verdict.cause = Text(row, kPlanCause);
  verdict.title = Text(row, kPlanTitle);
  verdict.about = Text(row, kPlanAbout);
  verdict.action = Text(row, kPlanAction);
  verdict.equivalents = Text(row, kPlanEquivalents);
  verdict.separate_by = Text(row, kPlanSeparate);
  verdict.probability = Number(row, kPlanProbability);
  verdict.lost_W = Number(row, kPlanLost);
  return verdict;
}

bool StringJudge::IsFine(const ResultRow& row) const {
  const std::string status = Text(row, kStatus);
  return status.empty() || status == "fine";
}

StringVerdict StringJudge::Judge(const ResultRow& row) const {
  if (!IsFine(row)) return StringVerdict();
  StringVerdict curve = OfCurve(row);
  StringVerdict plan = OfPlan(row);
  StringVerdict verdict = PlanGoesFirst(curve, plan) ? std::move(plan) : std::move(curve);
  verdict.zone = Text(row, kZone);
  verdict.outlier = Text(row, kOutlier);
  verdict.to_do = ToDoOf(verdict);
  const bool nameless = verdict.cause.empty() || IsLeftOut(verdict);
  if (nameless && (verdict.to_do == ToDo::kWork || verdict.to_do == ToDo::kInspect)) {
    verdict.action =
        "compare Isc and Voc with those of the neighbours, clean the light sensor and check its "
        "tilt, count the modules, clean one of them and measure again";
  }
  return verdict;
}

std::vector<ResultColumn> StringColumns() {
  constexpr CellType kText = CellType::kText;
  constexpr CellType kNumber = CellType::kNumber;
  return {
      {"string_to_do", "", kText,
       "the verdict of the string, of its curve, its plan, its neighbours and its rating together: "
       "nothing, inspect (it passes and shows a fault), work, correct the plan, or measure again"},
      {"string_cause", "", kText,
       "its cause: the id of cause or of plan_cause; empty: none is named"},
      {"string_cause_title", "", kText, "the same in a few words"},
      {"string_cause_about", "", kText,
       "what it belongs to: device; sweep, instrument or conditions, to be measured again; plan; "
       "or "
       "unknown"},
      {"string_cause_from", "", kText, "what shows it: curve, plan or neighbours"},
      {"string_sentence", "", kText, "the same for a technician, with its size"},
      {"string_action", "", kText, "the next thing to do about it"},
      {"string_probability", "", kNumber, "of the cause, against all others"},
      {"string_lost_W", "W", kNumber,
       "what the string gives less than without the cause, in the light of the sweep"},
  };
}

std::vector<ResultCell> StringCells(const StringVerdict& verdict) {
  return {
      TextCell(ToText(verdict.to_do)), TextCell(verdict.cause),         TextCell(verdict.title),
      TextCell(verdict.about),         TextCell(verdict.from),          TextCell(verdict.sentence),
      TextCell(verdict.action),        NumberCell(verdict.probability), NumberCell(verdict.lost_W)};
}

std::vector<std::string> SentencesOf(const StringVerdict& verdict) {
  const std::string rating =
      verdict.zone.empty() ? "" : Sentence(verdict.zone + " against the rating") + " ";
  std::vector<std::string> sentences;
  if (verdict.sentence.empty()) {
    sentences.push_back(rating + "No cause is named, by the curve or by its neighbours.");
  } else if (verdict.cause.empty()) {
    sentences.push_back(rating + Sentence(verdict.sentence));
  } else {
    const std::string how_sure =
        std::isfinite(verdict.probability)
            ? fmt::format("{:.0f} %, {}", 100 * verdict.probability, Shown(verdict.from))
            : Shown(verdict.from);
    sentences.push_back(
        rating + Sentence(fmt::format("{} ({}): {}", verdict.title, how_sure, verdict.sentence)));
  }
  if (!verdict.outlier.empty()) {
    sentences.push_back(Sentence("against the others of its combiner: " + verdict.outlier));
  }
  sentences.push_back(ToDoIn(verdict));
  if (!verdict.equivalents.empty() && !verdict.separate_by.empty()) {
    sentences.push_back(Sentence(fmt::format("it may also be {}; to tell: {}",
                                             InWords(verdict.equivalents), verdict.separate_by)));
  }
  return sentences;
}

std::string SeenOf(const StringVerdict& verdict) {
  if (verdict.sentence.empty()) {
    return verdict.outlier.empty() ? "No cause is named."
                                   : Sentence("it differs from its neighbours: " + verdict.outlier);
  }
  if (verdict.cause.empty()) return Sentence(verdict.sentence);
  const std::string others =
      verdict.equivalents.empty() ? "" : "; or " + InWords(verdict.equivalents);
  return Sentence(verdict.title + others) + " " + Sentence(verdict.sentence);
}

Expected<void> StringAddition::Open(const RowsInput& input) {
  judge_.emplace(input.so_far);
  if (!judge_->judges()) judge_.reset();
  folder_ = input.folder;
  id_ = ColumnPlace(input.so_far, "id");
  page_ = ColumnPlace(input.so_far, "page");
  below_ = ColumnPlace(input.so_far, "below_rating_W");
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
    if (const auto* const page = CellAt<std::string>(row, page_)) {
      TRY(AddToStringPage(folder_, *page, SentencesOf(verdict), "From the curve alone:"));
    }
    List(row, verdict);
    Append(StringCells(verdict), &row.cells);
  }
  return {};
}

void StringAddition::List(const ResultRow& row, const StringVerdict& verdict) {
  ++counts_[verdict.to_do];
  if (!verdict.NeedsAVisit()) return;
  const auto* const id = CellAt<std::string>(row, id_);
  const double below_W = below_ == kNoColumn ? kUnknown : NumberAt(row, below_);
  Visit visit = {id == nullptr ? "" : *id, verdict, LostBy(verdict, below_W)};
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
                          SeenOf(visit.verdict) + " " + ToDoIn(visit.verdict)});
  }
  if (!table.rows.empty()) AddTable(std::move(table), &section);
  report.sections = {CountsSection("What to do", "to do", to_do, rows_), std::move(section)};
  return report;
}

}  // namespace lyrefit
