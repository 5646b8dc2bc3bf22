// SPDX-License-Identifier: Apache-2.0
#include "app/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <cerrno>

#include "app/command.h"

namespace vestige::app {
namespace {

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may not lock");

/// Only what POSIX allows inside a handler; whoever was interrupted finds his errno as it was.
void onSignal(int) {
  if (interrupted.exchange(true)) _exit(kInterrupted);
  static constexpr char kText[] = "\nstopping after the current samples; once more stops at once\n";
  const int before = errno;
  [[maybe_unused]] ssize_t written = 0;
  if (isatty(STDERR_FILENO)) written = write(STDERR_FILENO, kText, sizeof kText - 1);
  errno = before;
}

}  // namespace

const std::atomic<bool>& catchInterrupts() {
  struct sigaction action {};
  action.sa_handler = onSignal;
  action.sa_flags = SA_RESTART;  // a picture being written is not cut short
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return interrupted;
}

}  // namespace vestige::app
