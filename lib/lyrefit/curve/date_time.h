// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Seconds per day.
constexpr double kDay_s = 86400;

// Order of day and month in dates such as 03/04/2025. A file has one order.
enum class DateOrder { kUnknown, kDayFirst, kMonthFirst };

// Seconds since 1970-01-01 00:00 of a date with or without a time of day, of these forms:
//   2025-03-12, 2025-03-12 10:30, 2025-03-12T10:30:05.5, 2025/3/12 10:30   year first
//   12.03.2025 10:30                                                       day first, with points
//   03/25/2025, 25/03/2025 10:30                  in the order `order`, if it is known; else only if
//                                                 one of the first two numbers exceeds 12
// "Z" and an offset such as +01:00 are read and ignored: a series keeps the clock of its logger.
// Empty: another form, or no date of the calendar.
std::optional<double> ReadDateTime(std::string_view text, DateOrder order = DateOrder::kUnknown);

// The order that a date tells by a number above 12: that of 25/03/2025 is kDayFirst.
DateOrder OrderOfDate(std::string_view text);

// "2025-03-12"; "-" for NaN.
std::string DateText(double seconds);
// "2025-03-12 10:30:05"; "-" for NaN.
std::string DateTimeText(double seconds);

}  // namespace lyrefit
