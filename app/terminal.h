// SPDX-License-Identifier: Apache-2.0
// What the user reads on his terminal: sentences on stderr, coloured where that is welcome.
#pragma once
#include <string>

namespace vestige::app {

bool isTerminal(int descriptor);
/// A terminal, and NO_COLOR (https://no-color.org) is not set.
bool wantsColour(int descriptor);
/// Columns of the terminal, else of COLUMNS, else 80. At least 40.
int terminalWidth(int descriptor);

void complain(const std::string& sentence);  ///< "vestige: error: ..."
void warn(const std::string& sentence);      ///< "vestige: warning: ..."
void say(const std::string& sentence);       ///< as it is

/// "0.4 s", "12 s", "3 min 20 s", "1 h 05 min".
std::string durationText(double seconds);
/// "1 sample", "2 samples".
std::string count(long long n, const std::string& noun);

}  // namespace vestige::app
