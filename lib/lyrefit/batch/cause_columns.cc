#include "lyrefit/batch/cause_columns.h"

#include <boost/algorithm/string/finder.hpp>
#include <boost/algorithm/string/iter_find.hpp>

namespace lyrefit {
namespace {

// The texts of a cell by ListCell.
std::vector<std::string> ListIn(const std::string& text, const char* between) {
  std::vector<std::string> texts;
  if (!text.empty()) boost::iter_split(texts, text, boost::first_finder(between));
  return texts;
}

}  // namespace

std::string SentenceColumn(const std::string& prefix) {
  return prefix.empty() ? "cause_sentence" : prefix + "sentence";
}

Cause CauseIn(const RowReader& reader, const ResultRow& row, const std::string& prefix,
              const std::string& power) {
  const auto text = [&](const char* name) { return reader.Text(row, prefix + name); };
  Cause cause;
  cause.id = text("cause");
  cause.title = text("cause_title");
  cause.group = text("cause_about");
  cause.sentence = reader.Text(row, SentenceColumn(prefix));
  cause.equivalents = ListIn(text("equivalents"), " ");
  cause.separate_by = ListIn(text("separate_by"), "; ");
  cause.action = text("action");
  cause.probability = reader.Number(row, prefix + "probability");
  cause.recoverable_power_W.value = reader.Number(row, power);
  return cause;
}

}  // namespace lyrefit
