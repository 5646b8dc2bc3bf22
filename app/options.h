// SPDX-License-Identifier: Apache-2.0
// Numbers, times and windows on the command line, refused in words that say what was wanted.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "app/command.h"

namespace vestige::app {

/// Options whose value must be a whole number in [low, high], or a number in it. The last one given
/// counts.
CLI::Option* addInteger(CLI::App& command, const std::string& name, std::int64_t low,
                        std::int64_t high, std::function<void(std::int64_t)> set,
                        const std::string& help);
CLI::Option* addNumber(CLI::App& command, const std::string& name, double low, double high,
                       std::function<void(double)> set, const std::string& help);
/// An option that may be given several times, one value each.
CLI::Option* addList(CLI::App& command, const std::string& name, std::vector<std::string>& values,
                     const std::string& help);

/// "30s", "2m", "1h30m", "500ms" or plain seconds; nullopt if it is none of these or not above 0.
std::optional<double> parseDuration(const std::string& text);
/// Bytes: "2G", "500M", "64k" (powers of 1024) or plain "123456"; nullopt if it is none of these.
std::optional<std::size_t> parseBytes(const std::string& text);
/// Four shares "x0,y0,x1,y1" with 0 <= x0 < x1 <= 1, likewise y; false if they are not.
bool parseCrop(const std::string& text, double crop[4]);

}  // namespace vestige::app
