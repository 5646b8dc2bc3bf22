// SPDX-License-Identifier: Apache-2.0
#include "tests/lang/measured.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "tests/lang/schemas.h"

namespace vestige::lang::test {
namespace {

/// A brake, so that a fault does not take the machine down; the peak itself is what is checked.
constexpr rlim_t kAddressSpace = rlim_t(6) << 30;

std::string errorsOf(const Result& r) {
  std::string all;
  for (const Diagnostic& d : r.diagnostics.list()) {
    if (d.severity != Severity::error) continue;
    const Place p = locate(d.span, *r.sources);
    all += std::to_string(p.line) + ':' + std::to_string(p.column) + ": " + d.message + '\n';
  }
  return all;
}

[[noreturn]] void child(const std::string& text, const Options& options, int out) {
  const rlimit seconds{kMostSeconds, kMostSeconds + 1};
  setrlimit(RLIMIT_CPU, &seconds);
#ifndef __SANITIZE_ADDRESS__
  const rlimit bytes{kAddressSpace, kAddressSpace};
  setrlimit(RLIMIT_AS, &bytes);
#endif
  const std::string errors = errorsOf(read(text, options));
  const ssize_t written = write(out, errors.data(), errors.size());
  _exit(written == ssize_t(errors.size()) ? 0 : 1);
}

Measured inChild(const std::string& text, const Options& options) {
  Measured m;
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t pid = fork();
  REQUIRE(pid >= 0);
  if (pid == 0) {
    close(ends[0]);
    child(text, options, ends[1]);
  }
  close(ends[1]);
  char buffer[4096];
  for (ssize_t n = 0; (n = ::read(ends[0], buffer, sizeof buffer)) > 0;)
    m.errors.append(buffer, std::size_t(n));
  close(ends[0]);
  int status = 0;
  rusage used{};
  wait4(pid, &status, 0, &used);
  m.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  m.megabytes = double(used.ru_maxrss) / 1024;
  m.seconds = double(used.ru_utime.tv_sec) + 1e-6 * double(used.ru_utime.tv_usec) +
              double(used.ru_stime.tv_sec);
  return m;
}

}  // namespace

Measured measured(const std::string& text, const Options& options) {
  // A forked process begins with what this one holds, the text itself included.
  const double own = inChild("", {}).megabytes;
  Measured m = inChild(text, options);
  m.megabytes -= own;
  return m;
}

}  // namespace vestige::lang::test
