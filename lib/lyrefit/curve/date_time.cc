#include "lyrefit/curve/date_time.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <utility>

namespace lyrefit {
namespace {

// Days since 1970-01-01 of a date of the Gregorian calendar (Howard Hinnant, "chrono-Compatible
// Low-Level Date Algorithms", days_from_civil).
std::int64_t DaysOf(std::int64_t year, int month, int day) {
  year -= month <= 2 ? 1 : 0;
  const std::int64_t era = (year >= 0 ? year : year - 399) / 400;
  const auto of_era = year - era * 400;
  const int of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  const auto days = of_era * 365 + of_era / 4 - of_era / 100 + of_year;
  return era * 146097 + days - 719468;
}

struct Calendar {
  std::int64_t year = 0;
  int month = 0;
  int day = 0;
};

// The inverse of DaysOf (the same source, civil_from_days).
Calendar DateOf(std::int64_t days) {
  days += 719468;
  const std::int64_t era = (days >= 0 ? days : days - 146096) / 146097;
  const std::int64_t of_era = days - era * 146097;
  const std::int64_t year = (of_era - of_era / 1460 + of_era / 36524 - of_era / 146096) / 365;
  const int of_year = static_cast<int>(of_era - (365 * year + year / 4 - year / 100));
  const int shifted = (5 * of_year + 2) / 153;
  const int day = of_year - (153 * shifted + 2) / 5 + 1;
  const int month = shifted < 10 ? shifted + 3 : shifted - 9;
  return {year + era * 400 + (month <= 2 ? 1 : 0), month, day};
}

// Reads numbers and the characters between them.
class DateScanner {
 public:
  explicit DateScanner(std::string_view text) : at_(text.data()), end_(at_ + text.size()) {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '"')) ++at_;
    while (at_ != end_ && (end_[-1] == ' ' || end_[-1] == '"')) --end_;
  }

  bool Done() const { return at_ == end_; }
  char Peek() const { return at_ == end_ ? '\0' : *at_; }
  bool Take(char c) {
    if (Peek() != c) return false;
    ++at_;
    return true;
  }
  // A number without a sign.
  bool Whole(int* value, int* digits = nullptr) {
    if (Peek() < '0' || Peek() > '9') return false;
    const auto found = std::from_chars(at_, end_, *value);
    if (found.ec != std::errc()) return false;
    if (digits != nullptr) *digits = static_cast<int>(found.ptr - at_);
    at_ = found.ptr;
    return true;
  }
  // The digits after a decimal point.
  double Fraction() {
    double value = 0, scale = 0.1;
    while (Peek() >= '0' && Peek() <= '9') {
      value += scale * (*at_++ - '0');
      scale /= 10;
    }
    return value;
  }

 private:
  const char* at_;
  const char* end_;
};

// Three numbers to a date; see ReadDateTime.
bool ReadDate(DateScanner* scan, DateOrder order, Calendar* date) {
  std::array<int, 3> part{};
  int digits = 0;
  if (!scan->Whole(part.data(), &digits)) return false;
  const char between = scan->Peek();
  if (between != '-' && between != '/' && between != '.') return false;
  if (!scan->Take(between) || !scan->Whole(&part[1])) return false;
  if (!scan->Take(between) || !scan->Whole(&part[2])) return false;
  if (digits == 4) {
    *date = {part[0], part[1], part[2]};
  } else if (between == '.') {
    *date = {part[2], part[1], part[0]};
  } else if (between == '/') {
    if ((part[0] > 12) != (part[1] > 12)) {
      const DateOrder own = part[0] > 12 ? DateOrder::kDayFirst : DateOrder::kMonthFirst;
      if (order != DateOrder::kUnknown && order != own) return false;
      order = own;
    }
    if (order == DateOrder::kUnknown) return false;
    if (order == DateOrder::kMonthFirst) std::swap(part[0], part[1]);
    *date = {part[2], part[1], part[0]};
  } else {
    return false;
  }
  if (digits != 4 && date->year < 100) date->year += 2000;
  if (date->year < 1900 || date->year > 2999 || date->month < 1 || date->month > 12 ||
      date->day < 1 || date->day > 31) {
    return false;
  }
  const Calendar back = DateOf(DaysOf(date->year, date->month, date->day));
  return back.month == date->month && back.day == date->day;
}

// Seconds of the day; what is not stated is 0.
bool ReadTimeOfDay(DateScanner* scan, double* seconds) {
  int hour = 0, minute = 0, second = 0;
  if (!scan->Whole(&hour) || !scan->Take(':') || !scan->Whole(&minute)) return false;
  double fraction = 0;
  if (scan->Take(':')) {
    if (!scan->Whole(&second)) return false;
    if (scan->Take('.') || scan->Take(',')) fraction = scan->Fraction();
  }
  while (scan->Take(' ')) {
  }
  const bool afternoon = scan->Peek() == 'P' || scan->Peek() == 'p';
  if (afternoon || scan->Peek() == 'A' || scan->Peek() == 'a') {
    scan->Take(scan->Peek());
    if (!scan->Take('M') && !scan->Take('m')) return false;
    if (hour < 1 || hour > 12) return false;
    hour = hour % 12 + (afternoon ? 12 : 0);
  }
  if (hour >= 24 || minute >= 60 || second >= 61) return false;
  *seconds = 3600 * hour + 60 * minute + second + fraction;
  return true;
}

bool SkipOffset(DateScanner* scan) {
  if (scan->Take('Z')) return true;
  if (!scan->Take('+') && !scan->Take('-')) return true;
  int hours = 0, minutes = 0;
  if (!scan->Whole(&hours)) return false;
  if (scan->Take(':') && !scan->Whole(&minutes)) return false;
  return true;
}

}  // namespace

DateOrder OrderOfDate(std::string_view text) {
  const bool day_first = ReadDateTime(text, DateOrder::kDayFirst).has_value();
  const bool month_first = ReadDateTime(text, DateOrder::kMonthFirst).has_value();
  if (day_first == month_first) return DateOrder::kUnknown;
  return day_first ? DateOrder::kDayFirst : DateOrder::kMonthFirst;
}

std::optional<double> ReadDateTime(std::string_view text, DateOrder order) {
  DateScanner scan(text);
  Calendar date;
  if (!ReadDate(&scan, order, &date)) return std::nullopt;
  double seconds = 0;
  if (!scan.Done()) {
    if (!scan.Take('T') && !scan.Take(' ')) return std::nullopt;
    while (scan.Take(' ')) {
    }
    if (!ReadTimeOfDay(&scan, &seconds) || !SkipOffset(&scan)) return std::nullopt;
  }
  if (!scan.Done()) return std::nullopt;
  return kDay_s * static_cast<double>(DaysOf(date.year, date.month, date.day)) + seconds;
}

std::string DateText(double seconds) {
  if (!std::isfinite(seconds)) return "-";
  const Calendar date = DateOf(static_cast<std::int64_t>(std::floor(seconds / kDay_s)));
  return fmt::format("{:04d}-{:02d}-{:02d}", date.year, date.month, date.day);
}

std::string DateTimeText(double seconds) {
  if (!std::isfinite(seconds)) return "-";
  const double whole = std::floor(seconds + 0.5);
  const auto of_day = static_cast<std::int64_t>(whole - kDay_s * std::floor(whole / kDay_s));
  return fmt::format("{} {:02d}:{:02d}:{:02d}", DateText(whole), of_day / 3600, of_day / 60 % 60,
                     of_day % 60);
}

}  // namespace lyrefit
