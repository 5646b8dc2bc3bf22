// SPDX-License-Identifier: Apache-2.0
// Dates, as days since the beginning of 2000 in UTC, whatever the machine's zone and language are.
#include <cmath>
#include <cstdint>
#include <ctime>

#include "lang/builtins.h"

namespace vestige::lang {
namespace {

constexpr std::int64_t kSecondsADay = 86400;
constexpr std::int64_t kDaysFrom1970To2000 = 10957;

/// The Gregorian calendar, days since 1970-01-01 [Hinnant, chrono-compatible date algorithms].
void setDate(std::tm& t, std::int64_t days) {
  constexpr std::int64_t kDaysAnEra = 146097, kDaysFromYear0 = 719468;  // years begin in March
  const std::int64_t shifted = days + kDaysFromYear0;
  const std::int64_t era = shifted / kDaysAnEra, day = shifted % kDaysAnEra;
  const std::int64_t year = (day - day / 1460 + day / 36524 - day / 146096) / 365;
  const std::int64_t ofYear = day - (365 * year + year / 4 - year / 100);
  const std::int64_t month = (5 * ofYear + 2) / 153;
  t.tm_mday = int(ofYear - (153 * month + 2) / 5 + 1);
  t.tm_mon = int(month < 10 ? month + 2 : month - 10);
  const std::int64_t whole = year + 400 * era + (t.tm_mon < 2 ? 1 : 0);
  t.tm_year = int(whole - 1900);
  t.tm_wday = int((days % 7 + 11) % 7);  // 1970 began on a Thursday
  const bool isLeap = whole % 4 == 0 && (whole % 100 != 0 || whole % 400 == 0);
  constexpr int before[] = {0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334};
  t.tm_yday = before[t.tm_mon] + t.tm_mday - 1 + (isLeap && t.tm_mon > 1 ? 1 : 0);
}

/// Rounded to seconds. The zone is none: %z and %Z are empty, as POV-Ray's are.
std::tm timeOf(std::int64_t seconds) {
  std::int64_t days = seconds / kSecondsADay, rest = seconds % kSecondsADay;
  if (rest < 0) rest += kSecondsADay, --days;
  std::tm t{};
  setDate(t, days);
  t.tm_hour = int(rest / 3600), t.tm_min = int(rest / 60 % 60), t.tm_sec = int(rest % 60);
  t.tm_isdst = -1;
  return t;
}

/// %s would depend on the machine's zone: it is written here.
std::string withSeconds(const std::string& format, std::int64_t seconds) {
  std::string s;
  for (std::size_t i = 0; i < format.size(); ++i) {
    const bool isField = format[i] == '%' && i + 1 < format.size();
    if (isField && format[i + 1] == 's') {
      s += std::to_string(seconds), ++i;
    } else {
      s += format[i];
      if (isField) s += format[++i];
    }
  }
  return s;
}

/// datetime(days [, format]): the fields of C's strftime().
Datum datetime(const Call& c) {
  constexpr double kFirst = -219145, kEnd = 2921939.99999;  // the years 1400 to 9999
  const double days = c.number(0);
  if (!(days >= kFirst && days < kEnd))
    return c.complain(
        0, "datetime() takes days since 2000, in the years 1400 to 9999, found " + shortest(days));
  const std::string given = c.args.size() > 1 ? c.text(1) : "%Y-%m-%d %H:%M:%SZ";
  if (given.empty()) return c.complain(1, "datetime() takes a format that is not empty");
  const auto seconds =
      std::int64_t(std::floor(days * kSecondsADay + 0.5)) + kDaysFrom1970To2000 * kSecondsADay;
  const std::tm t = timeOf(seconds);
  const std::string format = ' ' + withSeconds(given, seconds);  // never an empty result
  constexpr std::size_t kLongestField = 32;
  const std::size_t most = c.context.options.limits.stringLength;
  const std::size_t size = std::min(most, kLongestField * format.size()) + 2;
  c.context.budget.need(c.span, double(size));
  c.context.budget.copy(c.span, size);
  std::string s(size, '\0');
  const std::size_t length = std::strftime(s.data(), s.size(), format.c_str(), &t);
  if (length == 0) return c.complain(1, "this format gives a string that is too long");
  return c.context.budget.text(c.span, s.substr(1, length - 1));
}

}  // namespace

std::vector<Builtin> timeBuiltins() { return {{"datetime", "n|s", datetime}}; }

}  // namespace vestige::lang
