#pragma once

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "lyrefit/batch/batch_task.h"
#include "lyrefit/batch/count_rows.h"
#include "lyrefit/batch/result_row.h"
#include "lyrefit/estimate/refine/estimate.h"
#include "lyrefit/model/cause.h"
#include "lyrefit/stream/batch_source.h"

namespace lyrefit {

// A value of a row as a cell: a number, a text, a whole number, a truth value, an optional of
// these, or a cell of text. NaN, an empty text and no value are unknown.
template <class Value>
ResultCell AsCell(const Value& value) {
  if constexpr (std::is_floating_point_v<Value>) {
    return NumberCell(value);
  } else if constexpr (std::is_integral_v<Value> && !std::is_same_v<Value, bool>) {
    return static_cast<std::int64_t>(value);
  } else if constexpr (std::is_convertible_v<Value, std::string>) {
    return TextCell(value);
  } else {
    return value;
  }
}
template <class Value>
ResultCell AsCell(const std::optional<Value>& value) {
  return value ? AsCell(*value) : ResultCell();
}

// The type of a column whose cells are made of such values.
template <class Value>
struct TypeOfCell {
  static constexpr CellType value = std::is_same_v<Value, bool>       ? CellType::kTruth
                                    : std::is_integral_v<Value>       ? CellType::kWhole
                                    : std::is_floating_point_v<Value> ? CellType::kNumber
                                                                      : CellType::kText;
};
template <class Value>
struct TypeOfCell<std::optional<Value>> : TypeOfCell<Value> {};

// A column of rows that are made of a T: its head, and its cell for one T.
template <class T>
struct RowColumn {
  // `value_of`: a function of a T, or a member of it.
  template <class Function>
  RowColumn(std::string name, std::string unit, std::string doc, Function value_of)
      : head{std::move(name), std::move(unit),
             TypeOfCell<std::decay_t<std::invoke_result_t<Function, const T&>>>::value,
             std::move(doc)},
        cell([own = std::move(value_of)](const T& of) { return AsCell(std::invoke(own, of)); }) {}

  ResultColumn head;
  std::function<ResultCell(const T&)> cell;
};

template <class T>
using ColumnList = std::vector<RowColumn<T>>;

// Adds the columns of a value and its 95 % interval, of a function that gives all three.
template <class T, class Function>
void AddRanged(const std::string& name, const std::string& unit, const std::string& doc,
               const Function& ranged_of, ColumnList<T>* columns) {
  const auto part = [&](const char* end, const std::string& what, double Ranged::*member) {
    columns->emplace_back(name + end, unit, what,
                          [=](const T& of) { return ranged_of(of).*member; });
  };
  part("", doc, &Ranged::value);
  part("_low_95", "its 95 % interval", &Ranged::low_95);
  part("_high_95", "its 95 % interval", &Ranged::high_95);
}

template <class T>
std::vector<ResultColumn> HeadsOf(const ColumnList<T>& columns) {
  std::vector<ResultColumn> heads;
  heads.reserve(columns.size());
  for (const RowColumn<T>& column : columns) heads.push_back(column.head);
  return heads;
}

template <class T>
std::vector<ResultCell> CellsOf(const ColumnList<T>& columns, const T& of) {
  std::vector<ResultCell> cells;
  cells.reserve(columns.size());
  for (const RowColumn<T>& column : columns) cells.push_back(column.cell(of));
  return cells;
}

// What the descriptions of the columns of a cause say of the kind of cause.
struct CauseDocs {
  std::string id;           // what is named, and its ids
  std::string about;        // what it may belong to
  std::string probability;  // of what against what
};

// "cause_sentence" of the curve itself, "plan_sentence" and the like.
std::string SentenceColumn(const std::string& prefix);

// The columns of a cause: its id, words and probability. Their names begin with `prefix`, as "plan_".
// `cause_of`: a member of a T, or a function of it.
template <class T, class Function>
ColumnList<T> CauseColumns(const std::string& prefix, const CauseDocs& docs, Function cause_of) {
  const auto member = [cause_of](auto Cause::*part) {
    return [cause_of, part](const T& of) { return std::invoke(cause_of, of).*part; };
  };
  const auto list = [cause_of](std::vector<std::string> Cause::*part, const char* between) {
    return [cause_of, part, between](const T& of) {
      return ListCell(std::invoke(cause_of, of).*part, between);
    };
  };
  return {{prefix + "cause", "", docs.id, member(&Cause::id)},
          {prefix + "cause_title", "", "the same in a few words", member(&Cause::title)},
          {prefix + "cause_about", "", docs.about, member(&Cause::group)},
          {SentenceColumn(prefix), "", "the same for a technician, with its size",
           member(&Cause::sentence)},
          {prefix + "equivalents", "", "ids that these readings cannot tell from it",
           list(&Cause::equivalents, " ")},
          {prefix + "separate_by", "", "measurements that would, with '; ' between them",
           list(&Cause::separate_by, "; ")},
          {prefix + "action", "", "the next thing to do about it", member(&Cause::action)},
          {prefix + "probability", "", docs.probability, member(&Cause::probability)}};
}

// The cause that such columns hold; what they do not hold is empty or unknown. `power`: the column of
// what the string gives less than without the cause.
Cause CauseIn(const RowReader& reader, const ResultRow& row, const std::string& prefix,
              const std::string& power);

// The columns of every row, for any task, before those of the task: id, location, conditions, key
// points and a sparkline.
std::vector<ResultColumn> CommonColumns();

// The cells of CommonColumns() for one curve, which may be broken, with the status, reason and key
// points of `result`.
std::vector<ResultCell> CommonCells(const BatchCurve& curve, const BatchItem& item,
                                    const TaskResult& result);

}  // namespace lyrefit
