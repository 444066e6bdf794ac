#pragma once

#include <string>

#include "lyrefit/batch/column.h"
#include "lyrefit/batch/count_rows.h"
#include "lyrefit/model/cause.h"

namespace lyrefit {

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

}  // namespace lyrefit
