// SPDX-License-Identifier: Apache-2.0
#include "app/options.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <CLI/CLI.hpp>
#include <cmath>
#include <utility>

namespace vestige::app {
namespace {

/// The whole of `text` as a number, or nothing.
template <class Number>
std::optional<Number> parse(const std::string& text) {
  Number value{};
  const char* begin = text.data() + (text.size() > 1 && text[0] == '+');
  const char* end = text.data() + text.size();
  const auto [stop, fault] = std::from_chars(begin, end, value);
  if (fault != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace

CLI::Option* addInteger(CLI::App& command, const std::string& name, std::int64_t low,
                        std::int64_t high, std::function<void(std::int64_t)> set,
                        const std::string& help) {
  const auto take = [=](const std::string& text) {
    const auto value = parse<std::int64_t>(text);
    if (!value || *value < low || *value > high)
      throw Failure(
          kCommandLineWrong,
          fmt::format("{} wants a whole number from {} to {}, found '{}'", name, low, high, text));
    set(*value);
  };
  return command.add_option_function<std::string>(name, take, help)->take_last()->type_name("N");
}

CLI::Option* addNumber(CLI::App& command, const std::string& name, double low, double high,
                       std::function<void(double)> set, const std::string& help) {
  const auto take = [=](const std::string& text) {
    const auto value = parse<double>(text);
    if (!value || !(*value >= low && *value <= high))
      throw Failure(kCommandLineWrong, fmt::format("{} wants a number from {} to {}, found '{}'",
                                                   name, low, high, text));
    set(*value);
  };
  return command.add_option_function<std::string>(name, take, help)->take_last()->type_name("X");
}

CLI::Option* addList(CLI::App& command, const std::string& name, std::vector<std::string>& values,
                     const std::string& help) {
  // Without this a list would swallow the scene's name that follows it.
  return command.add_option(name, values, help)->allow_extra_args(false);
}

std::optional<double> parseDuration(const std::string& text) {
  static constexpr std::pair<const char*, double> kUnits[] = {
      {"ms", 1e-3}, {"s", 1}, {"min", 60}, {"m", 60}, {"h", 3600}};
  double total = 0;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t word = std::min(text.find_first_not_of("0123456789.", at), text.size());
    const std::size_t next = std::min(text.find_first_of("0123456789.", word), text.size());
    const auto count = parse<double>(text.substr(at, word - at));
    const std::string unit = text.substr(word, next - word);
    double scale = unit.empty() && at == 0 ? 1 : 0;
    for (const auto& [name, seconds] : kUnits)
      if (unit == name) scale = seconds;
    if (!count || scale == 0) return std::nullopt;
    total += *count * scale;
    at = next;
  }
  if (!(total > 0) || !std::isfinite(total)) return std::nullopt;
  return total;
}

std::optional<std::size_t> parseBytes(const std::string& text) {
  static constexpr std::pair<char, int> kUnits[] = {{'K', 10}, {'M', 20}, {'G', 30}};
  std::string digits = text;
  double scale = 1;
  for (const auto& [unit, shift] : kUnits)
    if (!text.empty() && std::toupper(static_cast<unsigned char>(text.back())) == unit) {
      digits.pop_back();
      scale = std::ldexp(1.0, shift);
    }
  if (digits.find_first_not_of("0123456789.") != std::string::npos) return std::nullopt;
  const auto count = parse<double>(digits);
  if (!count) return std::nullopt;
  const double bytes = *count * scale;
  if (bytes > std::ldexp(1.0, 60) || (scale == 1 && bytes != std::floor(bytes)))
    return std::nullopt;
  return std::size_t(bytes);
}

bool parseCrop(const std::string& text, double crop[4]) {
  std::size_t at = 0;
  for (int i = 0; i < 4; ++i) {
    const std::size_t comma = text.find(',', at);
    if ((comma == std::string::npos) != (i == 3)) return false;
    const auto value = parse<double>(text.substr(at, comma - at));
    if (!value || !(*value >= 0 && *value <= 1)) return false;
    crop[i] = *value;
    at = comma + 1;
  }
  return crop[0] < crop[2] && crop[1] < crop[3];
}

}  // namespace vestige::app
