#include <map>

#include "lyrefit/curve/date_time.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/trend/trend_documents.h"
#include "lyrefit/trend/trend_report.h"

namespace lyrefit {

std::string TrendCsv(const TrendReport& report) {
  std::map<double, std::vector<double>> rows;  // by time: quantities, then parts of the loss
  const std::size_t quantities = report.quantities.size();
  const std::size_t columns = quantities + report.loss_days.size();
  std::vector<std::string> head = {"time"};
  const auto put = [&](std::size_t column, const TrendDay& day) {
    auto [at, fresh] = rows.try_emplace(day.time_s);
    if (fresh) at->second.assign(columns, kUnknown);
    at->second[column] = day.value;
  };
  for (std::size_t q = 0; q < quantities; ++q) {
    const TrendQuantity& quantity = report.quantities[q];
    head.push_back(quantity.name + "_" + (quantity.unit == "%" ? "percent" : quantity.unit));
    for (const TrendDay& day : quantity.days) put(q, day);
  }
  for (std::size_t p = 0; p < report.loss_days.size(); ++p) {
    head.push_back("loss_" + report.losses[p].name + "_percent");
    for (const TrendDay& day : report.loss_days[p]) put(quantities + p, day);
  }
  std::string text = CsvLine(head);
  for (const auto& [time, values] : rows) {
    std::vector<std::string> fields = {DateTimeText(time)};
    for (const double value : values) fields.push_back(CsvField(value));
    text += CsvLine(fields);
  }
  return text;
}

}  // namespace lyrefit
